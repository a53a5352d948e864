//! Weather files by name: beside a scene, or years that come with the program.

use super::error::StudyError;
use super::files;
use crate::compute::limits;
use crate::compute::weather::Weather;
use crate::formats::weather;
use std::path::Path;

/// What the name of a year that comes with the program begins with.
pub const BUILTIN: &str = "builtin:";

/// A year that comes with the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BuiltinYear {
    /// What stands behind [`BUILTIN`].
    pub key: &'static str,
    /// In words: place, kind of year.
    pub words: &'static str,
    /// The table, see [`weather::table`].
    pub table: &'static str,
}

/// The years that come with the program; where they are from: `assets/weather/README.md`.
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

/// Reads a weather file, or a year that comes with the program (`builtin:new-york`). A name that is not absolute starts
/// from `base`.
///
/// # Errors
/// One sentence: the file, line and column in it, what is wrong, what would be right.
pub fn load(name: &Path, base: &Path) -> Result<Weather, StudyError> {
    let wrong = |message: String| StudyError::File { path: name.to_owned(), message };
    if let Some(key) = name.to_str().and_then(|name| name.strip_prefix(BUILTIN)) {
        let year = YEARS.iter().find(|year| year.key == key).ok_or_else(|| {
            let keys: Vec<String> = YEARS.iter().map(|year| format!("{BUILTIN}{}", year.key)).collect();
            wrong(format!("no such year comes with the program; expected {}", keys.join(", ")))
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
