//! The intervals of a weather file as steps of a year: nominal time, sun, sky.

use super::settings::Settings;
use crate::compute::sky::{Outside, Sun};
use crate::compute::weather::{Closure, Hour, Record, Station, Weather};
use crate::study::error::StudyError;
use crate::study::scene_file::{SceneFile, SiteKeys, SkyKeys};
use crate::study::sky::{SkyKeyError, clock_warning, even_outside_of_hour, outside_of_hour, places_apart};
use crate::study::weather::load;
use crate::study::weather_keys::reading;
use crate::study::year_keys::{DaysKey, YearKeys};
use jiff::civil::{Date, DateTime};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

/// Hours of a common year.
const HOURS_OF_A_YEAR: f64 = 8760.0;

/// One step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Sun and light.
    pub hour: Hour,
    /// Nominal middle, local standard time, the row's own year.
    pub time: DateTime,
    /// The row's month, 1 … 12.
    pub month: u8,
    /// By the clock on the wall. \[h\]
    pub clock: f64,
    /// Is somebody there?
    pub occupied: bool,
}

/// All steps of a weather file.
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    /// In the file's order.
    pub list: Vec<Step>,
    /// Of a step. \[h\]
    pub length: f64,
    /// Where the weather is from.
    pub station: Station,
    /// Test of its clock; `None` where it cannot be tested.
    pub closure: Option<Closure>,
    /// Minutes by which intervals were moved.
    pub offset: f64,
    /// Are they a whole year?
    pub whole: bool,
    /// What a person should know.
    pub warnings: Vec<String>,
    /// Light, ground and skyline of the scene.
    sky: SkyKeys,
    site: SiteKeys,
    ground: Vec<f64>,
    found: Found,
}

/// Outside and sun of a step.
type Sky = (Outside, Option<Sun>);

/// What has been found of the steps: kept for all that ask again, and no part of what the steps are.
#[derive(Debug, Clone)]
struct Found {
    number: u64,
    skies: Arc<Vec<OnceLock<Sky>>>,
}

impl Found {
    fn nothing(steps: usize) -> Self {
        static NUMBERS: AtomicU64 = AtomicU64::new(0);
        let number = NUMBERS.fetch_add(1, Ordering::Relaxed);
        Self { number, skies: Arc::new((0..steps).map(|_| OnceLock::new()).collect()) }
    }
}

impl PartialEq for Found {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Reads the weather of a scene's year.
///
/// # Errors
/// A file that cannot be read, a missing figure by day.
pub fn steps(file: &SceneFile, settings: &Settings, base: &Path) -> Result<Steps, StudyError> {
    let keys = &settings.keys;
    let weather = load(&keys.weather, base).map_err(|error| StudyError::key("year.weather", error.to_string()))?;
    let reading = reading(keys.light, keys.sun_offset_minutes);
    let wrong = |message: String| StudyError::key("year.weather", format!("{}: {message}", keys.weather.display()));
    let mut hours = weather.hours(reading).map_err(|error| wrong(error.to_string()))?;
    let offset = hours.offset();
    let parts = keys.steps_per_hour * u32::from(weather.interval) / 60;
    // Intervals shorter than an hour are steps as they are.
    let parts = parts.max(1);
    let mut list = Vec::with_capacity(weather.records.len() * parts as usize);
    for (index, record) in weather.records.iter().enumerate() {
        for part in 0..parts {
            let hour = hours.part(index, part, parts).map_err(|error| wrong(error.to_string()))?;
            list.push(step(hour, record, record.middle_seconds(weather.interval, part, parts), file, &weather, keys));
        }
    }
    let closure = match weather.tested {
        Some(tested) => Some(tested),
        None => weather.closure().map_err(|error| wrong(error.to_string()))?,
    };
    let mut warnings = places_apart(&weather, &file.site);
    warnings.extend(clock_warning(&weather, &keys.weather, reading, closure.as_ref(), "year.sun_offset_minutes"));
    let length = f64::from(weather.interval) / 60.0 / f64::from(parts);
    Ok(Steps {
        whole: list.len() as f64 * length >= HOURS_OF_A_YEAR - 1e-6,
        found: Found::nothing(list.len()),
        list,
        length,
        station: weather.station,
        closure,
        offset,
        warnings,
        sky: SkyKeys { ..file.sky.clone() },
        site: SiteKeys { ..file.site },
        ground: keys.ground.clone(),
    })
}

fn step(hour: Hour, record: &Record, seconds: f64, file: &SceneFile, weather: &Weather, keys: &YearKeys) -> Step {
    let day = record.day;
    // A 29th of February in a common year is believed as a row, but no calendar has it.
    let of = |number: u8| Date::new(day.year, day.month.cast_signed(), number.cast_signed());
    let date = of(day.day).or_else(|_| of(28)).unwrap_or(Date::MIN);
    let time = date.at(0, 0, 0, 0).saturating_add(jiff::Span::new().seconds(seconds.round() as i64));
    let clock = file.site.dst.clock(time, weather.station.utc_offset);
    let clock = f64::from(clock.hour()) + f64::from(clock.minute()) / 60.0 + f64::from(clock.second()) / 3600.0;
    let hours = &keys.hours;
    let day_counts = hours.days == DaysKey::All || !day.is_weekend();
    let occupied = day_counts && hours.hold(clock);
    Step { hour, time, month: day.month, clock, occupied }
}

impl Steps {
    /// The step whose interval holds a moment, of the same year where there is one, else of any.
    pub fn at(&self, time: DateTime) -> Option<usize> {
        let half = (1800.0 * self.length).round() as i64;
        let holds = |step: &Step, moment: DateTime| {
            let middle = step.time;
            let seconds = moment.duration_since(middle).as_secs();
            (-half..half).contains(&seconds)
        };
        let same = self.list.iter().position(|step| holds(step, time));
        same.or_else(|| {
            self.list
                .iter()
                .position(|step| time.with().year(step.time.year()).build().is_ok_and(|moment| holds(step, moment)))
        })
    }

