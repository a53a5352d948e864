//! The year at work: what is asked of it, its job, and the weather that hours are picked from.

use super::engine::Question;
use super::jobs::Lane;
use super::state::Shown;
use super::tiles;
use super::window::App;
use super::work::Outcome;
use crate::compute::weather::{Closure, Station, Weather};
use crate::drawing::hour_map::HourMap;
use crate::study::scene_file::{SceneFile, SkyKeys, SkyModelKey, TimeKey};
use crate::study::sun_position::parse_local_time;
use crate::study::weather::{YEARS, load, nearest};
use crate::study::weather_keys::{LightKey, OffsetKey, reading};
use crate::study::year::{Annual, Look, at_step, weather_map};
use crate::study::year_keys::{DaysKey, EyeKeys, HoursKeys, LampControlKey, LightingKeys, YearKeys};
use crate::study::{StudyError, example::first_scene};
use crate::texts::{fixed, year as say};
use jiff::civil::{DateTime, date};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What is asked about a year.
#[derive(Debug, Clone, PartialEq)]
pub enum YearAct {
    /// Compute the year of the present scene; a scene without one is given one first.
    Compute,
    /// Look at something else of it.
    Look(Look),
    /// Show a step of the year that is shown in every tile.
    Show(usize),
    /// Take a year of weather: for the scene's year, where it has one or the tile is asked, else as its sky.
    Weather(PathBuf),
    /// The same for the year alone.
    WeatherOfYear(PathBuf),
    /// The sky of a record of the weather.
    Pick(DateTime),
}

impl YearAct {
    /// Is what it changes in the document a step of its own for undo?
    pub const fn is_step(&self) -> bool {
        !matches!(self, Self::Look(_))
    }
}

/// A weather file as hours are picked from it.
#[derive(Debug, Clone)]
pub struct Calendar {
    /// As scenes name it, and what relative names start from.
    pub key: CalendarKey,
    /// Where it is from.
    pub station: Station,
    /// Test of its clock, where there is one.
    pub closure: Option<Closure>,
    /// Direct normal, and diffuse horizontal.
    pub maps: [HourMap; 2],
    /// Begin of every record, in the file's order.
    pub starts: Vec<DateTime>,
}

/// What a calendar hangs on: the weather's name, the folder that it starts from, and how it is read.
pub type CalendarKey = (PathBuf, PathBuf, LightKey, OffsetKey);

impl Calendar {
    /// Reads it.
    ///
    /// # Errors
    /// A file that cannot be read, or a clock that cannot be tested.
    pub fn read(key: CalendarKey) -> Result<Self, StudyError> {
        let weather = load(&key.0, &key.1)?;
        let reading = reading(key.2, key.3);
        let told = |message: String| StudyError::File { path: key.0.clone(), message };
        weather.hours(reading).map_err(|error| told(error.to_string()))?;
        let closure = weather.closure().map_err(|error| told(error.to_string()))?;
        let maps = [true, false].map(|direct| weather_map(&weather, reading, direct));
        let starts = starts(&weather);
        Ok(Self { station: weather.station, closure, maps, starts, key })
    }
}

fn starts(weather: &Weather) -> Vec<DateTime> {
    let of = |record: &crate::compute::weather::Record| {
        let day = record.day;
        let at = |number: u8| jiff::civil::Date::new(day.year, day.month.cast_signed(), number.cast_signed()).ok();
        // A 29th of February in a common year is no date.
        let date = at(day.day).or_else(|| at(28)).unwrap_or(date(2001, 1, 1));
        let (hour, minute) = ((record.start / 60) as i8, (record.start % 60) as i8);
        date.at(hour.min(23), minute, 0, 0)
    };
    weather.records.iter().map(of).collect()
}

/// The weather that the scene speaks of: of its sky, else of its year.
pub fn weather_of(scene: &SceneFile) -> Option<&Path> {
    scene.sky.weather.as_deref().or_else(|| scene.year.as_ref().map(|year| &*year.weather))
}

/// The weather of the scene's year; of one that it would be given, that of the nearest place.
pub fn weather_of_year(scene: &SceneFile) -> PathBuf {
    if let Some(keys) = &scene.year {
        return keys.weather.clone();
    }
    scene.sky.weather.clone().unwrap_or_else(|| {
        let site = &scene.site;
        let place = site.latitude.zip(site.longitude).map(|(latitude, longitude)| [latitude, longitude]);
        place.map_or(&YEARS[0], nearest).name()
    })
}

