//! Sun position from place and local standard time, by the NREL Solar Position Algorithm.
//!
//! Altitudes are true, without refraction: the 0.5° by which it lifts the sun on the horizon do not matter to rooms.
//! Sunrise and sunset are those of calendars (upper limb, standard refraction).

use crate::compute::angle::Bearing;
use jiff::civil::{Date, DateTime};
use solar_positioning::time::JulianDate;
use solar_positioning::{Horizon, Location, SolarEvents, SolarPositions, delta_t};

/// Error of a sun position.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SunPositionError {
    /// The text is not a date and time.
    #[error("\"{0}\" is not a local standard time: write YYYY-MM-DDTHH:MM, optionally with :SS, without a zone")]
    Time(String),
    /// The day is not in the calendar.
    #[error("there is no {year}-{month:02}-{day:02}")]
    Date {
        /// Year.
        year: i16,
        /// Month, 1 … 12.
        month: i8,
        /// Day of the month.
        day: i8,
    },
    /// A coordinate is not on the globe, or an offset is not that of a clock.
    #[error("{name} = {value} (allowed: {min} to {max})")]
    Place {
        /// Name of the value.
        name: &'static str,
        /// Given value.
        value: f64,
        /// Minimum value.
        min: f64,
        /// Maximum value.
        max: f64,
    },
    /// The date is outside the algorithm's range.
    #[error("no position of the sun: {0}")]
    Algorithm(String),
}

/// A place on earth and its clock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    latitude: f64,
    longitude: f64,
    utc_offset: f64,
}

impl Place {
    /// Creates a place from latitude (north positive), longitude (east positive) \[°\] and the UTC offset of local
    /// standard time \[h\].
    pub fn new(latitude: f64, longitude: f64, utc_offset: f64) -> Result<Self, SunPositionError> {
        let within = |name, value: f64, min: f64, max: f64| {
            if (min..=max).contains(&value) { Ok(()) } else { Err(SunPositionError::Place { name, value, min, max }) }
        };
        within("latitude", latitude, -90.0, 90.0)?;
        within("longitude", longitude, -180.0, 180.0)?;
        within("utc_offset", utc_offset, -14.0, 14.0)?;
        Ok(Self { latitude, longitude, utc_offset })
    }

    fn location(&self) -> Location {
        Location { latitude: self.latitude, longitude: self.longitude }
    }
}

/// Sunrise and sunset of a day in local standard time; `None` if the sun does not cross the horizon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RiseSet {
    /// First sunrise of the day. \[h\]
    pub rise: Option<f64>,
    /// Last sunset of the day. \[h\]
    pub set: Option<f64>,
}

/// Sun position at an hour of a day.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// Local standard time. \[h\]
    pub hour: f64,
    /// True altitude. \[rad\]
    pub altitude: f64,
    /// Compass bearing of the sun.
    pub bearing: Bearing,
}

/// Parses `YYYY-MM-DDTHH:MM[:SS]`; a blank instead of the T is accepted, a zone is not.
pub fn parse_local_time(text: &str) -> Result<DateTime, SunPositionError> {
    let wrong = || SunPositionError::Time(text.chars().take(80).collect());
    let trimmed = text.trim();
    // A civil parser would silently drop an offset, and a bare date would be midnight.
    let clock = trimmed.split_once(['T', 't', ' ']).ok_or_else(wrong)?.1;
    if !clock.contains(':') || clock.contains(['Z', 'z', '+', '-', '[']) {
        return Err(wrong());
    }
    trimmed.parse().map_err(|_| wrong())
}

/// Returns true altitude \[rad\] and bearing of the sun at a local standard time.
pub fn sun_position(place: &Place, time: DateTime) -> Result<(f64, Bearing), SunPositionError> {
    let hour = f64::from(time.hour())
        + f64::from(time.minute()) / 60.0
        + (f64::from(time.second()) + f64::from(time.subsec_nanosecond()) * 1e-9) / 3600.0;
    position_at(place, time.date(), hour)
}

/// Returns the sun position every `step` hours (at least one minute) from 0 to 24 h of a day, above and below the
/// horizon.
pub fn sun_path(place: &Place, year: i16, month: i8, day: i8, step: f64) -> Result<Vec<PathPoint>, SunPositionError> {
    let date = date(year, month, day)?;
    let count = (24.0 / step.clamp(1.0 / 60.0, 24.0)).round() as usize;
    (0..=count)
        .map(|i| {
            let hour = 24.0 * i as f64 / count as f64;
            position_at(place, date, hour).map(|(altitude, bearing)| PathPoint { hour, altitude, bearing })
        })
        .collect()
}

/// Returns sunrise and sunset of a day.
pub fn rise_set(place: &Place, year: i16, month: i8, day: i8) -> Result<RiseSet, SunPositionError> {
    let date = date(year, month, day)?;
    let start = julian_midnight(date) - place.utc_offset / 24.0;
    let events = SolarEvents::new()
        .for_interval_from_julian(start, start + 1.0, place.location(), seconds_ahead(date)?, Horizon::SunriseSunset)
        .map_err(algorithm)?;
    let hour = |julian: &f64| (julian - start) * 24.0;
    Ok(RiseSet { rise: events.rises.first().map(hour), set: events.sets.last().map(hour) })
}

fn date(year: i16, month: i8, day: i8) -> Result<Date, SunPositionError> {
    Date::new(year, month, day).map_err(|_| SunPositionError::Date { year, month, day })
}

fn algorithm(error: solar_positioning::Error) -> SunPositionError {
    SunPositionError::Algorithm(error.to_string())
}

/// Returns the Julian date of a day's midnight, as if in UT. 1970-01-01 is 2440587.5.
fn julian_midnight(date: Date) -> f64 {
    let days = date.duration_since(jiff::civil::date(1970, 1, 1)).as_hours() / 24;
    2_440_587.5 + days as f64
}

/// Returns the difference TT − UT1. \[s\]
fn seconds_ahead(date: Date) -> Result<f64, SunPositionError> {
    delta_t::estimate(f64::from(date.year()) + f64::from(date.day_of_year()) / 365.25).map_err(algorithm)
}

fn position_at(place: &Place, date: Date, hour: f64) -> Result<(f64, Bearing), SunPositionError> {
    let julian = julian_midnight(date) + (hour - place.utc_offset) / 24.0;
    let time = JulianDate::new(julian, seconds_ahead(date)?).map_err(algorithm)?;
    let position = SolarPositions::new().at_from_julian(time, place.location(), 0.0, None).map_err(algorithm)?;
    Ok((position.elevation_angle().to_radians(), Bearing::from_degrees(position.azimuth())))
}
