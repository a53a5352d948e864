//! Products as the rest of the program sees them.

use crate::compute::btdf::{Btdf, LightFigures, Severity};
use crate::compute::direction::{Dir, Incident};
use crate::texts::{Text, ascii_letters, catalogue as text};

/// How data came to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum Origin {
    /// By an instrument.
    Measured,
    /// By a formula or a simulation.
    Computed,
    /// Not told.
    #[default]
    Unknown,
}

impl Origin {
    /// The word used in the catalogue, in packages and in JSON.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Computed => "computed",
            Self::Unknown => "unknown",
        }
    }

    /// In words.
    pub const fn words(self) -> Text {
        match self {
            Self::Measured => text::MEASURED,
            Self::Computed => text::COMPUTED,
            Self::Unknown => text::UNKNOWN,
        }
    }

    /// The origin of a word; anything else is unknown.
    pub fn from_word(word: &str) -> Self {
        match word {
            "measured" => Self::Measured,
            "computed" => Self::Computed,
            _ => Self::Unknown,
        }
    }
}

/// Where data come from. Empty texts: not told.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Provenance {
    /// Measured or computed.
    pub origin: Origin,
    /// By whom.
    pub author: String,
    /// How: device or formula, with its source.
    pub method: String,
    /// When, as the source gives it.
    pub date: String,
    /// Name of the file the data were read from.
    pub source_file: String,
    /// BLAKE3 hash of that file, 64 hexadecimal digits.
    pub source_hash: String,
    /// Which face looks into the room.
    pub inside_face: String,
}

/// One state of a product, in the order of its family.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Key by which scenes name it; empty for the only state of a system without states.
    pub key: String,
    /// Text for people.
    pub label: String,
    /// Angle \[°\] or another number of the state.
    pub value: Option<f64>,
    /// BLAKE3 hash of its dataset in compact form; `None`: still to be computed from the product's description.
    pub dataset: Option<String>,
    /// Visible transmittance of light from outside at normal incidence.
    pub tau_normal: Option<f64>,
    /// The same under uniform luminance.
    pub tau_hemispherical: Option<f64>,
    /// The same in the vertical plane, at the profile angles [`PROFILE_ANGLES`]; empty when unknown.
    pub tau_profile: Vec<f64>,
    /// Where light goes; `None` when unknown.
    pub light: Option<LightFigures>,
}

/// Profile angles of [`State::tau_profile`] and [`super::ProductRow::tau_profile`], rising from light from below to light from
/// above. \[°\]
pub const PROFILE_ANGLES: [f64; 13] =
    [-85.0, -75.0, -60.0, -45.0, -30.0, -15.0, 0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0];

/// Transmittances for light in the vertical plane through the normal, at [`PROFILE_ANGLES`].
pub fn profile_transmittances(btdf: &Btdf) -> Vec<f64> {
    PROFILE_ANGLES
        .iter()
        .map(|angle| {
            let upwards = if *angle < 0.0 { 270_f64 } else { 90.0 };
            btdf.tau(Incident(Dir::from_theta_phi(angle.abs().to_radians(), upwards.to_radians())))
        })
        .collect()
}

/// A point of a control curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// Profile angle of the sun. \[°\]
    pub profile_angle: f64,
    /// Number of the state asked for, e.g. the slat angle. \[°\]
    pub value: f64,
}

/// A finding about one state of a product.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProductFinding {
    /// Key of the state.
    pub state: String,
    /// How much it matters.
    pub severity: Severity,
    /// Stable identifier in kebab case.
    pub code: String,
    /// What was found.
    pub message: String,
}

/// Everything about a product but its datasets.
#[derive(Debug, Clone, PartialEq)]
pub struct Product {
    /// Key by which scenes name it.
    pub key: String,
    /// Name.
    pub name: String,
    /// Maker; may be empty.
    pub manufacturer: String,
    /// Kind, e.g. `venetian`.
    pub kind: String,
    /// Free text.
    pub description: String,
    /// Where the data come from.
    pub provenance: Provenance,
    /// On which terms the data may be passed on, e.g. `CC BY 4.0`; may be empty.
    pub license: String,
    /// Words to find it by, sorted.
    pub tags: Vec<String>,
    /// States in order, at least one.
    pub states: Vec<State>,
    /// Points of the control curve, profile angle rising; empty without one.
    pub control_curve: Vec<CurvePoint>,
    /// What readers and checks had to say on import.
    pub findings: Vec<ProductFinding>,
    /// Text of the description that it was computed from; empty for others.
    pub system: String,
    /// Marked by the user.
    pub favourite: bool,
    /// Comes with the program.
    pub builtin: bool,
}

/// Text and number of a state on import.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StateName {
    /// Text for people.
    pub label: String,
    /// Angle \[°\] or another number.
    pub value: Option<f64>,
}

/// What is told about a product on import, beside its datasets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NewProduct {
    /// Key wanted; `None`: made from the name. Made unique either way.
    pub key: Option<String>,
    /// Name; empty: the first dataset's own.
    pub name: String,
    /// Maker; empty: the first dataset's own.
    pub manufacturer: String,
    /// Kind, e.g. `venetian`; may be empty.
    pub kind: String,
    /// Free text; empty: the first dataset's own.
    pub description: String,
    /// Where the data come from.
    pub provenance: Provenance,
    /// On which terms the data may be passed on, e.g. `CC BY 4.0`; may be empty.
    pub license: String,
    /// Words to find it by.
    pub tags: Vec<String>,
    /// Names of the states, in the order of the datasets; empty: made from the datasets' state keys.
    pub states: Vec<StateName>,
    /// Points of the control curve.
    pub control_curve: Vec<CurvePoint>,
    /// Text of the description that it was computed from; empty for others.
    pub system: String,
    /// Contents of the states as they were read, in their order, see [`super::content_of`]; empty: those of what is stored.
    pub contents: Vec<String>,
    /// Paths of the files that it was read from, for reading them again.
    pub paths: Vec<String>,
}

/// What an import did.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Imported {
    /// Key of the new product.
    pub key: String,
    /// Keys of products that hold one of the same datasets, byte for byte.
    pub same_content_as: Vec<String>,
}

/// Returns a key from a name: lower-case ASCII letters and digits, other runs as one hyphen, other scripts by their sound.
/// Of a name without letters the key is that of the maker with a hash of the name.
pub(crate) fn slug(name: &str, maker: &str) -> String {
    let key = plain(name);
    if !key.is_empty() {
        return key;
    }
    let maker = Some(plain(maker)).filter(|maker| !maker.is_empty());
    let hash = blake3::hash(name.as_bytes()).to_hex();
    format!("{}-{}", maker.as_deref().unwrap_or("product"), &hash[..8])
}

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