/// A year for a scene without one: its weather, an eye in the middle of the room that looks at the façade, and usual lamps.
pub fn usual_year(scene: &SceneFile) -> YearKeys {
    YearKeys {
        weather: weather_of_year(scene),
        light: scene.sky.light,
        sun_offset_minutes: scene.sky.sun_offset_minutes,
        steps_per_hour: 1,
        hours: HoursKeys { days: DaysKey::Weekdays, ..HoursKeys::default() },
        ground: Vec::new(),
        eyes: vec![usual_eye(scene)],
        lighting: Some(usual_lamps()),
    }
}

/// Half way into the room, at the height of who sits, looking at the façade.
pub fn usual_eye(scene: &SceneFile) -> EyeKeys {
    let room = &scene.room;
    EyeKeys { point: [0.5 * room.width, 0.5 * room.depth, 1.2_f64.min(room.height)], direction: [0.0, -1.0, 0.0] }
}

/// Lamps as they are usual over desks.
pub const fn usual_lamps() -> LightingKeys {
    LightingKeys {
        power: 8.0,
        target: 500.0,
        control: LampControlKey::Dimming,
        steps: 3,
        min_light: 0.0,
        min_power: 0.0,
        off: true,
        standby: 0.0,
        zones: Vec::new(),
    }
}

/// The sky of a record of a weather; what stands before it stays.
fn put_record(scene: &mut SceneFile, weather: &Path, time: DateTime) {
    let year = scene.year.as_ref().filter(|year| year.weather == weather);
    let same = scene.sky.weather.as_deref() == Some(weather);
    let (light, offset) = match year {
        Some(year) => (year.light, year.sun_offset_minutes),
        None if same => (scene.sky.light, scene.sky.sun_offset_minutes),
        None => Default::default(),
    };
    let plain = first_scene().sky;
    scene.sky = SkyKeys {
        model: SkyModelKey::Weather,
        weather: Some(weather.to_owned()),
        light,
        sun_offset_minutes: offset,
        cie_type: None,
        illuminance: Default::default(),
        time: Some(TimeKey::Text(time.strftime("%Y-%m-%dT%H:%M").to_string())),
        turbidity: scene.sky.turbidity,
        obstruction: scene.sky.obstruction.clone(),
        skyline: scene.sky.skyline.clone(),
        ..plain
    };
}

impl App {
    /// Does what was asked about a year.
    pub(super) fn year_act(&mut self, act: YearAct) {
        match act {
            YearAct::Compute => self.compute_year(),
            YearAct::Look(look) => self.state.settings.year = look,
            YearAct::Show(step) => {
                if let Some(annual) = self.results.annual.value.clone()
                    && step < annual.year.steps.list.len()
                {
                    self.state.document.scene = at_step(&self.state.document.scene, &annual.year, step);
                }
            }
            YearAct::WeatherOfYear(name) => {
                let scene = &mut self.state.document.scene;
                let mut keys = scene.year.take().unwrap_or_else(|| usual_year(scene));
                keys.weather = name;
                scene.year = Some(keys);
            }
            YearAct::Weather(name) => self.take_weather(name),
            YearAct::Pick(time) => {
                let scene = &mut self.state.document.scene;
                if let Some(weather) = weather_of(scene).map(Path::to_owned) {
                    put_record(scene, &weather, time);
                }
            }
        }
    }

    /// The weather becomes the scene's: its sky at the present moment is that of the weather, and its year too.
    fn take_weather(&mut self, name: PathBuf) {
        let scene = &mut self.state.document.scene;
        if let Some(year) = &mut scene.year {
            year.weather.clone_from(&name);
        }
        let time = scene.sky.time.as_ref().and_then(|time| parse_local_time(&time.text()).ok());
        put_record(scene, &name, time.unwrap_or(date(2026, 3, 21).at(12, 0, 0, 0)));
    }

