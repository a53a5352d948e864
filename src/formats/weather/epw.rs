//! EPW, the weather files of EnergyPlus ("Auxiliary Programs: EPW data dictionary").
//!
//! Read: eight lines of header in any of their spellings, then rows of 35 fields of which the first 16 are required.
//! Hours count from 1 to 24 and mark the end, or from 0 to 23; with one record per hour the minute (0 or 60) says
//! nothing. Rows count, not the header's flags: leap years, periods, gaps, records per hour. Missing codes are read as
//! missing values.

use super::fields::{Changed, Field, check_count, day, diffuse, direct, global, lines, place, weekday};
use super::labels::{Label, Stated, place_intervals};
use crate::compute::btdf::Finding;
use crate::compute::limits;
use crate::compute::weather::{Quantity, Record, Station, Weather};
use crate::formats::location::excerpt;
use crate::formats::{FormatError, Location};

/// Fields of an EPW row that are read: number, from 1, and name.
const NAMES: [(usize, &str); 11] = [
    (1, "field 1 (year)"),
    (2, "field 2 (month)"),
    (3, "field 3 (day)"),
    (4, "field 4 (hour)"),
    (5, "field 5 (minute)"),
    (8, "field 8 (dew point)"),
    (14, "field 14 (global horizontal irradiance)"),
    (15, DIRECT),
    (16, DIFFUSE),
    (18, "field 18 (direct normal illuminance)"),
    (19, "field 19 (diffuse horizontal illuminance)"),
];
const DIRECT: &str = "field 15 (direct normal irradiance)";
const DIFFUSE: &str = "field 16 (diffuse horizontal irradiance)";
/// Minimum number of fields of an EPW row.
const LEAST_FIELDS: usize = 16;
/// Maximum number of header lines that are searched for DATA PERIODS.
const LONGEST_HEADER: usize = 200;

/// Reads an EPW file from its text.
pub fn read(text: &str) -> Result<Weather, FormatError> {
    let mut rows = lines(text);
    let mut findings = Vec::new();
    let Header { station, stated, first_weekday } = header(&mut rows, &mut findings)?;
    let (mut records, mut labels) = (Vec::new(), Vec::new());
    let mut changed = Changed::default();
    let mut last = 1;
    for (number, line) in rows {
        if line.trim_ascii().is_empty() {
            continue;
        }
        last = number;
        let (record, label) = row(line, number, &mut changed)?;
        records.push(record);
        labels.push(label);
        if records.len() > limits::WEATHER_RECORDS {
            break;
        }
    }
    check_count(&records, Location::line(last))?;
    if changed.negative > 0 {
        let message = format!("{} irradiances between −1 and 0 W/m² were read as 0", changed.negative);
        findings.push(Finding::info("negative-light", message));
    }
    if changed.years > 0 {
        let message = format!("{} rows of years before 1900 or after 2100: their sun is that of 2001", changed.years);
        findings.push(Finding::info("year-absurd", message));
    }
    let mut weather = Weather {
        format: "EPW",
        station,
        quantity: Quantity::NormalIrradiance,
        interval: 60,
        clock: 0.0,
        tested: None,
        first_weekday,
        records,
        findings,
        field_names: [DIRECT, DIFFUSE],
    };
    place_intervals(&mut weather, &mut labels, stated)?;
    Ok(weather)
}

/// Header of an EPW file: data of the lines before the first row.
struct Header {
    station: Station,
    /// Length of the intervals that the line DATA PERIODS states.
    stated: Stated,
    /// Weekday of the first row, 0 (Monday) … 6 (Sunday).
    first_weekday: Option<u8>,
}

fn header<'a>(
    rows: &mut impl Iterator<Item = (usize, &'a str)>,
    findings: &mut Vec<Finding>,
) -> Result<Header, FormatError> {
    let (_, first) = rows.next().unwrap_or((1, ""));
    if !first.trim_start().to_ascii_uppercase().starts_with("LOCATION") {
        let found = if first.trim().is_empty() { "nothing".to_owned() } else { format!("\"{}\"", excerpt(first)) };
        return Err(FormatError::new(Location::line(1), found, "the LOCATION line with which an EPW file begins"));
    }
    let station = location(first)?;
    for (number, text) in rows.take(LONGEST_HEADER) {
        let word = text.trim_start().to_ascii_uppercase();
        if word.starts_with("DATA PERIODS") {
            let fields = header_fields(text, number, "DATA PERIODS, records per hour");
            let first_weekday = fields.get(4).and_then(|field| weekday(field.text));
            let stated = Stated { interval: interval(&fields, number)?, line: number };
            return Ok(Header { station, stated, first_weekday });
        }
        if word.starts_with("HOLIDAYS") {
            say_summer_time(text, findings);
        }
        if word.starts_with(|c: char| c.is_ascii_digit()) {
            let found = format!("\"{}\"", excerpt(text));
            return Err(FormatError::new(Location::line(number), found, "the DATA PERIODS line before the first row"));
        }
    }
    Err(FormatError::new(Location::file(), "no DATA PERIODS line", "eight lines of header before the first row"))
}

/// Returns the fields of a header line with their positions; `name`: their name in messages.
fn header_fields<'a>(text: &'a str, line: usize, name: &'static str) -> Vec<Field<'a>> {
    let mut column = 1;
    let mut fields = Vec::new();
    for part in text.split(',') {
        fields.push(Field { text: part, line, column, name });
        column += part.chars().count() + 1;
    }
    fields
}

