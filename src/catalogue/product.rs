//! Products of the catalogue for the rest of the program: descriptive texts, provenance, states and figures.

use crate::compute::btdf::{Btdf, LightFigures, Severity};
use crate::compute::direction::{Dir, Incident};
use crate::texts::{Text, ascii_letters, catalogue as text};

/// Origin of BSDF data: measured or computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum Origin {
    /// Measured with an instrument.
    Measured,
    /// Computed by a formula or a simulation.
    Computed,
    /// Not specified.
    #[default]
    Unknown,
}

impl Origin {
    /// Returns the key used in the catalogue, in packages and in JSON.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Computed => "computed",
            Self::Unknown => "unknown",
        }
    }

    /// Returns the translated label, such as "measured".
    pub const fn words(self) -> Text {
        match self {
            Self::Measured => text::MEASURED,
            Self::Computed => text::COMPUTED,
            Self::Unknown => text::UNKNOWN,
        }
    }

    /// Returns the origin of a key; any other text gives [`Self::Unknown`].
    pub fn from_word(word: &str) -> Self {
        match word {
            "measured" => Self::Measured,
            "computed" => Self::Computed,
            _ => Self::Unknown,
        }
    }
}

/// Provenance of the data. An empty text means: not specified.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Provenance {
    /// Origin, measured or computed.
    pub origin: Origin,
    /// Author of the data.
    pub author: String,
    /// Method with its source: device or formula.
    pub method: String,
    /// Date as the source gives it.
    pub date: String,
    /// Name of the file from which the data were read; of several files, their names separated by commas.
    pub source_file: String,
    /// BLAKE3 hash of the file from which the data were read, or of the description from which they were computed: 64
    /// hexadecimal digits.
    pub source_hash: String,
    /// Face of the system that looks into the room.
    pub inside_face: String,
}

/// State of a product, such as a slat angle or a switching state, with its figures.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Key that scenes use; empty for the only state of a product without states.
    pub key: String,
    /// Label of the state for people.
    pub label: String,
    /// Number of the state: an angle \[°\], or another number that orders the states; `None` without one.
    pub value: Option<f64>,
    /// BLAKE3 hash of the state's dataset in compact form; `None` while it is still to be computed from the product's
    /// description.
    pub dataset: Option<String>,
    /// Visible transmittance τ of light from outside at normal incidence, 0 … 1; `None` when unknown.
    pub tau_normal: Option<f64>,
    /// Visible hemispherical transmittance τ: of light from outside under uniform luminance, 0 … 1; `None` when
    /// unknown.
    pub tau_hemispherical: Option<f64>,
    /// Visible transmittances τ of light from outside, from directions in the vertical plane through the normal at the
    /// profile angles [`PROFILE_ANGLES`]; empty when unknown.
    pub tau_profile: Vec<f64>,
    /// Figures of the transmitted light: share to the ceiling, sun blocked, normal–normal transmittance; `None` when
    /// unknown.
    pub light: Option<LightFigures>,
}

/// Profile angles of [`State::tau_profile`] and [`super::ProductRow::tau_profile`], rising from light from below
/// (negative) to light from above (positive). \[°\]
pub const PROFILE_ANGLES: [f64; 13] =
    [-85.0, -75.0, -60.0, -45.0, -30.0, -15.0, 0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0];

/// Returns the transmittances τ for light from directions in the vertical plane through the normal, at
/// [`PROFILE_ANGLES`].
pub fn profile_transmittances(btdf: &Btdf) -> Vec<f64> {
    PROFILE_ANGLES
        .iter()
        .map(|angle| {
            let upwards = if *angle < 0.0 { 270_f64 } else { 90.0 };
            btdf.tau(Incident(Dir::from_theta_phi(angle.abs().to_radians(), upwards.to_radians())))
        })
        .collect()
}

/// Point of a control curve, which gives the state of a moving product for each profile angle of the sun.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// Profile angle of the sun. \[°\]
    pub profile_angle: f64,
    /// Number of the state to be set, such as the slat angle. \[°\]
    pub value: f64,
}

/// Finding of a check about the data of one state of a product.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProductFinding {
    /// Key of the state.
    pub state: String,
    /// Severity of the finding.
    pub severity: Severity,
    /// Stable identifier of the kind of finding, in kebab case.
    pub code: String,
    /// Text of the finding, as a sentence.
    pub message: String,
}

impl ProductFinding {
    /// Returns the finding as a line that begins with severity and state, such as "warning 45: …"; "warning: …" for a
    /// state without a key.
    pub fn line(&self) -> String {
        let begin = [self.severity.word(), &self.state].join(" ");
        format!("{}: {}", begin.trim_end(), self.message)
    }
}

