//! Compact tables of a weather year (`cfs-weather 1`), with only the data that a computation of light needs.
//!
//! ```text
//! cfs-weather 1
//! name = New York, Central Park
//! region = NY
//! country = USA
//! source = …                 who measured or modelled, and where the figures were taken from
//! latitude = 40.78           north positive
//! longitude = -73.96         east positive
//! utc_offset = -5
//! elevation = 40
//! clock = -30                minutes by which all intervals lie later than their hours say
//! closure = 26.7 1.8         W/m², of the source's own irradiances, without and with that clock
//! first_weekday = Sunday     of the first day: weekdays of a year that is spliced of several
//!
//! 1958-01-01                 a day of 24 hours, each row's own year 8,12,41,6.7                interval that ends at
//! hour 8: direct normal, diffuse horizontal W/m², dew point °C ``` Hours that are not listed are dark. An empty dew
//! point is unknown.

use super::fields::{Changed, Field, WEEKDAYS, check_count, day, diffuse, direct, lines, place, weekday};
use crate::compute::limits;
use crate::compute::weather::{Closure, Day, Quantity, Record, Station, Weather};
use crate::formats::location::excerpt;
use crate::formats::{FormatError, Location};
use std::fmt::Write as _;

/// First words of a table.
pub const MAGIC: &str = "cfs-weather 1";
/// Ending of the file names of compact weather tables.
pub const EXTENSION: &str = ".weather.txt";

const KEYS: [&str; 11] = [
    "name",
    "region",
    "country",
    "source",
    "latitude",
    "longitude",
    "utc_offset",
    "elevation",
    "clock",
    "closure",
    "first_weekday",
];
const DIRECT: &str = "value 2 (direct normal irradiance)";
const DIFFUSE: &str = "value 3 (diffuse horizontal irradiance)";

/// Reads a compact weather table from its text.
///
/// # Errors
/// Returns an error with line, column, what was found and what was expected if the table is not valid.
pub fn read(text: &str) -> Result<Weather, FormatError> {
    let mut rows = lines(text).map(|(number, line)| (number, line.trim()));
    // The magic word.
    rows.next();
    let mut values: [Option<(usize, &str)>; KEYS.len()] = [None; KEYS.len()];
    for (number, line) in rows.by_ref() {
        if line.is_empty() {
            break;
        }
        let known = line.split_once('=').and_then(|(key, value)| {
            let index = KEYS.iter().position(|known| *known == key.trim())?;
            Some((index, value.trim()))
        });
        let Some((index, value)) = known else {
            let expected = format!("a key and its value ({}), or an empty line", KEYS.join(", "));
            return Err(FormatError::new(Location::line(number), format!("\"{}\"", excerpt(line)), expected));
        };
        values[index] = Some((number, value));
    }
    let specified = |k: usize| values[k].map_or(String::new(), |(_, text)| text.to_owned());
    let needed = |k: usize| match values[k] {
        Some((line, text)) => Ok(Field { text, line, column: KEYS[k].len() + 4, name: KEYS[k] }),
        None => Err(FormatError::new(Location::file().in_element(KEYS[k]), "missing", "this key in the table's head")),
    };
    let mut station = Station {
        name: specified(0),
        region: specified(1),
        country: specified(2),
        source: specified(3),
        ..Station::default()
    };
    place(&mut station, [needed(4)?, needed(5)?, needed(6)?, needed(7)?], 1.0, 1.0)?;
    let clock = if values[8].is_some() { needed(8)?.within(-180.0, 180.0, "min")? } else { 0.0 };
    let tested = if values[9].is_some() { Some(closure(needed(9)?, clock)?) } else { None };
    let first_weekday = match values[10] {
        Some(_) => {
            let field = needed(10)?;
            Some(weekday(field.text).ok_or_else(|| field.wrong(format!("one of {}", WEEKDAYS.join(", "))))?)
        }
        None => None,
    };
    let mut records: Vec<Record> = Vec::new();
    let mut changed = Changed::default();
    let mut last = 0;
    for (number, line) in rows.filter(|(_, line)| !line.is_empty()) {
        last = number;
        let fields = fields(line, number);
        if fields.len() == 1 {
            records.extend(dark_day(date(fields[0])?, number));
        } else if let Some(first) = records.len().checked_sub(24) {
            hour(&fields, &mut records[first..], &mut changed)?;
        } else {
            return Err(fields[0].wrong("a row with the day (YYYY-MM-DD) before those of its hours"));
        }
        if records.len() > limits::WEATHER_RECORDS {
            break;
        }
    }
    check_count(&records, Location::line(last))?;
    Ok(Weather {
        format: "cfs weather table",
        station,
        quantity: Quantity::NormalIrradiance,
        interval: 60,
        clock,
        tested,
        first_weekday,
        records,
        findings: Vec::new(),
        field_names: [DIRECT, DIFFUSE],
    })
}

