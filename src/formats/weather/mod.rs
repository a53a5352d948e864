//! Weather files: EPW (EnergyPlus), WEA (Radiance), and the compact tables that come with the program.
//!
//! | file | reads | light |
//! | --- | --- | --- |
//! | `epw` | `.epw` | irradiances, illuminances beside them, dew point |
//! | `wea` | `.wea` | irradiances or illuminances alone |
//! | `labels` | hours and minutes of EPW rows | – |
//! | `table` | `cfs-weather 1` | irradiances and dew point of the hours with light |

mod epw;
mod fields;
mod labels;
pub mod table;
mod wea;

use super::encoding::{Encoding, any_text, decode};
use super::{FormatError, Location};
use crate::compute::weather::Weather;

/// Whether a file's name is that of a weather file.
pub fn is_weather_file(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    [".epw", ".wea", table::EXTENSION].iter().any(|end| name.ends_with(end))
}

/// Returns the file name extension of the weather format that the first word of a text identifies; `None` for other
/// texts.
pub fn extension_of(text: &str) -> Option<&'static str> {
    let words = [(table::MAGIC, table::EXTENSION), ("LOCATION", ".epw"), ("place", ".wea")];
    words.iter().find(|(word, _)| text.starts_with(word)).map(|(_, extension)| *extension)
}

/// Reads a weather file of any of the formats, recognised by its first word, then by its name; in UTF-8, UTF-16 or
/// Windows-1252, with any line ends.
///
/// # Errors
/// Returns an error with line, column, what was found and what was expected if the file is not valid.
pub fn read(name: &str, bytes: &[u8]) -> Result<Weather, FormatError> {
    // The mark of UTF-8 may stand before text of one byte a character.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = match decode(bytes) {
        Err(error) if error.encoding == Encoding::WebPage => return Err(error.into()),
        // A stray byte in a remark hurts nobody; a bad byte in a number makes a bad number.
        Err(_) => any_text(bytes).0.into(),
        Ok(text) => text,
    };
    let name = name.to_ascii_lowercase();
    let named = || [".epw", ".wea"].into_iter().find(|extension| name.ends_with(extension));
    match extension_of(&text).or_else(named) {
        Some(table::EXTENSION) => table::read(&text),
        Some(".epw") => epw::read(&text),
        Some(_) => wea::read(&text),
        None => {
            let expected = "EPW (first word LOCATION), WEA (first word place) or a cfs-weather table";
            Err(FormatError::new(Location::line(1), "no weather file of a known format", expected))
        }
    }
}