/// Product of the catalogue, with everything but its datasets.
#[derive(Debug, Clone, PartialEq)]
pub struct Product {
    /// Key by which scenes name the product.
    pub key: String,
    /// Name of the product.
    pub name: String,
    /// Maker; may be empty.
    pub manufacturer: String,
    /// Kind of product, such as `venetian`.
    pub kind: String,
    /// Description of the product, as free text.
    pub description: String,
    /// Provenance of the data: origin, author, method, source file.
    pub provenance: Provenance,
    /// Licence of the data, e.g. `CC BY 4.0`; may be empty.
    pub license: String,
    /// Tags to find the product by, sorted.
    pub tags: Vec<String>,
    /// States in their order, at least one.
    pub states: Vec<State>,
    /// Points of the control curve by rising profile angle; empty if the product has no curve.
    pub control_curve: Vec<CurvePoint>,
    /// Findings of readers and checks on import.
    pub findings: Vec<ProductFinding>,
    /// Text of the system description from which the data were computed; empty for other products.
    pub system: String,
    /// Whether the user marked it as a favourite.
    pub favourite: bool,
    /// Whether the product comes with the program.
    pub builtin: bool,
}

/// Label and number of a state, given on import.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StateName {
    /// Label of the state for people.
    pub label: String,
    /// Number of the state: an angle \[°\], or another number that orders the states; `None` without one.
    pub value: Option<f64>,
}

/// Product data for an import: everything but the datasets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NewProduct {
    /// Requested key; `None`: made from the name. It is made unique in either case.
    pub key: Option<String>,
    /// Name of the product; if empty, that of the first dataset.
    pub name: String,
    /// Maker of the product; if empty, that of the first dataset.
    pub manufacturer: String,
    /// Kind of product, such as `venetian`; may be empty.
    pub kind: String,
    /// Description of the product, as free text; if empty, that of the first dataset.
    pub description: String,
    /// Provenance of the data: origin, author, method, source file.
    pub provenance: Provenance,
    /// Licence of the data, e.g. `CC BY 4.0`; may be empty.
    pub license: String,
    /// Tags to find the product by.
    pub tags: Vec<String>,
    /// Names of the states, in the order of the datasets; empty: made from the datasets' state keys.
    pub states: Vec<StateName>,
    /// Points of the control curve by rising profile angle; empty if the product has no curve.
    pub control_curve: Vec<CurvePoint>,
    /// Text of the system description from which the data were computed; empty for other products.
    pub system: String,
    /// Content hashes of the states as they were read from files, in their order, see [`super::content_of`]; if empty,
    /// those of the stored data.
    pub contents: Vec<String>,
    /// Paths of the files that the product was read from, for reading them again.
    pub paths: Vec<String>,
}

/// Result of an import.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Imported {
    /// Key of the new product.
    pub key: String,
    /// Keys of products that have a dataset with the same bytes.
    pub same_content_as: Vec<String>,
}

/// Returns a key made from a name: lower-case ASCII letters and digits, other runs as one hyphen, other scripts
/// transliterated by sound. For a name without letters the key is made from the maker and a hash of the name.
pub(crate) fn slug(name: &str, maker: &str) -> String {
    let key = plain(name);
    if !key.is_empty() {
        return key;
    }
    let maker = Some(plain(maker)).filter(|maker| !maker.is_empty());
    let hash = blake3::hash(name.as_bytes()).to_hex();
    format!("{}-{}", maker.as_deref().unwrap_or("product"), &hash[..8])
}

/// Returns the letters and digits of a text in lower-case ASCII, with one hyphen in place of each other run.
fn plain(name: &str) -> String {
    let mut key = String::new();
    // Apostrophes stand for soft signs: part of a word.
    for letter in ascii_letters(name).chars().filter(|letter| *letter != '\'') {
        if letter.is_ascii_alphanumeric() {
            key.push(letter.to_ascii_lowercase());
        } else if !key.is_empty() && !key.ends_with('-') {
            key.push('-');
        }
        if key.len() >= 80 {
            break;
        }
    }
    key.trim_matches('-').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_plain() {
        let key = |name: &str| slug(name, "Hunter Lux");
        assert_eq!(key("Venetian 80/72, matt weiß"), "venetian-80-72-matt-weiss");
        assert_eq!(key("  Écran «Été» "), "ecran-ete");
        assert_eq!((key("Köln").as_str(), key("Ko\u{308}ln").as_str()), ("koln", "koln"));
        assert_eq!(key("Жалюзи горизонтальные"), "zhalyuzi-gorizontalnye");
        assert_eq!(key("Περσίδες"), "persides");
        assert_eq!(key("铝百叶窗 80"), "lu-bai-ye-chuang-80");
        let [none, other] = [key("\u{e000}"), key("\u{e001}")];
        assert!(none.starts_with("hunter-lux-") && none.len() == 19 && none != other, "{none} {other}");
        assert!(slug("–", "").starts_with("product-") && slug("–", "") == slug("–", ""));
    }
}
