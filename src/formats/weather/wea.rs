//! WEA, the weather files of Radiance's `gendaymtx`: six lines of header, then `month day hour value value`.
//!
//! Longitude and time zone count west positive, the zone in degrees (15 an hour). Hours are the instants at which
//! `gendaymtx` puts the sun, from 0 to beyond 24 (24.25 is a quarter past midnight of the next day); each is the middle
//! of an interval. There is no year (2001 is taken, so that a 29th of February lies in 2004), no dew point, no global
//! irradiance. Any number of rows; intervals are as long as the least distance of two rows, an hour at most.

use super::fields::{Changed, Field, check_count, day, diffuse, direct, lines, place};
use crate::compute::btdf::Finding;
use crate::compute::limits;
use crate::compute::weather::{Quantity, Record, Station, Weather};
use crate::formats::location::excerpt;
use crate::formats::{FormatError, Location};

/// Keys of the header, in their order.
const KEYS: [&str; 6] = ["place", "latitude", "longitude", "time_zone", "site_elevation", "weather_data_file_units"];
const UNITS: [(Quantity, [&str; 2]); 3] = [
    (Quantity::NormalIrradiance, ["column 4 (direct normal irradiance)", "column 5 (diffuse horizontal irradiance)"]),
    (
        Quantity::HorizontalIrradiance,
        ["column 4 (direct horizontal irradiance)", "column 5 (diffuse horizontal irradiance)"],
    ),
    (
        Quantity::NormalIlluminance,
        ["column 4 (direct normal illuminance)", "column 5 (diffuse horizontal illuminance)"],
    ),
];
/// Name of the hour in messages.
const HOUR: &str = "column 3 (hour)";
/// Maximum illuminance by sun or sky that is accepted. \[lx\]
const MOST_LIGHT: f64 = 200_000.0;

/// Range of hours after midnight that belong to a day; a file may write a day's hours half an hour late. \[h\]
const HOURS: std::ops::Range<f64> = 0.0..25.0;
/// Number of rows for each of which one pair of rows with the same time and different light is tolerated (a row that
/// was written twice).
const STRAY: usize = 1000;
/// Number of days by which a row's date must lie before that of the previous row to belong to the next year.
const HALF_A_YEAR: i32 = 182;
/// Length of a day. \[s\]
const DAY: i64 = 86_400;

/// Row of a WEA file, before the length of the intervals is known.
struct Row {
    record: Record,
    /// Middle of the interval, as time after the midnight with which the record's day begins. \[s\]
    middle: f64,
    /// Maximum rounding error of the hour: half a unit of its last digit. \[s\]
    rounding: f64,
    /// Column of the hour in the line, in characters from 1.
    column: usize,
}

impl Row {
    /// Returns the time from the begin of 1 January 1970 to the middle of the interval, in local standard time. \[s\]
    fn moment(&self) -> f64 {
        (DAY * self.record.day.number()) as f64 + self.middle
    }

    /// Returns the time after midnight that the rounded hour most probably means: of all times that round to its
    /// digits, one at a half or whole interval, else a full minute. \[s\]
    fn second(&self, interval: u16) -> i64 {
        let near = |unit: f64| unit * (self.middle / unit).round();
        let units = [30.0 * f64::from(interval), 60.0];
        let meant = units.into_iter().map(near).find(|second| (second - self.middle).abs() <= self.rounding + 1e-6);
        meant.unwrap_or(self.middle).round() as i64
    }

    /// Returns the record with the begin of its interval, assigned to the day that contains the middle.
    fn placed(self, interval: u16) -> Record {
        let second = self.second(interval);
        let record = self.record;
        let day = if second < DAY { record.day } else { record.day.next() };
        Record { day, start: (second % DAY) as i32 - 30 * i32::from(interval), ..record }
    }
}