/// Reads the station from the header line
/// `LOCATION,city,state,country,source,WMO,latitude,longitude,time zone,elevation`.
fn location(text: &str) -> Result<Station, FormatError> {
    let fields = header_fields(text, 1, "LOCATION");
    if fields.len() < 10 {
        let found = format!("LOCATION with {} fields", fields.len());
        let expected =
            "10: LOCATION, city, state, country, source, WMO number, latitude, longitude, time zone, elevation";
        return Err(FormatError::new(Location::line(1), found, expected));
    }
    let specified = |k: usize| Some(fields[k].text.trim()).filter(|text| *text != "-").unwrap_or_default().to_owned();
    let number = specified(5);
    let source = if number.is_empty() { specified(4) } else { format!("{} {number}", specified(4)) };
    let mut station = Station {
        name: specified(1),
        region: specified(2),
        country: specified(3),
        source: source.trim().to_owned(),
        ..Station::default()
    };
    let named = |k: usize, name: &'static str| Field { name, ..fields[k] };
    place(
        &mut station,
        [
            named(6, "LOCATION, latitude"),
            named(7, "LOCATION, longitude"),
            named(8, "LOCATION, time zone"),
            named(9, "LOCATION, elevation"),
        ],
        1.0,
        1.0,
    )?;
    Ok(station)
}

/// Adds a finding if the header line `HOLIDAYS/DAYLIGHT SAVINGS,leap year observed,start,end,holidays` states a
/// daylight saving period: the hours of the rows are read as standard time nevertheless.
fn say_summer_time(text: &str, findings: &mut Vec<Finding>) {
    let fields: Vec<&str> = text.split(',').map(str::trim).collect();
    let dates = fields.get(2..4).unwrap_or_default();
    if dates.len() == 2 && dates.iter().all(|date| !matches!(*date, "" | "0" | "0/0" | "0/ 0")) {
        let message = format!(
            "the header sets summer time from {} to {}: rows are read as standard time all the year, as the format has it",
            dates[0], dates[1]
        );
        findings.push(Finding::warning("summer-time", message));
    }
}

/// Reads `DATA PERIODS,number,records per hour,name,first weekday,…`. Returns the length of the intervals. \[min\]
fn interval(fields: &[Field<'_>], line: usize) -> Result<u16, FormatError> {
    let Some(field) = fields.get(2) else {
        let expected = "DATA PERIODS, number of periods, records per hour, …";
        return Err(FormatError::new(Location::line(line), "DATA PERIODS without records per hour", expected));
    };
    let records = field.integer(1, 60)?;
    if 60 % records != 0 { Err(field.wrong("a number that divides 60")) } else { Ok(60 / records as u16) }
}

/// Reads a row: returns its record, whose begin is not known yet, and the hour and minute that determine it.
fn row(text: &str, line: usize, changed: &mut Changed) -> Result<(Record, Label), FormatError> {
    let mut fields = [Field { text: "", line, column: 0, name: "" }; NAMES.len()];
    let (mut count, mut column, mut next) = (0, 1, 0);
    for part in text.split(',') {
        count += 1;
        if let Some((number, name)) = NAMES.get(next)
            && *number == count
        {
            fields[next] = Field { text: part, line, column, name };
            next += 1;
        }
        column += part.len() + 1;
    }
    if count < LEAST_FIELDS {
        let at = Location::line_column(line, text.len() + 1);
        return Err(FormatError::new(at, format!("a row of {count} fields"), "35 fields, the first 16 at least"));
    }
    let [year, month, date, hour, minute, dew, whole, sun, sky, sun_light, sky_light] = &fields;
    let written = year.integer(-32_000, 32_000)?;
    let day = day(written, month, date)?;
    changed.years += usize::from(i32::from(day.year) != written);
    let label = Label {
        // 0 of files that count from 0: messages name the hours of the format.
        hour: if hour.number()? == 0.0 { 0 } else { hour.integer(1, 24)? as u8 },
        // Of one record an hour the minute may be anything.
        minute: minute.integer(0, 60).ok().map(|minute| minute as u8),
        column: u16::try_from(minute.column).unwrap_or(u16::MAX),
    };
    let dew_point = dew.number()? + 0.0;
    let record = Record {
        day,
        start: 0,
        direct: irradiance(sun)?.map(|value| direct(value, sun, day, changed)).transpose()?,
        diffuse: irradiance(sky)?.map(|value| diffuse(value, sky, changed)).transpose()?,
        global: irradiance(whole)?.map(|value| global(value, whole, changed)).transpose()?,
        dew_point: (dew_point < 99.0 && dew_point > -99.0).then_some(dew_point),
        direct_illuminance: illuminance(sun_light)?,
        diffuse_illuminance: illuminance(sky_light)?,
        line: u32::try_from(line).unwrap_or(u32::MAX),
    };
    Ok((record, label))
}

/// Returns an irradiance; `None` for the missing codes 9999, in older files 99990 and more. \[W/m²\]
fn irradiance(field: &Field<'_>) -> Result<Option<f64>, FormatError> {
    let value = field.number()?;
    // Beyond five digits it is a slip, to be refused by its range.
    Ok((value < 9999.0 || (10_000.0..99_990.0).contains(&value) || value >= 1e5).then_some(value))
}

/// Returns an illuminance; `None` for the missing codes 999999, in older files 999900, or if there is no such field.
/// \[lx\]
fn illuminance(field: &Field<'_>) -> Result<Option<f64>, FormatError> {
    if field.name.is_empty() || field.text.trim().is_empty() {
        return Ok(None);
    }
    let value = field.number()?;
    Ok((0.0..999_900.0).contains(&value).then_some(value))
}
