//! Weather files: EPW (EnergyPlus), WEA (Radiance), and the compact tables that come with the program.
//!
//! | file | reads | light |
//! | --- | --- | --- |
//! | `epw` | `.epw` | irradiances, illuminances beside them, dew point |
//! | `wea` | `.wea` | irradiances or illuminances alone |
//! | `table` | `cfs-weather 1` | irradiances and dew point of the hours with light |

mod epw;
mod fields;
pub mod table;
mod wea;

use super::{FormatError, Location};
use crate::compute::weather::Weather;

/// Does a file's name say that it is one?
pub fn is_weather_file(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    [".epw", ".wea", table::EXTENSION].iter().any(|end| name.ends_with(end))
}

/// Reads a weather file of any of the formats, told by its first word, then by its name.
///
/// # Errors
/// Line and column, what is wrong there, what would be right.
pub fn read(name: &str, bytes: &[u8]) -> Result<Weather, FormatError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let name = name.to_ascii_lowercase();
    if bytes.starts_with(table::MAGIC.as_bytes()) {
        table::read(bytes)
    } else if bytes.starts_with(b"LOCATION") || name.ends_with(".epw") {
        epw::read(bytes)
    } else if bytes.starts_with(b"place") || name.ends_with(".wea") {
        wea::read(bytes)
    } else {
        let expected = "EPW (first word LOCATION), WEA (first word place) or a cfs-weather table";
        Err(FormatError::new(Location::line(1), "no weather file of a known format", expected))
    }
}
