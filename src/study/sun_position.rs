//! Position of the sun from geographic location and local standard time, by the NREL Solar Position Algorithm.
//!
//! Altitudes are true, without refraction, which raises the sun by 0.5° at the horizon and is negligible for rooms.
//! Sunrise and sunset are those of calendars (upper limb, standard refraction).

use crate::compute::angle::Bearing;
use jiff::civil::{Date, DateTime};
use solar_positioning::time::JulianDate;
use solar_positioning::{Horizon, Location, SolarEvents, SolarPositions, delta_t};

/// Error in computing a position of the sun.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SunPositionError {
    /// Text that is not a date and time.
    #[error("\"{0}\" is not a local standard time: write YYYY-MM-DDTHH:MM, optionally with :SS, without a zone")]
    Time(String),
    /// Day that the calendar does not have.
    #[error("there is no {year}-{month:02}-{day:02}")]
    Date {
        /// Calendar year.
        year: i16,
        /// Month, 1 … 12.
        month: i8,
        /// Day of the month.
        day: i8,
    },
    /// Latitude, longitude or UTC offset that is out of range.
    #[error("{name} = {value} (allowed: {min} to {max})")]
    Place {
        /// Name of the wrong value.
        name: &'static str,
        /// Given value.
        value: f64,
        /// Minimum value.
        min: f64,
        /// Maximum value.
        max: f64,
    },
    /// Date outside the range of the algorithm.
    #[error("no position of the sun: {0}")]
    Algorithm(String),
}

/// Geographic location, with the UTC offset of its standard time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    latitude: f64,
    longitude: f64,
    utc_offset: f64,
}

impl Place {
    /// Creates a location from latitude (north positive) \[°\], longitude (east positive) \[°\] and the UTC offset of
    /// local standard time \[h\].
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

/// Sunrise and sunset of a day, in hours of local standard time; `None` if the sun does not cross the horizon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RiseSet {
    /// First sunrise of the day. \[h\]
    pub rise: Option<f64>,
    /// Last sunset of the day. \[h\]
    pub set: Option<f64>,
}

/// Position of the sun at one time of a day.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// Local standard time, in hours from midnight. \[h\]
    pub hour: f64,
    /// True altitude of the sun, without refraction. \[rad\]
    pub altitude: f64,
    /// Compass bearing of the sun, clockwise from north.
    pub bearing: Bearing,
}

/// Reads a local time from text, `YYYY-MM-DDTHH:MM[:SS]`; a blank instead of the T is accepted, a time zone is not.
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

/// Returns true altitude \[rad\] and compass bearing of the sun at a local standard time.
pub fn sun_position(place: &Place, time: DateTime) -> Result<(f64, Bearing), SunPositionError> {
    let hour = f64::from(time.hour())
        + f64::from(time.minute()) / 60.0
        + (f64::from(time.second()) + f64::from(time.subsec_nanosecond()) * 1e-9) / 3600.0;
    position_at(place, time.date(), hour)
}

/// Returns the positions of the sun over a day, every `step` hours \[h\] (at least one minute) from 0 to 24 h of local
/// standard time, above and below the horizon.
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

/// Returns sunrise and sunset of a day, in local standard time.
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

/// Returns the Julian date of midnight at the beginning of a day, as if in UT. 1970-01-01 is 2440587.5.
fn julian_midnight(date: Date) -> f64 {
    let days = date.duration_since(jiff::civil::date(1970, 1, 1)).as_hours() / 24;
    2_440_587.5 + days as f64
}

/// Returns the difference TT − UT1 (terrestrial time minus universal time) on a date. \[s\]
fn seconds_ahead(date: Date) -> Result<f64, SunPositionError> {
    delta_t::estimate(f64::from(date.year()) + f64::from(date.day_of_year()) / 365.25).map_err(algorithm)
}

fn position_at(place: &Place, date: Date, hour: f64) -> Result<(f64, Bearing), SunPositionError> {
    let julian = julian_midnight(date) + (hour - place.utc_offset) / 24.0;
    let time = JulianDate::new(julian, seconds_ahead(date)?).map_err(algorithm)?;
    let position = SolarPositions::new().at_from_julian(time, place.location(), 0.0, None).map_err(algorithm)?;
    Ok((position.elevation_angle().to_radians(), Bearing::from_degrees(position.azimuth())))
}
