//! Weather data by name: files relative to a scene, or built-in years.

use super::error::StudyError;
use super::files;
use crate::compute::btdf::{Finding, Severity};
use crate::compute::limits;
use crate::compute::weather::{Record, Station, Summary, Weather};
use crate::formats::weather;
use crate::texts::year as say;
use jiff::civil::{Date, DateTime};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;

/// Prefix of the names of built-in years.
pub const BUILTIN: &str = "builtin:";

/// Weather year that comes with the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BuiltinYear {
    /// Name of the year without the prefix [`BUILTIN`].
    pub key: &'static str,
    /// Description of the year in English: place, kind of year.
    pub words: &'static str,
    /// Weather data of the year as text, see [`weather::table`].
    pub table: &'static str,
}

/// Built-in years; for their sources see `assets/weather/README.md`.
pub const YEARS: [BuiltinYear; 3] = [
    BuiltinYear {
        key: "new-york",
        words: "New York, Central Park, 41° N: hot summers, cold and sunny winters",
        table: include_str!("../../assets/weather/new-york.weather.txt"),
    },
    BuiltinYear {
        key: "piedmont",
        words: "Piedmont, northern Italy, 45° N: sunny summers, misty winters",
        table: include_str!("../../assets/weather/piedmont.weather.txt"),
    },
    BuiltinYear {
        key: "renton",
        words: "Renton near Seattle, 47° N: dry summers, long overcast winters",
        table: include_str!("../../assets/weather/renton.weather.txt"),
    },
];

impl BuiltinYear {
    /// Returns the name by which scenes refer to the year, such as `builtin:renton`.
    pub fn name(&self) -> PathBuf {
        PathBuf::from(format!("{BUILTIN}{}", self.key))
    }

    /// Returns latitude (north positive) and longitude (east positive) of the year's station, from the head of its
    /// table. \[°\]
    pub fn place(&self) -> Option<[f64; 2]> {
        let of = |key: &str| self.head(key)?.parse().ok();
        Some([of("latitude")?, of("longitude")?])
    }

    /// Whether the data of a weather station are those of this year.
    pub fn is_of(&self, station: &Station) -> bool {
        self.head("name") == Some(station.name.as_str()) && self.place() == Some([station.latitude, station.longitude])
    }

    /// Returns the value of a key in the head of the year's table.
    fn head(&self, key: &str) -> Option<&'static str> {
        let head = self.table.lines().take_while(|line| !line.is_empty());
        let mut values = head.filter_map(|line| line.split_once('='));
        values.find(|(name, _)| name.trim() == key).map(|(_, value)| value.trim())
    }
}

/// Returns the description of a built-in weather year in the current language: place, kind of year.
pub fn words(year: &BuiltinYear) -> &'static str {
    match year.key {
        "new-york" => say::NEW_YORK.get(),
        "piedmont" => say::PIEDMONT.get(),
        "renton" => say::RENTON.get(),
        _ => year.words,
    }
}

/// Returns a short name for weather data: the place of a built-in year, else the name of the file.
pub fn short_name(name: &Path) -> String {
    let built_in = YEARS.iter().find(|year| *name == *year.name());
    // The place is the text before the first comma.
    let place = built_in.map(|year| words(year).split(',').next().unwrap_or_default().to_owned());
    place.unwrap_or_else(|| name.file_name().unwrap_or(name.as_os_str()).to_string_lossy().into_owned())
}

/// Returns the built-in year whose station is nearest to a place, along the earth's surface. `place`: latitude and
/// longitude. \[°\]
pub fn nearest(place: [f64; 2]) -> &'static BuiltinYear {
    let upright = |[latitude, longitude]: [f64; 2]| {
        let (latitude, longitude) = (latitude.to_radians(), longitude.to_radians());
        let flat = latitude.cos();
        [flat * longitude.cos(), flat * longitude.sin(), latitude.sin()]
    };
    let here = upright(place);
    let near = |year: &BuiltinYear| {
        let there = upright(year.place().unwrap_or([f64::NAN; 2]));
        here.iter().zip(there).map(|(a, b)| a * b).sum::<f64>()
    };
    // A year without a place is never the nearest.
    let better = |a: f64, b: f64| a > b || b.is_nan();
    YEARS.iter().fold(&YEARS[0], |best, year| if better(near(year), near(best)) { year } else { best })
}