fn fields(line: &str, number: usize) -> Vec<Field<'_>> {
    const NAMES: [&str; 4] = ["value 1 (hour)", DIRECT, DIFFUSE, "value 4 (dew point)"];
    let mut column = 1;
    let mut list = Vec::with_capacity(4);
    for (k, part) in line.split(',').enumerate() {
        list.push(Field { text: part, line: number, column, name: NAMES.get(k).copied().unwrap_or("value") });
        column += part.chars().count() + 1;
    }
    list
}

fn closure(field: Field<'_>, clock: f64) -> Result<Closure, FormatError> {
    let wrong = || field.wrong("two numbers, W/m² without and with the clock");
    let (rms, best) = field.text.split_once(' ').ok_or_else(wrong)?;
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(wrong);
    Ok(Closure { rms: number(rms)?, best_offset: clock, best_rms: number(best)? })
}

fn date(field: Field<'_>) -> Result<Day, FormatError> {
    let mut parts = field.text.split('-');
    let mut part = |name| Field { text: parts.next().unwrap_or(""), name, ..field };
    let (year, month, number) = (part("year"), part("month"), part("day"));
    let year =
        year.integer(1900, 2100).map_err(|_| field.wrong("a day, YYYY-MM-DD, or hour,direct,diffuse,dew point"))?;
    day(year, &month, &number)
}

fn dark_day(day: Day, line: usize) -> impl Iterator<Item = Record> {
    (0..24).map(move |hour| Record {
        day,
        start: 3600 * hour,
        direct: Some(0.0),
        diffuse: Some(0.0),
        global: None,
        dew_point: None,
        direct_illuminance: None,
        diffuse_illuminance: None,
        line: u32::try_from(line).unwrap_or(u32::MAX),
    })
}

fn hour(fields: &[Field<'_>], day: &mut [Record], changed: &mut Changed) -> Result<(), FormatError> {
    let [hour, sun, sky, dew] = fields else {
        return Err(fields[0].wrong("hour,direct,diffuse,dew point"));
    };
    let record = &mut day[hour.integer(1, 24)? as usize - 1];
    record.direct = Some(direct(sun.number()?, sun, record.day, changed)?);
    record.diffuse = Some(diffuse(sky.number()?, sky, changed)?);
    record.dew_point = if dew.text.is_empty() { None } else { Some(dew.within(-99.0, 99.0, "°C")?) };
    record.line = u32::try_from(hour.line).unwrap_or(u32::MAX);
    Ok(())
}

/// Returns the compact table of a weather file of hourly records in whole days.
///
/// # Errors
/// Returns an error if the records are not hours or not whole days of them, if irradiances are missing by day, or if a
/// day has a gap.
pub fn write(weather: &Weather) -> Result<String, FormatError> {
    let refuse = |record: &Record, found: &str, expected: &str| {
        Err(FormatError::new(Location::line(record.line as usize), found, expected))
    };
    let mut text = String::from(MAGIC);
    let station = &weather.station;
    let closure = weather.tested.map_or(String::new(), |one| format!("{:.1} {:.1}", one.rms, one.best_rms));
    let values = [
        station.name.clone(),
        station.region.clone(),
        station.country.clone(),
        station.source.clone(),
        station.latitude.to_string(),
        station.longitude.to_string(),
        station.utc_offset.to_string(),
        station.elevation.to_string(),
        if weather.clock == 0.0 { String::new() } else { weather.clock.to_string() },
        closure,
        weather.first_weekday.map_or(String::new(), |day| WEEKDAYS[usize::from(day)].to_owned()),
    ];
    for (key, value) in KEYS.iter().zip(values).filter(|(_, value)| !value.is_empty()) {
        let _ = write!(text, "\n{key} = {value}");
    }
    text.push_str("\n\n");
    for day in weather.records.chunks(24) {
        let whole = day.len() == 24
            && day
                .iter()
                .enumerate()
                .all(|(k, hour)| hour.day == day[0].day && usize::try_from(hour.start) == Ok(3600 * k));
        if !whole || weather.quantity != Quantity::NormalIrradiance {
            return refuse(&day[0], "records that do not make a whole day of hours", "24 hours a day, from 1 to 24");
        }
        let _ = writeln!(text, "{}", day[0].day);
        for (k, record) in day.iter().enumerate() {
            let (Some(direct), Some(diffuse)) = (record.direct, record.diffuse) else {
                return refuse(record, "an irradiance is missing", "direct normal and diffuse horizontal irradiance");
            };
            if direct > 0.0 || diffuse > 0.0 {
                let dew = record.dew_point.map_or(String::new(), |value| value.to_string());
                let _ = writeln!(text, "{},{direct},{diffuse},{dew}", k + 1);
            }
        }
    }
    Ok(text)
}