/// Reads a WEA file from its text.
pub fn read(text: &str) -> Result<Weather, FormatError> {
    let mut lines = lines(text).filter(|(_, line)| !line.trim_ascii().is_empty());
    let (station, unit) = header(&mut lines)?;
    let (quantity, field_names) = UNITS[unit];
    let mut rows = Vec::new();
    let mut changed = Changed::default();
    let mut last = KEYS.len();
    for (number, line) in lines {
        last = number;
        rows.push(row(line, number, quantity, field_names, &mut changed)?);
        if rows.len() > limits::WEATHER_RECORDS {
            break;
        }
    }
    set_years(&mut rows);
    check_times(&rows)?;
    let interval = interval(&rows);
    let records: Vec<Record> = rows.into_iter().map(|row| row.placed(interval)).collect();
    check_count(&records, Location::line(last))?;
    let mut findings = Vec::new();
    if changed.negative > 0 {
        let message = format!("{} values between −1 and 0 were read as 0", changed.negative);
        findings.push(Finding::info("negative-light", message));
    }
    Ok(Weather {
        format: "WEA",
        station,
        quantity,
        interval,
        clock: 0.0,
        tested: None,
        first_weekday: None,
        records,
        findings,
        field_names,
    })
}

/// Reads the header of a WEA file. Returns the station and the index of the unit in the list of units.
fn header<'a>(lines: &mut impl Iterator<Item = (usize, &'a str)>) -> Result<(Station, usize), FormatError> {
    let mut texts: Vec<(usize, String)> = Vec::with_capacity(KEYS.len());
    for key in KEYS {
        let (number, text) = lines.next().unwrap_or((texts.len() + 1, ""));
        let rest = text.trim_start().strip_prefix(key).filter(|rest| rest.starts_with([' ', '\t']) || rest.is_empty());
        let Some(rest) = rest else {
            let found = if text.trim().is_empty() { "nothing".to_owned() } else { format!("\"{}\"", excerpt(text)) };
            return Err(FormatError::new(Location::line(number), found, format!("\"{key}\" and its value")));
        };
        texts.push((number, rest.trim().to_owned()));
    }
    let field = |k: usize| Field { text: &texts[k].1, line: texts[k].0, column: KEYS[k].len() + 2, name: KEYS[k] };
    let mut station = Station { name: texts[0].1.trim_end_matches('_').to_owned(), ..Station::default() };
    // Degrees west against hours ahead of UTC: 15° an hour.
    place(&mut station, [field(1), field(2), field(3), field(4)], -1.0, -1.0 / 15.0)?;
    let unit = field(5).integer(1, 3)?;
    Ok((station, unit as usize - 1))
}

