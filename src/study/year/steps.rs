//! The intervals of a weather file as steps of a year: nominal time, sun, sky.

use super::settings::Settings;
use crate::compute::sky::{Outside, Sun};
use crate::compute::weather::{Closure, Hour, Station};
use crate::study::error::StudyError;
use crate::study::scene_file::{SceneFile, SiteKeys, SkyKeys};
use crate::study::sky::{SkyKeyError, clock_warning, even_outside_of_hour, outside_of_hour, places_apart};
use crate::study::weather::{kept, moment};
use crate::study::weather_keys::reading;
use crate::study::year_keys::{DaysKey, YearKeys};
use jiff::civil::DateTime;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

/// Number of the first weekday on which nobody works, from Monday on.
const SATURDAY: f64 = 5.0;
/// Hours of a common year.
const HOURS_OF_A_YEAR: f64 = 8760.0;

/// One step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Sun and light.
    pub hour: Hour,
    /// Nominal middle, local standard time, the row's own year; moved by the whole hours of `sun_offset_minutes`.
    pub time: DateTime,
    /// Month of that, 1 … 12.
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
    /// Codes of those that are the weather file's.
    pub weather_warnings: Vec<&'static str>,
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
    let kept = kept(&keys.weather, base).map_err(|error| StudyError::key("year.weather", error.to_string()))?;
    let weather = &kept.weather;
    let reading = reading(keys.light, keys.sun_offset_minutes);
    let wrong = |message: String| StudyError::key("year.weather", format!("{}: {message}", keys.weather.display()));
    let mut hours = weather.hours(reading).map_err(|error| wrong(error.to_string()))?;
    let offset = hours.offset();
    let parts = keys.steps_per_hour * u32::from(weather.interval) / 60;
    // Intervals shorter than an hour are steps as they are.
    let parts = parts.max(1);
    let moved = 60.0 * f64::from(hours.moved_clock());
    let mut list = Vec::with_capacity(weather.records.len() * parts as usize);
    for ((index, record), weekday) in weather.records.iter().enumerate().zip(weather.weekdays()) {
        for part in 0..parts {
            let hour = hours.part(index, part, parts).map_err(|error| wrong(error.to_string()))?;
            let seconds = record.middle_seconds(weather.interval, part, parts) + moved;
            let weekday = (f64::from(weekday) + (seconds / 86_400.0).floor()).rem_euclid(7.0);
            let clock = file.site.dst.clock(moment(record, seconds), weather.station.utc_offset);
            list.push(step(hour, moment(record, seconds), clock, weekday < SATURDAY, keys));
        }
    }
    let closure = kept.summary.closure;
    let mut warnings = places_apart(&weather.station, &file.site);
    warnings.extend(kept.warnings().map(|one| format!("{}: {}", keys.weather.display(), one.message)));
    warnings.extend(clock_warning(weather, &keys.weather, reading, closure.as_ref(), "year.sun_offset_minutes"));
    if keys.hours.days == DaysKey::Weekdays && weather.first_weekday.is_none() && weather.is_spliced() {
        warnings.push(format!(
            "{} is spliced of several years and states no first weekday: working days are those of a calendar that \
             begins as in {}",
            keys.weather.display(),
            weather.records[0].day.year
        ));
    }
    let length = f64::from(weather.interval) / 60.0 / f64::from(parts);
    Ok(Steps {
        whole: list.len() as f64 * length >= HOURS_OF_A_YEAR - 1e-6,
        found: Found::nothing(list.len()),
        list,
        length,
        station: weather.station.clone(),
        closure,
        offset,
        warnings,
        weather_warnings: kept.warnings().map(|one| one.code).collect(),
        sky: SkyKeys { ..file.sky.clone() },
        site: SiteKeys { ..file.site },
        ground: keys.ground.clone(),
    })
}

fn step(hour: Hour, time: DateTime, clock: DateTime, working_day: bool, keys: &YearKeys) -> Step {
    let clock = f64::from(clock.hour()) + f64::from(clock.minute()) / 60.0 + f64::from(clock.second()) / 3600.0;
    let day_counts = keys.hours.days == DaysKey::All || working_day;
    Step { hour, time, month: time.month().unsigned_abs(), clock, occupied: day_counts && keys.hours.hold(clock) }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::example::first_scene;
    use crate::study::scene_file::DstKey;
    use crate::study::year::settings;

    fn steps_with(offset: f64, days: &str) -> Steps {
        let text = format!(
            "weather = \"builtin:renton\"\nsun_offset_minutes = {offset:?}\nhours = {{ from = 8.0, to = 18.0, days = \"{days}\" }}"
        );
        let mut file = SceneFile { year: Some(toml::from_str(&text).unwrap()), ..first_scene() };
        // In standard time: the days on which Europe's clocks change are not those of the place.
        file.site.dst = DstKey::None;
        steps(&file, &settings(&file).unwrap(), Path::new("")).unwrap()
    }

    #[test]
    fn whole_hours_of_an_offset_move_people_and_the_rest_the_sun_alone() {
        let [plain, sun_alone, clock] = [0.0, 30.0, 150.0].map(|offset| steps_with(offset, "all"));
        let occupied = |steps: &Steps| steps.list.iter().filter(|step| step.occupied).count();
        assert!([&plain, &sun_alone, &clock].into_iter().all(|steps| occupied(steps) == 3650));
        for ((plain, sun_alone), clock) in plain.list.iter().zip(&sun_alone.list).zip(&clock.list) {
            assert_eq!((plain.time, plain.occupied), (sun_alone.time, sun_alone.occupied));
            assert_eq!(clock.time, plain.time.saturating_add(jiff::Span::new().hours(2)));
        }
        // The row of 6 to 7 h is that of 8 to 9 h, with the sun of half past eight and half an hour.
        assert!(!plain.list[6].occupied && clock.list[6].occupied);
    }

    #[test]
    fn a_typical_year_has_the_working_days_of_one_calendar() {
        let hours = steps_with(0.0, "weekdays").list.iter().filter(|step| step.occupied).count();
        assert!((2600..=2620).contains(&hours), "{hours}");
    }
}
