//! TOML header of a `.btdf.txt` file: it is found between two lines `---` and checked key by key.

use super::{FAMILY, FORMAT};
use crate::compute::btdf::{Component, DescribedState};
use crate::formats::beams::{NAME, StoredDescription, VERSION};
use crate::formats::location::{FormatError, Location, excerpt};
use serde::Deserialize;
use toml::Spanned;

/// Maximum size of a header, more than any needs, which bounds the work of the TOML parser. \[bytes\]
const MOST_HEADER: usize = 4 << 20;

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Quantity {
    Btdf,
    Brdf,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum LightFrom {
    Outside,
    Inside,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Layout {
    Rings,
    Points,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub(super) enum IncidenceChoice {
    #[serde(rename = "tregenza-145")]
    Tregenza,
    #[serde(rename = "klems-145")]
    Klems,
    #[serde(rename = "listed")]
    Listed,
}

impl IncidenceChoice {
    /// Returns the value of the key `incidence` as written in the header.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Tregenza => "tregenza-145",
            Self::Klems => "klems-145",
            Self::Listed => "listed",
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Symmetry {
    LeftRight,
    UpDown,
    Both,
    Rotational,
}

impl Symmetry {
    /// Returns the value of the key `symmetry` as written in the header.
    pub const fn word(self) -> &'static str {
        match self {
            Self::LeftRight => "left-right",
            Self::UpDown => "up-down",
            Self::Both => "both",
            Self::Rotational => "rotational",
        }
    }
}

/// Key of a state, which may be written as a number.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
enum Key {
    Text(String),
    Whole(i64),
    Number(f64),
}

impl Key {
    fn text(self) -> String {
        match self {
            Self::Text(text) => text,
            Self::Whole(number) => number.to_string(),
            Self::Number(number) => number.to_string(),
        }
    }
}

/// Product data for the catalogue that a dataset file's header states beyond the content of a
/// [`Dataset`](crate::compute::btdf::Dataset). Empty fields: not specified.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct CatalogueFields {
    /// Kind of system, e.g. `venetian`.
    pub kind: String,
    /// Tags by which the product is found in the catalogue.
    pub tags: Vec<String>,
    /// Origin of the data: `measured` or `computed`.
    pub origin: String,
    /// Author of the measurement or computation.
    pub author: String,
    /// Method of the measurement or computation: instrument or formula.
    pub method: String,
    /// Date of the measurement or computation, as the file states it.
    pub date: String,
    /// Name of the face of the system that looks into the room.
    pub inside_face: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    #[serde(rename = "format")]
    _format: String,
    quantity: Quantity,
    light_from: LightFrom,
    layout: Layout,
    rings: Option<Spanned<Vec<[f64; 3]>>>,
    incidence: Spanned<IncidenceChoice>,
    incident_mean: Option<Spanned<bool>>,
    symmetry: Option<Symmetry>,
    state: Option<Key>,
    #[serde(default)]
    name: String,
    #[serde(default)]
    manufacturer: String,
    #[serde(default)]
    description: String,
    thickness: Option<Spanned<f64>>,
    #[serde(default)]
    kind: String,
    #[serde(default)]
    tags: Vec<String>,
    origin: Option<Origin>,
    #[serde(default)]
    author: String,
    #[serde(default)]
    method: String,
    #[serde(default)]
    date: Option<Date>,
    #[serde(default)]
    inside_face: String,
    /// Version of the extension with a system description, checked before all other keys.
    #[serde(rename = "beams")]
    _beams: Option<String>,
    system: Option<String>,
    system_state: Option<String>,
    fingerprint: Option<String>,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Origin {
    Measured,
    Computed,
    Unknown,
}

/// Date as quoted text, or a TOML date.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum Date {
    Text(String),
    Toml(toml::value::Datetime),
}

/// Checked content of a header.
#[derive(Debug)]
pub(super) struct Header {
    /// Component of the values: transmission or reflection, with the side of the incident light.
    pub component: Component,
    /// Layout of the records: values for cells, or for measured points.
    pub layout: Layout,
    /// Rings of emergent cells, each as θ from, θ to \[°\] and number of sectors, and the line of the key `rings`.
    pub rings: Option<(Vec<[f64; 3]>, usize)>,
    /// Incident directions: cells of a standard basis, or a list in the records.
    pub incidence: IncidenceChoice,
    /// Whether values are means over incident cells instead of values at their centres.
    pub incident_mean: bool,
    /// Whether the header omits the key that states whether values are means over incident cells.
    pub is_mean_unspecified: bool,
    /// Symmetry of the system, by which missing incident directions are added.
    pub symmetry: Option<Symmetry>,
    /// Key of the state; may be empty.
    pub state: String,
    /// Name of the product.
    pub name: String,
    /// Manufacturer of the product.
    pub manufacturer: String,
    /// Description of the product in free text.
    pub description: String,
    /// Thickness of the sample. \[m\]
    pub thickness: Option<f64>,
    /// Fields about the product for the catalogue.
    pub fields: CatalogueFields,
    /// System description in the header, with its fingerprint.
    pub stored_description: Option<StoredDescription>,
}

/// Header of a file, and the records after it.
pub(super) struct Split<'a> {
    /// Checked content of the header.
    pub header: Header,
    /// Text of the records, the lines after the header.
    pub body: &'a str,
    /// Line number in the file of the first line of `body`, from 1.
    pub body_line: usize,
}

/// Finds and reads the header of a file.
pub(super) fn split(text: &str) -> Result<Split<'_>, FormatError> {
    let fence = "a TOML header between two lines '---', then the records";
    let mut lines = Lines { text, at: 0, line: 0 };
    let begin = loop {
        let Some((line, content)) = lines.next() else {
            return Err(FormatError::new(Location::file(), "no line '---'", fence));
        };
        match content.trim() {
            "---" => break lines.at,
            "" => {}
            other if other.starts_with('#') => {}
            other => {
                let found = format!("'{}' before the header", excerpt(other));
                return Err(FormatError::new(Location::line(line), found, fence));
            }
        }
    };
    let first = lines.line + 1;
    let end = loop {
        let before = lines.at;
        match lines.next() {
            Some((_, content)) if content.trim_end() == "---" => break before,
            Some(_) if lines.at - begin > MOST_HEADER => {
                let found = format!("a header of more than {} MB", MOST_HEADER >> 20);
                return Err(FormatError::new(Location::line(lines.line), found, "a second line '---' that ends it"));
            }
            Some(_) => {}
            None => {
                return Err(FormatError::new(
                    Location::line(lines.line),
                    "the end of the file inside the header",
                    "a second line '---' that ends it, then the records",
                ));
            }
        }
    };
    let header = parse(&text[begin..end], first)?;
    Ok(Split { header, body: &text[lines.at..], body_line: lines.line + 1 })
}