    /// Reflectance of the ground in a step.
    pub fn ground(&self, step: usize) -> f64 {
        let month = usize::from(self.list[step].month.clamp(1, 12)) - 1;
        self.ground.get(month).copied().unwrap_or(self.site.ground_reflectance)
    }

    /// The same under a sky that is equally bright all over: for controls that do not ask how bright the façade is.
    ///
    /// # Errors
    /// As [`Self::outside`].
    pub fn even_outside(&self, step: usize) -> Result<(Outside, Option<Sun>), StudyError> {
        even_outside_of_hour(&self.list[step].hour, &self.sky, &self.site)
            .map_err(|SkyKeyError { key, message }| StudyError::key(key, message))
    }

    /// Sky, ground and skyline of a step, and its sun.
    ///
    /// # Errors
    /// Keys of sky or site that are out of range.
    pub fn outside(&self, step: usize) -> Result<(Outside, Option<Sun>), StudyError> {
        if let Some(found) = self.found.skies[step].get() {
            return Ok(found.clone());
        }
        let site = SiteKeys { ground_reflectance: self.ground(step), ..self.site };
        let found = outside_of_hour(&self.list[step].hour, &self.sky, &site)
            .map_err(|SkyKeyError { key, message }| StudyError::key(key, message))?;
        Ok(self.found.skies[step].get_or_init(|| found).clone())
    }

    /// A number that no other steps have, but copies of these: for what is kept of them elsewhere.
    pub fn number(&self) -> u64 {
        self.found.number
    }

    /// The same in W/m²: sky, ground and sun by the hour's irradiances, in the same shape. `per_lux`: what a fixed luminance of
    /// the skyline counts. \[W/lm\]
    ///
    /// # Errors
    /// As [`Self::outside`].
    pub fn outside_in_watts(&self, step: usize, per_lux: f64) -> Result<(Outside, Option<Sun>), StudyError> {
        let hour = &self.list[step].hour;
        let hour = Hour {
            direct_normal: hour.direct_normal_irradiance,
            diffuse_horizontal: hour.diffuse_horizontal_irradiance,
            ..*hour
        };
        let site = SiteKeys { ground_reflectance: self.ground(step), ..self.site };
        let fixed = self.sky.obstruction.is_some() || self.sky.skyline.is_some();
        let sky = if fixed {
            let mut sky = self.sky.clone();
            sky.obstruction.iter_mut().for_each(|keys| keys.luminance *= per_lux);
            sky.skyline.iter_mut().for_each(|keys| keys.luminance *= per_lux);
            std::borrow::Cow::Owned(sky)
        } else {
            std::borrow::Cow::Borrowed(&self.sky)
        };
        outside_of_hour(&hour, &sky, &site).map_err(|SkyKeyError { key, message }| StudyError::key(key, message))
    }
}

impl Settings {
    /// Is the light of a step to be computed?
    pub(super) fn asks(&self, step: &Step) -> bool {
        step.hour.is_lit() && (self.unoccupied || step.occupied)
    }
}
