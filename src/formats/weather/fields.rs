//! Fields of lines of numbers with their places, and the limits that all weather formats share.

use crate::compute::limits;
use crate::compute::sky::perez::SOLAR_CONSTANT;
use crate::compute::weather::{Day, Record, Station};
use crate::formats::location::excerpt;
use crate::formats::{FormatError, Location};

/// Returns the lines of a text with their numbers from 1.
pub fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.split('\n').enumerate().map(|(k, line)| (k + 1, line.strip_suffix('\r').unwrap_or(line)))
}

/// Days of the week as files name them, Monday first.
pub const WEEKDAYS: [&str; 7] = ["Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday", "Sunday"];

/// Returns the index of a name in [`WEEKDAYS`].
pub fn weekday(text: &str) -> Option<u8> {
    let named = |name: &&str| text.trim().eq_ignore_ascii_case(name);
    WEEKDAYS.iter().position(named).map(|place| place as u8)
}

/// Field of a line.
#[derive(Debug, Clone, Copy)]
pub struct Field<'a> {
    /// Text of the field.
    pub text: &'a str,
    /// Number of the field's line, from 1.
    pub line: usize,
    /// Column of the field in the line, from 1.
    pub column: usize,
    /// Name of the field, for messages.
    pub name: &'static str,
}

impl Field<'_> {
    /// Returns an error at the place of the field.
    pub fn wrong(&self, expected: impl Into<String>) -> FormatError {
        let at = Location::line_column(self.line, self.column).in_element(self.name);
        FormatError::new(at, format!("\"{}\"", excerpt(self.text)), expected)
    }

    /// Returns the field as a finite number.
    pub fn number(&self) -> Result<f64, FormatError> {
        let value = self.text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| self.wrong("a number"))
    }

    /// Returns the field as a finite number between limits.
    pub fn within(&self, min: f64, max: f64, unit: &str) -> Result<f64, FormatError> {
        let value = self.number()?;
        if (min..=max).contains(&value) {
            Ok(value)
        } else {
            Err(self.wrong(format!("{min} to {max} {unit}").trim_end()))
        }
    }

    /// Returns the field as a whole number between limits.
    pub fn integer(&self, min: i32, max: i32) -> Result<i32, FormatError> {
        // 1.0 is written by programs that know no integers.
        let value = self.number()?;
        if value.fract() == 0.0 && (f64::from(min)..=f64::from(max)).contains(&value) {
            Ok(value as i32)
        } else {
            Err(self.wrong(format!("a whole number from {min} to {max}")))
        }
    }
}

/// Sets latitude, longitude (east positive), UTC offset and elevation of a station, checked against their ranges.
pub fn place(station: &mut Station, fields: [Field<'_>; 4], longitude_sign: f64, zone: f64) -> Result<(), FormatError> {
    let [latitude, longitude, time_zone, elevation] = fields;
    station.latitude = latitude.within(-90.0, 90.0, "° (north positive)")?;
    let sense = if longitude_sign > 0.0 { "° (east positive)" } else { "° (west positive)" };
    station.longitude = longitude_sign * longitude.within(-180.0, 180.0, sense)?;
    let most = 14.0 / zone.abs();
    let unit = if zone == 1.0 { "h (ahead of UTC)" } else { "° (west positive)" };
    station.utc_offset = zone * time_zone.within(-most, most, unit)?;
    station.elevation = elevation.within(-1000.0, 9999.9, "m")?;
    Ok(())
}

/// Returns a day of the calendar; years outside 1900 to 2100 become 2001, or 2004 for a leap day.
pub fn day(year: i32, month: &Field<'_>, day: &Field<'_>) -> Result<Day, FormatError> {
    let (m, d) = (month.integer(1, 12)?, day.integer(1, 31)?);
    let year = if (1900..=2100).contains(&year) {
        year
    } else if (m, d) == (2, 29) {
        2004
    } else {
        2001
    };
    Day::new(year as i16, m as u8, d as u8).ok_or_else(|| day.wrong(format!("a day that month {m} has")))
}

/// Lowest irradiance below 0 that is accepted; it is read as 0. \[W/m²\]
const LEAST: f64 = -1.0;
/// Maximum diffuse irradiance of any sky. \[W/m²\]
const MOST_DIFFUSE: f64 = 1000.0;

/// Counts of values that were changed while reading.
#[derive(Debug, Clone, Copy, Default)]
pub struct Changed {
    /// Number of irradiances a little below 0 that became 0.
    pub negative: usize,
    /// Number of impossible years.
    pub years: usize,
}

/// Returns an irradiance within the range of sun or sky; values slightly below 0 become 0. \[W/m²\]
fn limited(value: f64, field: &Field<'_>, most: f64, changed: &mut Changed) -> Result<f64, FormatError> {
    if !(LEAST..=most).contains(&value) {
        return Err(field.wrong(format!("0 to {most:.0} W/m²")));
    }
    changed.negative += usize::from(value < 0.0);
    // Not the zero of the minus sign, which some files write.
    Ok(value.max(0.0) + 0.0)
}

/// Returns the direct irradiance: at most a tenth more than the extraterrestrial irradiance of that day. \[W/m²\]
pub fn direct(value: f64, field: &Field<'_>, day: Day, changed: &mut Changed) -> Result<f64, FormatError> {
    limited(value, field, 1.1 * SOLAR_CONSTANT * day.eccentricity(), changed)
}

/// Returns the diffuse irradiance. \[W/m²\]
pub fn diffuse(value: f64, field: &Field<'_>, changed: &mut Changed) -> Result<f64, FormatError> {
    limited(value, field, MOST_DIFFUSE, changed)
}

/// Returns the global irradiance: bright clouds around the sun may send more than the sun alone. \[W/m²\]
pub fn global(value: f64, field: &Field<'_>, changed: &mut Changed) -> Result<f64, FormatError> {
    limited(value, field, 2000.0, changed)
}

/// Returns an error if there are no records or more than the limit.
pub fn check_count(records: &[Record], at: Location) -> Result<(), FormatError> {
    if records.is_empty() {
        return Err(FormatError::new(at, "no rows of data", "a row for every interval"));
    }
    if records.len() > limits::WEATHER_RECORDS {
        let expected = format!("at most {} (a leap year minute by minute)", limits::WEATHER_RECORDS);
        return Err(FormatError::new(at, "too many rows", expected));
    }
    Ok(())
}
