//! Gazetteer: table of countries and cities with coordinates, as lines of text with tabs between their fields,
//! compressed with zstd.
//!
//! Countries (code, name) are listed before an empty line, cities after it in the order of falling population: name,
//! code of the country, state (may be empty), latitude and longitude \[°\], elevation \[m\] (may be empty), UTC offset
//! \[h\], other names separated by commas. The table is made by `assets/places/draw.py`.

use super::location::excerpt;
use std::collections::BTreeMap;
use std::io::Read as _;
use std::sync::Arc;

/// Maximum uncompressed size of the table. \[bytes\]
const LARGEST: u64 = 1 << 24;

/// City of the gazetteer: names, country, coordinates, elevation and UTC offset.
#[derive(Debug, Clone, PartialEq)]
pub struct City {
    /// Name of the city in its original spelling.
    pub name: Box<str>,
    /// Name of the city's country.
    pub country: Arc<str>,
    /// Two-letter code of the city's country, ISO 3166.
    pub code: [char; 2],
    /// State or province, where it is needed to distinguish cities with the same name; else empty.
    pub region: Box<str>,
    /// Latitude of the city, north positive. \[°\]
    pub latitude: f64,
    /// Longitude of the city, east positive. \[°\]
    pub longitude: f64,
    /// Elevation of the city above sea level; `None` if unknown. \[m\]
    pub elevation: Option<f64>,
    /// UTC offset of the city's standard time, positive ahead of UTC. \[h\]
    pub utc_offset: f64,
    /// Other names of the city, in lower case without accents; the first is the plain form of `name` if that has
    /// accents.
    pub other_names: Vec<Box<str>>,
}

/// Error in reading the gazetteer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GazetteerError {
    /// Bytes that are not text compressed with zstd.
    #[error("no text compressed with zstd: {0}")]
    Packed(String),
    /// Line of the table that is not valid.
    #[error("line {line}: {found} (expected {expected})")]
    Line {
        /// Line number, from 1.
        line: usize,
        /// Text of the message: what was found in the line.
        found: String,
        /// Text of the message: what was expected.
        expected: &'static str,
    },
}

/// Reads the gazetteer from its compressed bytes; cities are returned in the order of the table.
///
/// # Errors
/// Returns an error with the line and what is wrong with it.
pub fn read_cities(packed: &[u8]) -> Result<Vec<City>, GazetteerError> {
    let unreadable = |error: std::io::Error| GazetteerError::Packed(error.to_string());
    let mut text = String::new();
    let decoder = zstd::stream::read::Decoder::new(packed).map_err(unreadable)?;
    decoder.take(LARGEST).read_to_string(&mut text).map_err(unreadable)?;
    let mut lines = text.lines().enumerate();
    let mut countries = BTreeMap::new();
    for (number, line) in lines.by_ref() {
        if line.is_empty() {
            break;
        }
        let (code, name) = line.split_once('\t').ok_or_else(|| GazetteerError::Line {
            line: number + 1,
            found: excerpt(line),
            expected: "code and name of a country",
        })?;
        countries.insert(code, Arc::<str>::from(name));
    }
    lines.map(|(number, line)| city(line, number + 1, &countries)).collect()
}

fn city(text: &str, line: usize, countries: &BTreeMap<&str, Arc<str>>) -> Result<City, GazetteerError> {
    let wrong = |found: &str, expected| GazetteerError::Line { line, found: excerpt(found), expected };
    let fields: Vec<&str> = text.split('\t').collect();
    let [name, code, region, latitude, longitude, elevation, utc_offset, others] = fields[..] else {
        return Err(wrong(text, "eight fields with tabs between"));
    };
    let within = |text: &str, most: f64, expected| {
        text.parse::<f64>().ok().filter(|value| value.abs() <= most).ok_or_else(|| wrong(text, expected))
    };
    let country = countries.get(code).ok_or_else(|| wrong(code, "the code of a country above"))?;
    let mut letters = code.chars();
    let (Some(first), Some(second), None) = (letters.next(), letters.next(), letters.next()) else {
        return Err(wrong(code, "a code of two letters"));
    };
    let elevation = match elevation {
        "" => None,
        text => Some(within(text, 9000.0, "an elevation in metres")?),
    };
    Ok(City {
        name: name.into(),
        country: country.clone(),
        code: [first, second],
        region: region.into(),
        latitude: within(latitude, 90.0, "a latitude in degrees")?,
        longitude: within(longitude, 180.0, "a longitude in degrees")?,
        elevation,
        utc_offset: within(utc_offset, 14.0, "hours ahead of UTC")?,
        other_names: others.split(',').filter(|name| !name.is_empty()).map(Into::into).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<City>, GazetteerError> {
        read_cities(&zstd::bulk::compress(text.as_bytes(), 1).unwrap())
    }

    #[test]
    fn fields_come_where_they_belong() {
        let list = read(
            "DE\tGermany\nUS\tUnited States\n\nKöln\tDE\t\t50.93\t6.95\t58\t1\tkoln,cologne\nPortland\tUS\tOR\t45.52\t-122.68\t\t-8\t\n",
        );
        let list = list.unwrap();
        assert_eq!((&*list[0].name, &*list[0].country, list[0].elevation), ("Köln", "Germany", Some(58.0)));
        assert_eq!((list[0].latitude, list[0].longitude, list[0].utc_offset), (50.93, 6.95, 1.0));
        assert_eq!(list[0].other_names, ["koln".into(), "cologne".into()]);
        assert_eq!((&*list[1].region, list[1].elevation, list[1].other_names.len()), ("OR", None, 0));
    }

    #[test]
    fn what_cannot_be_read_is_told_by_its_line() {
        let told = |text: &str| read(text).unwrap_err().to_string();
        assert!(told("DE\n\n").starts_with("line 1: DE (expected code and name"));
        assert!(told("DE\tGermany\n\nA\tFR\t\t1\t2\t3\t1\t\n").contains("line 3: FR"));
        assert!(told("DE\tGermany\n\nA\tDE\t\t91\t2\t3\t1\t\n").contains("91 (expected a latitude"));
        assert!(told("DE\tGermany\n\nA\tDE\t1\t2\n").contains("eight fields"));
        assert!(matches!(read_cities(b"plain"), Err(GazetteerError::Packed(_))));
    }
}
