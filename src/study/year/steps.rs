//! Intervals of a weather file as steps of a year: nominal time, sun and sky of each.

use super::settings::Settings;
use crate::compute::sky::{Outside, Sun};
use crate::compute::weather::{Closure, Hour, Station};
use crate::study::error::StudyError;
use crate::study::scene_file::{SceneFile, SiteKeys, SkyKeys};
use crate::study::sky::{SkyKeyError, clock_warning, even_outside_of_hour, outside_of_hour, site_warnings};
use crate::study::weather::{kept, moment};
use crate::study::weather_keys::reading;
use crate::study::year_keys::{DaysKey, YearKeys};
use jiff::civil::DateTime;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::path::Path;
use std::sync::{Arc, OnceLock};

/// Number of the first weekday that is not a working day, counted from Monday = 0.
const SATURDAY: f64 = 5.0;
/// Number of hours of a common year.
const HOURS_OF_A_YEAR: f64 = 8760.0;

/// Step of a year: an interval of the weather file, or a part of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Position of the sun, irradiances and illuminances outdoors.
    pub hour: Hour,
    /// Nominal middle of the step in local standard time, in the year of the weather record; shifted by the whole hours
    /// of `sun_offset_minutes`.
    pub time: DateTime,
    /// Month of `time`, 1 … 12.
    pub month: u8,
    /// Local time by the clock, with daylight saving time where the site has it, in hours from midnight. \[h\]
    pub clock: f64,
    /// Whether the room is occupied in the step.
    pub occupied: bool,
}

/// All steps of a year, from a weather file.
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    /// Steps in the order of the file.
    pub list: Vec<Step>,
    /// Length of each step. \[h\]
    pub length: f64,
    /// Weather station of the file.
    pub station: Station,
    /// Test of the file's clock by its irradiances; `None` if it cannot be tested.
    pub closure: Option<Closure>,
    /// Time by which intervals were shifted from those in the file. \[min\]
    pub offset: f64,
    /// Whether the steps cover a whole year.
    pub whole: bool,
    /// Warnings for the user.
    pub warnings: Vec<String>,
    /// Codes of those warnings that concern the weather file itself.
    pub weather_warnings: Vec<&'static str>,
    /// Keys `[sky]` of the scene, for ground and skyline.
    sky: SkyKeys,
    site: SiteKeys,
    ground: Vec<f64>,
    found: Found,
}

/// Outside and sun of one step.
type Sky = (Outside, Option<Sun>);

/// Skies of the steps that were computed so far: shared by all copies of the steps, ignored when steps are compared.
#[derive(Debug, Clone)]
struct Found {
    /// Hash of everything on which the skies depend.
    number: u64,
    skies: Arc<Vec<OnceLock<Sky>>>,
}

impl PartialEq for Found {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Reads the weather file of a scene's year, and returns its steps. `base`: folder of the scene.
///
/// # Errors
/// Returns an error if the file cannot be read, or a value of a daytime hour is missing.
pub fn steps(file: &SceneFile, settings: &Settings, base: &Path) -> Result<Steps, StudyError> {
    let keys = &settings.keys;
    let kept = kept(&keys.weather, base).map_err(|error| StudyError::key("year.weather", error.to_string()))?;
    let weather = &kept.weather;
    let reading = reading(keys.light, keys.sun_offset_minutes);
    let wrong = |message: String| StudyError::key("year.weather", format!("{}: {message}", keys.weather.display()));
    let mut hours = weather.hours(reading).map_err(|error| wrong(error.to_string()))?;
    let offset = hours.offset();
    let parts = keys.steps_per_hour * u32::from(weather.interval) / 60;
    // Intervals shorter than an hour are steps without division.
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
    let mut warnings = site_warnings(&weather.station, &file.site);
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
    let mut number = DefaultHasher::new();
    kept.number.hash(&mut number);
    format!("{reading:?} {parts} {:?} {:?} {:?}", file.sky, file.site, keys.ground).hash(&mut number);
    let skies = Arc::new(list.iter().map(|_| OnceLock::new()).collect());
    Ok(Steps {
        whole: list.len() as f64 * length >= HOURS_OF_A_YEAR - 1e-6,
        found: Found { number: number.finish(), skies },
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
    /// Returns the index of the step whose interval contains a local standard time: of the same year if there is one,
    /// else of any year.
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

    /// Returns the reflectance of the ground in a step, 0 … 1.
    pub fn ground(&self, step: usize) -> f64 {
        let month = usize::from(self.list[step].month.clamp(1, 12)) - 1;
        self.ground.get(month).copied().unwrap_or(self.site.ground_reflectance)
    }

    /// Returns outside and sun of a step under a uniform sky, for controls that do not depend on the illuminance of the
    /// façade.
    ///
    /// # Errors
    /// Returns the errors of [`Self::outside`].
    pub fn even_outside(&self, step: usize) -> Result<(Outside, Option<Sun>), StudyError> {
        even_outside_of_hour(&self.list[step].hour, &self.sky, &self.site)
            .map_err(|SkyKeyError { key, message }| StudyError::key(key, message))
    }

    /// Returns the outside of a step (sky, ground and skyline), and its sun.
    ///
    /// # Errors
    /// Returns an error if a key of sky or site is out of range.
    pub fn outside(&self, step: usize) -> Result<(Outside, Option<Sun>), StudyError> {
        if let Some(found) = self.found.skies[step].get() {
            return Ok(found.clone());
        }
        let site = SiteKeys { ground_reflectance: self.ground(step), ..self.site };
        let found = outside_of_hour(&self.list[step].hour, &self.sky, &site)
            .map_err(|SkyKeyError { key, message }| StudyError::key(key, message))?;
        Ok(self.found.skies[step].get_or_init(|| found).clone())
    }

    /// Returns a number that identifies the skies of these steps, by which results for them are stored elsewhere: steps
    /// of the same weather data, sky and site have the same one.
    pub fn number(&self) -> u64 {
        self.found.number
    }

    /// Returns outside and sun of a step in radiometric units: sky, ground and sun by the irradiances of the hour, with
    /// the same relative distribution as for light. \[W/m²\] `per_lux`: factor by which a fixed luminance of the
    /// skyline becomes a radiance. \[W/lm\]
    ///
    /// # Errors
    /// Returns the errors of [`Self::outside`].
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
    /// Whether the illuminances in a step are to be computed.
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
    fn the_same_skies_have_the_same_number() {
        let number = |offset, days| steps_with(offset, days).number();
        assert_eq!(number(0.0, "all"), number(0.0, "weekdays"));
        assert_ne!(number(0.0, "all"), number(30.0, "all"));
    }

    #[test]
    fn a_typical_year_has_the_working_days_of_one_calendar() {
        let hours = steps_with(0.0, "weekdays").list.iter().filter(|step| step.occupied).count();
        assert!((2600..=2620).contains(&hours), "{hours}");
    }
}
