//! WEA, the weather files of Radiance's `gendaymtx`: six lines of header, then `month day hour value value`.
//!
//! Longitude and time zone count west positive, the zone in degrees (15 an hour). Hours are the intervals' middles. There
//! is no year (2001 is taken, 2004 when there is a 29th of February), no dew point, no global irradiance. Any number of
//! rows; intervals are as long as the least distance of two rows, an hour at most.

use super::fields::{Changed, Field, check_count, day, diffuse, direct, lines, place, text_of};
use crate::compute::btdf::Finding;
use crate::compute::limits;
use crate::compute::weather::{Quantity, Record, Station, Weather};
use crate::formats::location::excerpt;
use crate::formats::{FormatError, Location};

/// The header's words, in order.
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
/// More than any sun or sky sends. \[lx\]
const MOST_LIGHT: f64 = 200_000.0;

/// A row before it is known how long the intervals are: its hour is their middle.
struct Row {
    record: Record,
    hour: f64,
}

/// Reads a WEA file.
pub fn read(bytes: &[u8]) -> Result<Weather, FormatError> {
    let mut lines = lines(bytes);
    let (station, unit) = header(&mut lines)?;
    let (quantity, field_names) = UNITS[unit];
    let mut rows = Vec::new();
    let mut changed = Changed::default();
    let mut last = KEYS.len();
    for (number, line) in lines {
        if line.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        last = number;
        rows.push(row(line, number, quantity, field_names, &mut changed)?);
        if rows.len() > limits::WEATHER_RECORDS {
            break;
        }
    }
    let interval = interval(&rows);
    let mut records = Vec::with_capacity(rows.len());
    let leap = rows.iter().any(|row| (row.record.day.month, row.record.day.day) == (2, 29));
    for Row { mut record, hour } in rows {
        record.day.year = if leap { 2004 } else { 2001 };
        let start = (60.0 * hour - 0.5 * f64::from(interval)).round();
        if !(0.0..=1440.0 - f64::from(interval)).contains(&start) {
            let at = Location::line(record.line as usize).in_element("column 3 (hour)");
            let expected = format!("the middle of an interval of {interval} min within the day");
            return Err(FormatError::new(at, format!("{hour}"), expected));
        }
        record.start = start as u16;
        records.push(record);
    }
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

/// Station and index of the unit.
fn header<'a>(lines: &mut impl Iterator<Item = (usize, &'a [u8])>) -> Result<(Station, usize), FormatError> {
    let mut texts: Vec<(usize, String)> = Vec::with_capacity(KEYS.len());
    for key in KEYS {
        let (number, line) = lines.next().unwrap_or((texts.len() + 1, &[]));
        let text = text_of(line);
        let rest = text.trim_start().strip_prefix(key).filter(|rest| rest.starts_with([' ', '\t']) || rest.is_empty());
        let Some(rest) = rest else {
            let found = if text.trim().is_empty() { "nothing".to_owned() } else { format!("\"{}\"", excerpt(&text)) };
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
    bytes: &[u8],
    line: usize,
    quantity: Quantity,
    names: [&'static str; 2],
    changed: &mut Changed,
) -> Result<Row, FormatError> {
    let names = ["column 1 (month)", "column 2 (day)", "column 3 (hour)", names[0], names[1]];
    let mut fields = [Field { text: "", line, column: 0, name: "" }; 5];
    let mut count = 0;
    let mut from = None;
    for (at, byte) in bytes.iter().chain(b" ").enumerate() {
        match (byte.is_ascii_whitespace(), from) {
            (false, None) => from = Some(at),
            (true, Some(begin)) => {
                if let Some(field) = fields.get_mut(count) {
                    let text = std::str::from_utf8(&bytes[begin..at]).unwrap_or("?");
                    *field = Field { text, line, column: begin + 1, name: names[count] };
                }
                count += 1;
                from = None;
            }
            _ => {}
        }
    }
    if count < 5 {
        let at = Location::line_column(line, bytes.len() + 1);
        return Err(FormatError::new(at, format!("a row of {count} numbers"), "month, day, hour, direct, diffuse"));
    }
    let [month, date, hour, sun, sky] = &fields;
    let day = day(0, month, date)?;
    let middle = hour.within(0.0, 24.0, "h")?;
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
    Ok(Row { record, hour: middle })
}

/// Least distance of two rows of a day that divides an hour; an hour without any. \[min\]
fn interval(rows: &[Row]) -> u16 {
    let same_day = rows.windows(2).filter(|pair| pair[0].record.day == pair[1].record.day);
    let steps = same_day.map(|pair| (60.0 * (pair[1].hour - pair[0].hour)).round()).filter(|step| *step >= 1.0);
    let least = steps.fold(60.0, f64::min) as u16;
    (1..=least).rev().find(|step| 60 % step == 0).unwrap_or(60)
}