fn row(
    text: &str,
    line: usize,
    quantity: Quantity,
    names: [&'static str; 2],
    changed: &mut Changed,
) -> Result<Row, FormatError> {
    let names = ["column 1 (month)", "column 2 (day)", HOUR, names[0], names[1]];
    let mut fields = [Field { text: "", line, column: 0, name: "" }; 5];
    let mut count = 0;
    let mut from = None;
    for (at, byte) in text.bytes().chain([b' ']).enumerate() {
        match (byte.is_ascii_whitespace(), from) {
            (false, None) => from = Some(at),
            (true, Some(begin)) => {
                if let Some(field) = fields.get_mut(count) {
                    *field = Field { text: &text[begin..at], line, column: begin + 1, name: names[count] };
                }
                count += 1;
                from = None;
            }
            _ => {}
        }
    }
    if count < 5 {
        let at = Location::line_column(line, text.len() + 1);
        return Err(FormatError::new(at, format!("a row of {count} numbers"), "month, day, hour, direct, diffuse"));
    }
    let [month, date, hour, sun, sky] = &fields;
    let day = day(0, month, date)?;
    let time = hour.number()?;
    if !HOURS.contains(&time) {
        return Err(hour.wrong("0 to below 25 h"));
    }
    let digits = hour.text.split_once('.').map_or(0, |(_, digits)| digits.len().min(9) as i32);
    let (direct, diffuse) = if quantity == Quantity::NormalIlluminance {
        (sun.within(0.0, MOST_LIGHT, "lx")?, sky.within(0.0, MOST_LIGHT, "lx")?)
    } else {
        (direct(sun.number()?, sun, day, changed)?, diffuse(sky.number()?, sky, changed)?)
    };
    let record = Record {
        day,
        start: 0,
        direct: Some(direct),
        diffuse: Some(diffuse),
        global: None,
        dew_point: None,
        direct_illuminance: None,
        diffuse_illuminance: None,
        line: u32::try_from(line).unwrap_or(u32::MAX),
    };
    let rounding = 1800.0 * 0.1_f64.powi(digits);
    Ok(Row { record, middle: 3600.0 * time, rounding, column: hour.column })
}

/// Sets the years of the rows, which the format lacks: a date that lies half a year before the previous one belongs to
/// the next year.
fn set_years(rows: &mut [Row]) {
    let (mut turns, mut before, mut leap) = (0_i16, None, None);
    for row in rows.iter_mut() {
        let day = &mut row.record.day;
        let number = i32::from(day.of_common_year());
        if before.is_some_and(|before| before - number > HALF_A_YEAR) {
            // More years than that nobody has.
            turns = (turns + 1).min(90);
        }
        before = Some(number);
        if (day.month, day.day) == (2, 29) {
            leap.get_or_insert(turns);
        }
        day.year = turns;
    }
    let first = leap.map_or(2001, |turns| 2004 - turns);
    for row in rows {
        row.record.day.year += first;
    }
}

/// Checks that successive rows have different times; returns an error if rows with the same time have different light,
/// or if they occur repeatedly.
fn check_times(rows: &[Row]) -> Result<(), FormatError> {
    let equal = || rows.windows(2).filter(|pair| pair[0].moment() == pair[1].moment());
    let light = |row: &Row| (row.record.direct, row.record.diffuse);
    let different = equal().filter(|pair| light(&pair[0]) != light(&pair[1])).count();
    let lost = different > rows.len() / STRAY || 4 * equal().count() > rows.len();
    match equal().next() {
        Some([_, row]) if lost => {
            let at = Location::line_column(row.record.line as usize, row.column).in_element(HOUR);
            let found = format!(
                "{:.3}, the same time as in the row above, as in {} of {} rows",
                row.middle / 3600.0,
                equal().count(),
                rows.len()
            );
            Err(FormatError::new(at, found, "times that rise from row to row: they alone tell when a row was"))
        }
        _ => Ok(()),
    }
}

/// Returns the length of the intervals: the shortest distance between two rows, at most an hour; an hour for a single
/// row. If other distances are not multiples of it, the largest divisor of an hour that is not longer. \[min\]
fn interval(rows: &[Row]) -> u16 {
    let steps = || {
        let minutes = rows.windows(2).map(|pair| ((pair[1].moment() - pair[0].moment()) / 60.0).round());
        minutes.filter(|step| *step >= 1.0)
    };
    let least = steps().fold(60.0, f64::min);
    if steps().all(|step| step % least == 0.0) {
        return least as u16;
    }
    (1..=least as u16).rev().find(|step| 60 % step == 0).unwrap_or(60)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(rows: &str) -> Result<Weather, FormatError> {
        let head =
            "place Somewhere\nlatitude 50\nlongitude -15\ntime_zone -15\nsite_elevation 0\nweather_data_file_units 1\n";
        read(&(head.to_owned() + rows))
    }

    /// Day, begin in seconds and label of every row.
    fn intervals(weather: &Weather) -> Vec<(String, i32, String)> {
        let of = |record: &Record| (record.day.to_string(), record.start, record.label(weather.interval));
        weather.records.iter().map(of).collect()
    }

    #[test]
    fn hours_are_instants_also_at_midnight_and_beyond() {
        let weather = file("6 21 0.000 0 0\n6 21 0.250 0 0\n6 21 9.000 500 90\n").unwrap();
        assert_eq!(weather.interval, 15);
        let expected = [
            ("2001-06-21".to_owned(), -450, "2001-06-20 23:52:30–00:07:30".to_owned()),
            ("2001-06-21".to_owned(), 450, "2001-06-21 00:07:30–00:22:30".to_owned()),
            ("2001-06-21".to_owned(), 31_950, "2001-06-21 08:52:30–09:07:30".to_owned()),
        ];
        assert_eq!(intervals(&weather), expected);
        assert_eq!(weather.records[2].middle(15), "2001-06-21T09:00:00");
        // Five minutes to midnight are in the interval around it.
        assert_eq!((weather.find(6, 20, 86_100), weather.find(6, 20, 85_900)), (Some(0), None));
        assert_eq!((weather.find(6, 21, 449), weather.find(6, 21, 450)), (Some(0), Some(1)));
        let weather = file("6 20 23.917 1 0\n6 20 24.083 2 0\n6 20 24.250 3 0\n6 21 0.417 4 0\n").unwrap();
        assert_eq!(weather.interval, 10);
        let expected = [
            ("2001-06-20".to_owned(), 85_800, "2001-06-20 23:50–24:00".to_owned()),
            ("2001-06-21".to_owned(), 0, "2001-06-21 00:00–00:10".to_owned()),
            ("2001-06-21".to_owned(), 600, "2001-06-21 00:10–00:20".to_owned()),
            ("2001-06-21".to_owned(), 1200, "2001-06-21 00:20–00:30".to_owned()),
        ];
        assert_eq!(intervals(&weather), expected);
        // 1 to 24 h: the last one is the midnight of the next year.
        let weather = file("12 31 23 0 0\n12 31 24 0 0\n").unwrap();
        assert_eq!(intervals(&weather)[1], ("2002-01-01".to_owned(), -1800, "2001-12-31 23:30–00:30".to_owned()));
        assert_eq!((weather.find(12, 31, 86_399), weather.find(1, 1, 1799)), (Some(1), Some(1)));
        assert_eq!(weather.weekdays(), [0, 1], "31 December 2001 was a Monday");
    }

    #[test]
    fn any_step_is_read_to_the_second() {
        for (rows, interval, starts) in [
            // Minutes, as their digits round them.
            ("6 21 9.000 0 0\n6 21 9.017 0 0\n6 21 9.033 0 0\n", 1, [32_370, 32_430, 32_490]),
            ("6 21 9.00 0 0\n6 21 9.02 0 0\n6 21 9.03 0 0\n", 1, [32_370, 32_430, 32_490]),
            ("6 21 9.0 0 0\n6 21 9.75 0 0\n6 21 10.5 0 0\n", 45, [31_050, 33_750, 36_450]),
            // A time that is not a whole minute is kept: 9.3375 h are 9:20:15.
            ("6 21 9.3375 0 0\n6 21 10.3375 0 0\n6 21 11.3375 0 0\n", 60, [31_815, 35_415, 39_015]),
            // Apart by 30 and 50 min: what divides an hour.
            ("6 21 9.0 0 0\n6 21 9.5 0 0\n6 21 10.3333 0 0\n", 30, [31_500, 33_300, 36_300]),
        ] {
            let weather = file(rows).unwrap();
            assert_eq!(weather.interval, interval, "{rows}");
            assert_eq!(weather.records.iter().map(|record| record.start).collect::<Vec<_>>(), starts, "{rows}");
        }
    }

    #[test]
    fn a_year_ends_where_the_date_goes_back() {
        let weather = file("12 31 23.5 0 0\n1 1 0.5 0 0\n2 28 0.5 0 0\n").unwrap();
        let years = weather.records.iter().map(|record| record.day.year).collect::<Vec<_>>();
        assert_eq!(years, [2001, 2002, 2002]);
        assert_eq!(weather.records[0].seconds_to(&weather.records[1]), 3600);
        let weather = file("12 31 23.5 0 0\n1 1 0.5 0 0\n2 29 0.5 0 0\n").unwrap();
        assert_eq!(weather.records.iter().map(|record| record.day.year).collect::<Vec<_>>(), [2003, 2004, 2004]);
    }

    #[test]
    fn rows_of_one_time_are_refused_and_a_repeated_row_is_not() {
        let error = file("6 20 0.967 1 0\n6 20 0.967 2 0\n6 20 1.967 3 0\n6 20 1.967 3 0\n").unwrap_err().to_string();
        assert!(error.starts_with("line 8, column 6, column 3 (hour): 0.967, the same time"), "{error}");
        assert!(error.contains("2 of 4 rows"), "{error}");
        let weather = file("6 20 0.5 1 0\n6 20 1.5 2 0\n6 20 1.5 2 0\n6 20 2.5 3 0\n").unwrap();
        assert_eq!((weather.interval, weather.records.len()), (60, 4));
    }
}
