//! Annual simulation in the window: its commands, the calendar of a weather file from which hours are chosen, and the
//! default settings for a scene without any.

use crate::compute::weather::{Closure, Record, Station};
use crate::drawing::hour_map::HourMap;
use crate::study::scene_file::{SceneFile, SkyKeys, SkyModelKey, TimeKey};
use crate::study::weather::{YEARS, kept, moment, nearest};
use crate::study::weather_keys::{LightKey, OffsetKey, reading};
use crate::study::year::{Look, weather_map};
use crate::study::year_keys::{DaysKey, EyeKeys, HoursKeys, LampControlKey, LightingKeys, SunlightKeys, YearKeys};
use crate::study::{StudyError, example::first_scene, scene_words};
use crate::texts::{one_line, year as say};
use jiff::civil::DateTime;
use std::path::{Path, PathBuf};

/// Command about the annual simulation.
#[derive(Debug, Clone, PartialEq)]
pub enum YearAct {
    /// Compute the annual simulation of the current scene, which first gets default settings if it has none.
    Compute,
    /// Change the display settings of the annual simulation.
    Look(Look),
    /// Show a step of the annual simulation, by its index, in every tile. `true` if the user steps with keys.
    Show(usize, bool),
    /// Set the weather file of the scene's sky, and of its annual simulation if it has settings for one.
    Weather(PathBuf),
    /// Set the weather file of the scene's annual simulation alone.
    WeatherOfYear(PathBuf),
    /// Set the sky to the record of the weather file at a date and time. `true` if the user steps with keys.
    Pick(DateTime, bool),
}

impl YearAct {
    /// Whether the change of the document is a separate undo step; stepping with keys is not.
    pub const fn is_step(&self) -> bool {
        !matches!(self, Self::Look(_) | Self::Show(_, true) | Self::Pick(_, true))
    }
}

/// Calendar of a weather file, from which hours are chosen.
#[derive(Debug, Clone)]
pub struct Calendar {
    /// Key of the calendar: weather file and reading options.
    pub key: CalendarKey,
    /// Station of the weather file.
    pub station: Station,
    /// Test of the file's clock against its irradiances; `None` if there is none.
    pub closure: Option<Closure>,
    /// Codes of the file's warnings.
    pub warnings: Vec<&'static str>,
    /// Maps of direct normal and of diffuse horizontal illuminance \[lx\] or irradiance \[W/m²\], according to the
    /// file, for every hour.
    pub maps: [HourMap; 2],
    /// Start of every record in local standard time, in the file's order.
    pub starts: Vec<DateTime>,
}

/// Key of a calendar: name of the weather file, folder to which it is relative, and the two reading options (source of
/// illuminances, offset of the sun's position).
pub type CalendarKey = (PathBuf, PathBuf, LightKey, OffsetKey);

impl Calendar {
    /// Reads the weather file of a key.
    ///
    /// # Errors
    /// Returns an error if the file cannot be read or its clock cannot be tested.
    pub fn read(key: CalendarKey) -> Result<Self, StudyError> {
        let kept = kept(&key.0, &key.1)?;
        let weather = &kept.weather;
        let reading = reading(key.2, key.3);
        let failed = |message: String| StudyError::File { path: key.0.clone(), message };
        let moved = 60 * weather.hours(reading).map_err(|error| failed(error.to_string()))?.moved_clock();
        let maps = [true, false].map(|direct| weather_map(weather, reading, direct));
        let start = |record: &Record| moment(record, f64::from(record.start + moved));
        let starts = weather.records.iter().map(start).collect();
        let warnings = kept.warnings().map(|one| one.code).collect();
        Ok(Self { station: weather.station.clone(), closure: kept.summary.closure, warnings, maps, starts, key })
    }
}

/// Returns the weather file of a scene: that of its sky, else that of its annual simulation; `None` if it has none.
pub fn weather_of(scene: &SceneFile) -> Option<&Path> {
    scene.sky.weather.as_deref().or_else(|| scene.year.as_ref().map(|year| &*year.weather))
}

/// Returns the weather file of the scene's annual simulation; if it has no settings for one, that of its sky, else the
/// built-in one of the nearest station.
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

/// Returns default settings of an annual simulation for a scene: its weather file, an observer in the middle of the
/// room who faces the façade, and default electric lighting.
pub fn usual_year(scene: &SceneFile) -> YearKeys {
    YearKeys {
        weather: weather_of_year(scene),
        light: scene.sky.light,
        sun_offset_minutes: scene.sky.sun_offset_minutes,
        steps_per_hour: 1,
        hours: HoursKeys { days: DaysKey::Weekdays, ..HoursKeys::default() },
        ground: Vec::new(),
        eyes: vec![usual_eye(scene)],
        solar: false,
        lm83: false,
        dgp: true,
        sunlight: SunlightKeys::default(),
        lighting: Some(usual_lamps()),
    }
}

/// Returns the default observer: in the middle of the room, at the eye height of a seated person (1.2 m), facing the
/// façade.
pub fn usual_eye(scene: &SceneFile) -> EyeKeys {
    let room = &scene.room;
    EyeKeys { point: [0.5 * room.width, 0.5 * room.depth, 1.2_f64.min(room.height)], direction: [0.0, -1.0, 0.0] }
}

/// Returns the default electric lighting, as for desks: 8 W/m², dimmed to 500 lx.
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

/// Sets the sky of a scene to the record of a weather file at a date and time; turbidity, obstruction and skyline of
/// the sky are not changed.
pub fn put_record(scene: &mut SceneFile, weather: &Path, time: DateTime) {
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
        time: Some(TimeKey::of(time)),
        turbidity: scene.sky.turbidity,
        obstruction: scene.sky.obstruction,
        skyline: scene.sky.skyline.clone(),
        ..plain
    };
}

/// Returns name, coordinates and data source of a weather station as text.
pub fn station_words(station: &Station) -> String {
    say::weather_is(scene_words::station_place(station), one_line(&station.source))
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

    /// An interval that begins between two minutes is not the one before it.
    #[test]
    fn a_record_is_named_to_the_second() {
        let mut scene = first_scene();
        put_record(&mut scene, Path::new("a.wea"), "2001-06-21T23:52:30".parse().unwrap());
        assert_eq!(scene.sky.time, Some(TimeKey::Text("2001-06-21T23:52:30".to_owned())));
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
        let clock = scene.site.dst.clock(time, calendar.station.utc_offset);
        put_record(&mut scene, &name, clock);
        let text = toml::to_string(&scene).unwrap();
        let back = SceneFile::parse(&text).unwrap();
        assert_eq!(back.sky, scene.sky);
        let hour = crate::study::sky::hour_of_weather(&scene.sky, &scene.site, Path::new("")).unwrap().unwrap();
        assert_eq!(hour.hour.direct_normal_irradiance, map.values[cell]);
        assert!(hour.interval.ends_with("12:00–13:00"), "{}", hour.interval);
    }
}
