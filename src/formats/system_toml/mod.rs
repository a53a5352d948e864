//! System files (`.system.toml`): geometry and material of a system, for the virtual goniophotometer.
//!
//! The module checks keys and ranges and fills in defaults; an error states the key and what was expected. Materials
//! may have solar properties beside the visible ones (`solar`).

mod checks;
mod contained;
mod keys;
mod layers;
mod sheets;
mod solar;
mod transparent;

use super::encoding::decode;
use super::toml_place::{TomlPlace, place};
pub use contained::{described, self_contained, states};
pub use layers::{EACH_STATE, MOST_NESTED};

use super::location::{FormatError, Location, excerpt};
use crate::compute::btdf::BandName;
use crate::compute::limits;
use crate::compute::system::slats::{SlatProfile, Surface, Venetian};
use crate::compute::system::stack::{Layer, LayerSource};
use crate::compute::system::{SystemDescription, SystemKind};
use checks::{length, outline, share, within, wrong};
use keys::Angles;
use layers::stack;
use serde::Deserialize;
use sheets::{diffuser, perforated, woven};
use transparent::{laser_cut, pane, prismatic, redirecting};

/// Maximum size of a system file. \[bytes\]
const MOST_BYTES: usize = limits::SYSTEM_BYTES;
/// Maximum number of states of a described system.
const MOST_STATES: usize = limits::SYSTEM_STATES;

/// Content of a system file: the described system with its product data.
#[derive(Debug, Clone, PartialEq)]
pub struct SystemFile {
    /// Described system with its visible properties.
    pub system: SystemDescription,
    /// Key of the product in the catalogue; empty: derived from the name.
    pub key: String,
    /// Tags by which the product is found in the catalogue.
    pub tags: Vec<String>,
    /// Key of the control rule from which the product's control curve is computed; empty: none.
    pub control: String,
    /// System with the solar properties of its materials; `None` if the file states none, and for a stack, whose layers
    /// state them separately.
    pub solar: Option<SystemKind>,
    /// Number of materials with solar properties, and number of all materials of the system; both 0 for a stack, whose
    /// materials belong to its layers.
    pub materials: [usize; 2],
}

impl SystemFile {
    /// Returns the system with the properties of a spectral band, visible ones if the file has no solar ones.
    pub fn in_band(&self, band: BandName) -> SystemDescription {
        match (band, &self.solar) {
            (BandName::Solar, Some(kind)) => SystemDescription { kind: kind.clone(), ..self.system.clone() },
            _ => self.system.clone(),
        }
    }
}

/// Whether a file name is that of a system file (ends in `.system.toml`).
pub fn is_system_file(name: &str) -> bool {
    name.to_ascii_lowercase().ends_with(".system.toml")
}

