//! Fields of a weather file's lines with their positions, and limits of values that all weather formats have in common.

use crate::compute::limits;
use crate::compute::sky::perez::SOLAR_CONSTANT;
use crate::compute::weather::{Day, Record, Station};
use crate::formats::location::excerpt;
use crate::formats::{FormatError, Location};

/// Returns the lines of a text with their numbers from 1.
pub fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.split('\n').enumerate().map(|(k, line)| (k + 1, line.strip_suffix('\r').unwrap_or(line)))
}

/// Names of the days of the week in weather files, Monday first.
pub const WEEKDAYS: [&str; 7] = ["Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday", "Sunday"];

/// Returns the day of the week of a name in [`WEEKDAYS`], in any case: 0 (Monday) … 6 (Sunday).
pub fn weekday(text: &str) -> Option<u8> {
    let named = |name: &&str| text.trim().eq_ignore_ascii_case(name);
    WEEKDAYS.iter().position(named).map(|place| place as u8)
}

/// Field of a weather file's line, with its position.
#[derive(Debug, Clone, Copy)]
pub struct Field<'a> {
    /// Text of the field.
    pub text: &'a str,
    /// Line number of the field in the file, from 1.
    pub line: usize,
    /// Column in the line at which the field begins, in characters from 1.
    pub column: usize,
    /// Name of the field, for messages.
    pub name: &'static str,
}

impl Field<'_> {
    /// Returns the error that the field is not as expected, with its position and text.
    pub fn wrong(&self, expected: impl Into<String>) -> FormatError {
        let at = Location::line_column(self.line, self.column).in_element(self.name);
        FormatError::new(at, format!("\"{}\"", excerpt(self.text)), expected)
    }

    /// Returns the field as a finite number, or an error.
    pub fn number(&self) -> Result<f64, FormatError> {
        let value = self.text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| self.wrong("a number"))
    }

    /// Returns the field as a finite number from `min` to `max`, or an error; `unit`: unit in its message.
    pub fn within(&self, min: f64, max: f64, unit: &str) -> Result<f64, FormatError> {
        let value = self.number()?;
        if (min..=max).contains(&value) {
            Ok(value)
        } else {
            Err(self.wrong(format!("{min} to {max} {unit}").trim_end()))
        }
    }

    /// Returns the field as a whole number from `min` to `max`, or an error.
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

/// Sets latitude, longitude, UTC offset and elevation of a station from four fields in this order, checked against
/// their ranges. `longitude_sign`: −1 if the file counts west positive; `zone`: UTC offset \[h\] per unit of the file's
/// time zone.
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

/// Returns the day of the calendar that the fields state; a year outside 1900 to 2100 is replaced by 2001, or by 2004
/// for a leap day.
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

/// Lowest negative irradiance that is accepted; it is read as 0. \[W/m²\]
const LEAST: f64 = -1.0;
/// Maximum diffuse irradiance of any sky. \[W/m²\]
const MOST_DIFFUSE: f64 = 1000.0;

/// Counts of values that the reader of a weather file changed.
#[derive(Debug, Clone, Copy, Default)]
pub struct Changed {
    /// Number of slightly negative irradiances that were set to 0.
    pub negative: usize,
    /// Number of impossible years that were replaced.
    pub years: usize,
}

/// Returns the irradiance of a field after a check against its range, −1 W/m² to `most`; negative values are set to 0.
/// \[W/m²\]
fn limited(value: f64, field: &Field<'_>, most: f64, changed: &mut Changed) -> Result<f64, FormatError> {
    if !(LEAST..=most).contains(&value) {
        return Err(field.wrong(format!("0 to {most:.0} W/m²")));
    }
    changed.negative += usize::from(value < 0.0);
    // Not the zero of the minus sign, which some files write.
    Ok(value.max(0.0) + 0.0)
}

/// Returns the direct irradiance of a field after a check: at most 10 % above the extraterrestrial irradiance of that
/// day. \[W/m²\]
pub fn direct(value: f64, field: &Field<'_>, day: Day, changed: &mut Changed) -> Result<f64, FormatError> {
    limited(value, field, 1.1 * SOLAR_CONSTANT * day.eccentricity(), changed)
}

/// Returns the diffuse irradiance of a field after a check against its range. \[W/m²\]
pub fn diffuse(value: f64, field: &Field<'_>, changed: &mut Changed) -> Result<f64, FormatError> {
    limited(value, field, MOST_DIFFUSE, changed)
}

/// Returns the global irradiance of a field after a check against its range, which exceeds that of the sun alone
/// because bright clouds around it add to it. \[W/m²\]
pub fn global(value: f64, field: &Field<'_>, changed: &mut Changed) -> Result<f64, FormatError> {
    limited(value, field, 2000.0, changed)
}

/// Checks the number of records of a weather file; returns an error if there are none or more than the limit.
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