    fn compute_year(&mut self) {
        let Some(shelf) = self.state.shelf() else {
            self.toasts.info(crate::texts::shell::CATALOGUE_NOT_OPEN);
            return;
        };
        let scene = &mut self.state.document.scene;
        if scene.year.is_none() {
            let keys = usual_year(scene);
            self.toasts.info(say::ADDED_EYE);
            scene.year = Some(keys);
        }
        let question = Question { scene: scene.clone(), base: self.state.base(), shelf };
        let engine = self.services.engine.clone();
        self.results.annual.error = None;
        self.bring_up(tiles::YEAR);
        self.start(Lane::Annual, move |job| Outcome::Annual(engine.year(&question, job).map(Box::new)));
    }

    /// Reads the weather that hours are picked from, when it is another one.
    pub(super) fn ask_weather(&mut self) {
        let scene = &self.state.document.scene;
        let key = weather_of(scene).map(|name| {
            let year = scene.year.as_ref().filter(|year| year.weather == name);
            let own = (scene.sky.light, scene.sky.sun_offset_minutes);
            let (light, offset) = year.map_or(own, |year| (year.light, year.sun_offset_minutes));
            (name.to_owned(), self.state.base(), light, offset)
        });
        if key == self.asked_weather {
            return;
        }
        self.asked_weather.clone_from(&key);
        self.results.weather.stale = true;
        match key {
            Some(key) => self.start(Lane::Weather, move |_| Outcome::Weather(Calendar::read(key).map(Box::new))),
            None => {
                self.jobs.cancel(Lane::Weather);
                self.results.weather = Shown::default();
            }
        }
    }

    /// A weather file that was opened or dropped.
    pub(super) fn take_weather_file(&mut self, path: &Path) {
        let base = self.state.base();
        // Beside the scene it is found wherever both go.
        let name = path.strip_prefix(&base).ok().filter(|_| !base.as_os_str().is_empty()).unwrap_or(path).to_owned();
        self.toasts.success(say::weather_taken(name.display()));
        self.apply(super::command::Command::Year(YearAct::Weather(name)));
    }

    /// The year that is shown, where it is that of the present scene.
    pub(super) fn present_year(&self) -> Option<Arc<Annual>> {
        self.results.annual.value.clone().filter(|annual| annual.is_of(&self.state.document.scene))
    }
}

/// Place and clock of a station in words.
pub fn station_words(station: &Station) -> String {
    let place = crate::study::scene_words::coordinates(station.latitude, station.longitude);
    let name = if station.name.is_empty() { fixed(station.elevation, 0) } else { station.name.clone() };
    say::weather_is(crate::texts::one_line(&name), place, crate::texts::one_line(&station.source))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::year::settings;

    #[test]
    fn a_scene_without_a_year_gets_one_that_holds() {
        let mut scene = first_scene();
        scene.room.height = 1.1;
        scene.year = Some(usual_year(&scene));
        assert_eq!(weather_of_year(&scene), PathBuf::from("builtin:piedmont"));
        let settings = settings(&scene).unwrap();
        assert_eq!((settings.eyes.len(), settings.sensors), (1, 16 * 24));
        assert!(settings.lamps.is_some());
        // The weather that the sky is of already comes first.
        let mut scene = first_scene();
        scene.sky.weather = Some("a.epw".into());
        assert_eq!(usual_year(&scene).weather, PathBuf::from("a.epw"));
    }

    #[test]
    fn a_record_is_a_sky_that_the_study_reads() {
        let mut scene = first_scene();
        let name = YEARS[1].name();
        let calendar =
            Calendar::read((name.clone(), PathBuf::new(), LightKey::default(), OffsetKey::default())).unwrap();
        let map = &calendar.maps[0];
        let cell = map.cell(7, 1, 12 * 60).unwrap();
        let time = calendar.starts[map.from[cell].unwrap() as usize];
        put_record(&mut scene, &name, time);
        let text = toml::to_string(&scene).unwrap();
        let back = SceneFile::parse(&text).unwrap();
        assert_eq!(back.sky, scene.sky);
        let hour = crate::study::sky::hour_of_weather(&scene.sky, &scene.site, Path::new("")).unwrap().unwrap();
        assert_eq!(hour.hour.direct_normal_irradiance, map.values[cell]);
        assert!(hour.interval.ends_with("12:00–13:00"), "{}", hour.interval);
    }
}