/// Iterator over the lines of a text with their numbers and the offset of the next line.
struct Lines<'a> {
    text: &'a str,
    at: usize,
    line: usize,
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, &'a str);

    fn next(&mut self) -> Option<Self::Item> {
        let rest = &self.text[self.at..];
        if rest.is_empty() {
            return None;
        }
        let length = rest.find('\n').map_or(rest.len(), |at| at + 1);
        self.at += length;
        self.line += 1;
        Some((self.line, &rest[..length]))
    }
}

fn parse(text: &str, first_line: usize) -> Result<Header, FormatError> {
    let line_of =
        |byte: usize| first_line + text.as_bytes()[..byte.min(text.len())].iter().filter(|b| **b == b'\n').count();
    let located = |error: &toml::de::Error| {
        let at = Location::line(error.span().map_or(first_line, |span| line_of(span.start))).in_element("header");
        let message = error.message();
        match message.split_once(", expected ") {
            Some((found, expected)) => FormatError::new(at, found, expected),
            None => FormatError::new(at, message, "the keys of a cfs-btdf header, as TOML"),
        }
    };
    // The format is checked before all keys, so that another version is not reported as unknown keys.
    let table: toml::Table = toml::from_str(text).map_err(|error| located(&error))?;
    if table.get("format").and_then(toml::Value::as_str) != Some(FORMAT) {
        let found = table
            .get("format")
            .map_or_else(|| "no key format".to_owned(), |v| format!("format = {}", excerpt(&v.to_string())));
        let version = table.get("format").and_then(toml::Value::as_str).and_then(|word| word.strip_prefix(FAMILY));
        let newer = version.and_then(|version| version.trim().parse::<u32>().ok()).is_some_and(|version| version > 1);
        let (by, newest) = if newer {
            (", written by a newer version of cfs", ", the newest that this program reads")
        } else {
            ("", "")
        };
        return Err(FormatError::new(
            Location::line(first_line).in_element("header"),
            format!("{found}{by}"),
            format!("format = \"{FORMAT}\"{newest}"),
        ));
    }
    let beams = beams(&table, first_line)?;
    let keys: Keys = toml::from_str(text).map_err(|error| located(&error))?;
    let at = |byte: usize, key: &str| Location::line(line_of(byte)).in_element(key);
    let incidence = *keys.incidence.get_ref();
    let incident_mean = keys.incident_mean.as_ref().is_some_and(|mean| *mean.get_ref());
    if incident_mean && incidence == IncidenceChoice::Listed {
        let byte = keys.incident_mean.as_ref().map_or(0, |mean| mean.span().start);
        return Err(FormatError::new(
            at(byte, "incident_mean"),
            "means over incident cells (incident_mean = true) at listed directions, which have no cells",
            "incident_mean = false, or incidence = \"tregenza-145\" or \"klems-145\"",
        ));
    }
    if let Some(thickness) = &keys.thickness
        && !(thickness.get_ref().is_finite() && *thickness.get_ref() >= 0.0)
    {
        let found = format!("a thickness of {}", thickness.get_ref());
        return Err(FormatError::new(at(thickness.span().start, "thickness"), found, "metres, 0 or more"));
    }
    if keys.layout == Layout::Rings && keys.rings.is_none() {
        return Err(FormatError::new(
            Location::line(first_line).in_element("header"),
            "layout = \"rings\" without the key rings",
            "rings = [[θ from, θ to, number of sectors], …]",
        ));
    }
    let state = keys.state.map(Key::text).unwrap_or_default();
    let described = match (beams, keys.system) {
        (true, Some(text)) => Some(StoredDescription {
            described: DescribedState { text, state: keys.system_state.unwrap_or_else(|| state.clone()) },
            fingerprint: keys.fingerprint.unwrap_or_default(),
        }),
        (false, None) => None,
        (beams, _) => {
            let [there, missing] = if beams { ["beams", "system"] } else { ["system", "beams"] };
            return Err(FormatError::new(
                Location::line(first_line).in_element("header"),
                format!("the key {there} without {missing}"),
                format!("both: beams = \"{NAME} {VERSION}\" and the text of a .system.toml"),
            ));
        }
    };
    Ok(Header {
        component: match (keys.quantity, keys.light_from) {
            (Quantity::Btdf, LightFrom::Outside) => Component::TransmissionFront,
            (Quantity::Btdf, LightFrom::Inside) => Component::TransmissionBack,
            (Quantity::Brdf, LightFrom::Outside) => Component::ReflectionFront,
            (Quantity::Brdf, LightFrom::Inside) => Component::ReflectionBack,
        },
        layout: keys.layout,
        rings: keys.rings.map(|rings| {
            let line = line_of(rings.span().start);
            (rings.into_inner(), line)
        }),
        incidence,
        incident_mean,
        is_mean_unspecified: keys.incident_mean.is_none(),
        symmetry: keys.symmetry,
        state,
        name: keys.name,
        manufacturer: keys.manufacturer,
        description: keys.description,
        thickness: keys.thickness.map(Spanned::into_inner),
        fields: CatalogueFields {
            kind: keys.kind,
            tags: keys.tags,
            origin: match keys.origin {
                Some(Origin::Measured) => "measured".to_owned(),
                Some(Origin::Computed) => "computed".to_owned(),
                Some(Origin::Unknown) | None => String::new(),
            },
            author: keys.author,
            method: keys.method,
            date: match keys.date {
                Some(Date::Text(text)) => text,
                Some(Date::Toml(date)) => date.to_string(),
                None => String::new(),
            },
            inside_face: keys.inside_face,
        },
        stored_description: described,
    })
}

/// Whether the header contains a system description of a version that this program knows. Returns an error for other
/// versions, which may have any keys.
fn beams(table: &toml::Table, first_line: usize) -> Result<bool, FormatError> {
    let Some(value) = table.get("beams") else { return Ok(false) };
    let word = value.as_str().unwrap_or_default();
    let version = word.strip_prefix(NAME).and_then(|version| version.trim().parse::<u32>().ok());
    let wrong = |found: String, expected: String| {
        Err(FormatError::new(Location::line(first_line).in_element("header"), found, expected))
    };
    match version {
        Some(VERSION) => Ok(true),
        Some(newer) if newer > VERSION => wrong(
            format!("beams = \"{NAME} {newer}\", written by a newer version of cfs"),
            format!("{NAME} {VERSION}, the newest that this program reads"),
        ),
        _ => wrong(format!("beams = {}", excerpt(&value.to_string())), format!("beams = \"{NAME} {VERSION}\"")),
    }
}