/// Reads weather data like [`load`], and stores them as long as the file does not change. `base`: folder to which the
/// name is relative.
///
/// # Errors
/// Returns the errors of [`load`].
pub fn kept(name: &Path, base: &Path) -> Result<Arc<KeptWeather>, StudyError> {
    type Known = (PathBuf, Option<(SystemTime, u64)>, Arc<KeptWeather>);
    static KEPT: Mutex<Vec<Known>> = Mutex::new(Vec::new());
    static NUMBERS: AtomicU64 = AtomicU64::new(0);
    const MOST: usize = 4;
    // Stored values are complete even if another thread has failed while it held the lock.
    let kept = || KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    let path = if name.to_str().is_some_and(|name| name.starts_with(BUILTIN)) { name.into() } else { base.join(name) };
    let stamp = std::fs::metadata(&path).ok().and_then(|meta| Some((meta.modified().ok()?, meta.len())));
    if let Some((.., weather)) = kept().iter().find(|known| known.0 == path && known.1 == stamp) {
        return Ok(Arc::clone(weather));
    }
    let weather = load(name, base)?;
    let summary =
        weather.examine().map_err(|error| StudyError::File { path: name.into(), message: error.to_string() })?;
    let made = Arc::new(KeptWeather { number: NUMBERS.fetch_add(1, Ordering::Relaxed), weather, summary });
    let mut list = kept();
    list.retain(|known| known.0 != path);
    list.truncate(MOST - 1);
    list.insert(0, (path, stamp, Arc::clone(&made)));
    Ok(made)
}

/// Weather data with their summary, stored while the program runs.
pub struct KeptWeather {
    /// Number that no other weather data have.
    pub number: u64,
    /// Weather data of the file.
    pub weather: Weather,
    /// Summary of the data: test of the file's clock, and findings.
    pub summary: Summary,
}

impl KeptWeather {
    /// Returns the warnings that concern every result from the weather data. Not included are the test of the clock,
    /// which depends on how the file is read, and missing values, which depend on the requested part of the year.
    pub fn warnings(&self) -> impl Iterator<Item = &Finding> {
        let depends = |code: &str| matches!(code, "clock-off" | "partial-year");
        self.summary.findings.iter().filter(move |one| one.severity > Severity::Info && !depends(one.code))
    }
}

/// Returns a warning about a weather file in the current language, by its code; the code itself if there is no text for
/// it.
pub fn warning_words(code: &'static str) -> &'static str {
    let words = match code {
        "gaps" => say::WEATHER_GAPS,
        "order" => say::WEATHER_ORDER,
        "light-missing" => say::WEATHER_MISSING,
        "sun-down-light" => say::WEATHER_SUN_DOWN,
        "black-sky" => say::WEATHER_BLACK_SKY,
        "summer-time" => say::WEATHER_SUMMER_TIME,
        "zone" => say::WEATHER_ZONE,
        "direct-horizontal" => say::WEATHER_DIRECT_HORIZONTAL,
        "not-closed" => say::WEATHER_NOT_CLOSED,
        "unit-watt-hours" => say::WEATHER_WATT_HOURS,
        "records-per-hour" => say::WEATHER_RECORDS,
        _ => return code,
    };
    words.get()
}

/// Returns a time of a weather record in local standard time. `seconds`: time from midnight of the record's day. A 29th
/// of February in a common year is accepted in a file, but counted as the 28th, because no calendar has it.
pub fn moment(record: &Record, seconds: f64) -> DateTime {
    let day = record.day;
    let of = |number: u8| Date::new(day.year, day.month.cast_signed(), number.cast_signed());
    let date = of(day.day).or_else(|_| of(28)).unwrap_or(Date::MIN);
    date.at(0, 0, 0, 0).saturating_add(jiff::Span::new().seconds(seconds.round() as i64))
}

/// Reads a weather file, or a built-in year (`builtin:new-york`). `base`: folder to which a relative name refers.
///
/// # Errors
/// Returns an error that names the file with line and column, the error, and what is expected.
pub fn load(name: &Path, base: &Path) -> Result<Weather, StudyError> {
    let wrong = |message: String| StudyError::File { path: name.to_owned(), message };
    if let Some(key) = name.to_str().and_then(|name| name.strip_prefix(BUILTIN)) {
        let year = YEARS.iter().find(|year| year.key == key).ok_or_else(|| {
            let keys: Vec<String> = YEARS.iter().map(|year| format!("{BUILTIN}{}", year.key)).collect();
            wrong(format!("not a built-in year; expected {}", keys.join(", ")))
        })?;
        return weather::read(key, year.table.as_bytes()).map_err(|error| wrong(error.to_string()));
    }
    let path = base.join(name);
    if let Ok(meta) = std::fs::metadata(&path)
        && meta.len() > limits::WEATHER_BYTES
    {
        let [size, most] = [meta.len(), limits::WEATHER_BYTES].map(|bytes| bytes >> 20);
        return Err(wrong(format!("{size} MB; expected a weather file of at most {most} MB")));
    }
    let bytes = files::read(&path)?;
    weather::read(&path.to_string_lossy(), &bytes)
        .map_err(|error| StudyError::File { path, message: error.to_string() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_year_is_that_of_the_same_coast() {
        for (place, key) in [
            ([48.78, 9.18], "piedmont"),
            ([42.36, -71.06], "new-york"),
            ([37.77, -122.42], "renton"),
            // Over the pole and across the date line.
            ([64.5, 177.5], "renton"),
        ] {
            assert_eq!(nearest(place).key, key, "{place:?}");
        }
    }

    #[test]
    fn heads_of_tables_say_the_place_that_their_readers_find() {
        for year in &YEARS {
            let station = load(&year.name(), Path::new("")).unwrap().station;
            assert_eq!(year.place(), Some([station.latitude, station.longitude]), "{}", year.key);
        }
    }
}