/// Reads a system file from its bytes.
///
/// # Errors
/// Returns an error if the bytes are not TOML, or if keys are missing, unknown or out of range.
pub fn read(bytes: &[u8]) -> Result<SystemFile, FormatError> {
    if bytes.len() > MOST_BYTES {
        return Err(FormatError::new(Location::file(), format!("{} bytes", bytes.len()), "at most 1 MB of TOML"));
    }
    let text = decode(bytes)?;
    let text = &*text;
    let keys: Keys = toml::from_str(text).map_err(|error| {
        let TomlPlace { line, key, message, .. } = place(text, &error, 0, |_| None);
        let at = if key.is_empty() { Location::line(line) } else { Location::line(line).in_element(key) };
        match message.split_once(", expected ") {
            Some((found, expected)) => FormatError::new(at, found, expected),
            None => FormatError::new(at, message, "the keys of a system file, as TOML"),
        }
    })?;
    let (word, kind) = kind(&keys)?;
    if let SystemKind::Stack(layers) = &kind {
        for (k, layer) in layers.iter().enumerate() {
            layer_is_right(k, layer)?;
        }
    }
    let (solar, materials) = solar_kind(text, word)?;
    let catalogue = keys.catalogue;
    if catalogue.key.chars().any(|c| !(c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')) {
        return wrong("catalogue.key", excerpt(&catalogue.key), "lower-case letters, digits and hyphens");
    }
    Ok(SystemFile {
        system: SystemDescription { name: keys.name, description: keys.description, kind, upright: keys.upright },
        key: catalogue.key,
        tags: catalogue.tags,
        control: catalogue.control,
        solar,
        materials,
    })
}

/// Returns the system with its solar properties (`None` if it has none), the number of materials with such properties,
/// and that of all materials.
fn solar_kind(text: &str, word: &str) -> Result<(Option<SystemKind>, [usize; 2]), FormatError> {
    let (table, materials) = solar::keys(text, word)?;
    let Some(table) = table else { return Ok((None, materials)) };
    let keys: Keys = table.try_into().map_err(|error: toml::de::Error| {
        let at = Location::file().in_element("solar");
        FormatError::new(at, error.message(), "the keys of a system file")
    })?;
    let (_, kind) = kind(&keys).map_err(solar::located)?;
    Ok((Some(kind), materials))
}

/// Checks the description that a stack contains for its layer number `k`; returns an error if it is not valid.
fn layer_is_right(k: usize, layer: &Layer) -> Result<(), FormatError> {
    let LayerSource::Text(text) = &layer.source else { return Ok(()) };
    read(text.as_bytes()).map(drop).map_err(|error| {
        // Its lines are not those of the file; its keys are.
        let inner = error.at.element.map(|inner| format!(".{inner}")).unwrap_or_default();
        let at = Location::file().in_element(format!("stack.layers[{k}].system{inner}"));
        FormatError::new(at, error.found, error.expected)
    })
}

/// Defines the keys of a system file and the functions that read them. One line per family of systems: its kind, the
/// key of its kind and table, the table's keys, and the function that reads them.
macro_rules! families {
    ($($kind:ident $word:literal $table:ident: $keys:ty, $read:path;)*) => {
        #[derive(Debug, Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Keys {
            name: String,
            kind: Kind,
            #[serde(default)]
            description: String,
            #[serde(default)]
            upright: bool,
            $(#[serde(rename = $word)] $table: Option<$keys>,)*
            #[serde(default)]
            catalogue: keys::Catalogue,
        }

        #[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
        enum Kind {
            $(#[serde(rename = $word)] $kind,)*
        }

        /// Returns the key of a system file's kind, and the system that its table describes.
        fn kind(keys: &Keys) -> Result<(&'static str, SystemKind), FormatError> {
            let word = match keys.kind { $(Kind::$kind => $word,)* };
            let there = [$(($word, keys.$table.is_some()),)*];
            if let Some((other, _)) = there.iter().find(|(other, there)| *there && *other != word) {
                let expected = format!("the table [{word}] alone, or kind = \"{other}\"");
                return wrong(other, format!("a table of another kind than \"{word}\""), expected);
            }
            let none = || {
                let found = format!("kind = \"{word}\" without its table");
                FormatError::new(Location::file(), found, format!("a table [{word}]"))
            };
            let kind = match keys.kind {
                $(Kind::$kind => SystemKind::$kind($read(keys.$table.as_ref().ok_or_else(none)?)?),)*
            };
            Ok((word, kind))
        }
    };
}

families! {
    Venetian "venetian" venetian: keys::Venetian, venetian;
    LaserCutPanel "laser-cut-panel" laser_cut_panel: keys::LaserCut, laser_cut;
    Prismatic "prismatic" prismatic: keys::Prismatic, prismatic;
    RedirectingGlass "redirecting-glass" redirecting_glass: keys::RedirectingGlass, redirecting;
    Pane "pane" pane: keys::Pane, pane;
    Diffuser "diffuser" diffuser: keys::Diffuser, diffuser;
    Woven "woven" woven: keys::Woven, woven;
    Perforated "perforated" perforated: keys::Perforated, perforated;
    Stack "stack" stack: keys::Stack, stack;
}

fn face(key: &str, face: &keys::Face) -> Result<Surface, FormatError> {
    let diffuse = share(&format!("{key}.reflectance"), face.reflectance)?;
    let mirror = share(&format!("{key}.specular"), face.specular)?;
    if diffuse + mirror > 1.0 + 1e-12 {
        return wrong(key, format!("reflectance + specular = {}", diffuse + mirror), "at most 1 together");
    }
    let spread = within(&format!("{key}.roughness"), face.roughness, (0.0, 45.0))?.to_radians();
    Ok(Surface { diffuse, mirror, spread })
}

fn venetian(blind: &keys::Venetian) -> Result<Venetian, FormatError> {
    let profile = match &blind.profile {
        Some(points) => {
            let points = outline("venetian.profile", points, 2)?;
            if blind.rise != 0.0 || blind.width != 0.0 {
                let stated = if blind.rise == 0.0 { "width" } else { "rise" };
                return wrong("venetian", format!("profile and {stated}"), "either the profile, or width and rise");
            }
            SlatProfile::Polyline(points)
        }
        None => {
            let width = length("venetian.width", blind.width)?;
            SlatProfile::curved(width, within("venetian.rise", blind.rise, (-0.5 * width, 0.5 * width))?)
        }
    };
    let spacing = length("venetian.spacing", blind.spacing)?;
    let degrees = match &blind.angles {
        Angles::Listed(list) => list.clone(),
        Angles::Steps(keys::Steps { from, to, step }) => {
            let steps = (to - from) / step;
            if !(*step > 0.0 && steps >= 0.0 && steps < MOST_STATES as f64) {
                return wrong(
                    "venetian.angles",
                    format!("from {from} to {to} in steps of {step}"),
                    format!("from ≤ to, a step above 0 and at most {MOST_STATES} states"),
                );
            }
            (0..=(steps + 1e-9).floor() as usize).map(|k| from + step * k as f64).collect()
        }
    };
    if degrees.is_empty() || degrees.len() > MOST_STATES {
        return wrong("venetian.angles", format!("{} angles", degrees.len()), format!("1 to {MOST_STATES}"));
    }
    for (k, &angle) in degrees.iter().enumerate() {
        within("venetian.angles", angle, (-90.0, 90.0))?;
        if degrees[..k].contains(&angle) {
            return wrong("venetian.angles", format!("{angle} twice"), "every angle once");
        }
    }
    Ok(Venetian {
        profile,
        spacing,
        thickness: within("venetian.thickness", blind.thickness, (0.0, spacing))?,
        angles: degrees.into_iter().map(f64::to_radians).collect(),
        upper: face("venetian.upper", &blind.upper)?,
        lower: face("venetian.lower", &blind.lower)?,
    })
}

#[cfg(test)]
mod tests;
