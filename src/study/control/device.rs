//! What a control needs to know of a product: its states with their numbers, its curve, and the section of its slats.

use super::super::error::StudyError;
use super::keys::SlatKeys;
use crate::catalogue::{Product, blind_of, control_curve, moving_part, slats_of};
use crate::compute::control::cut_off::SlatRow;
use crate::compute::system::slats::SlatProfile;
use crate::formats::system_toml::SystemFile;
use crate::study::scene_file::FamilyState;

/// A device that a controller can set.
#[derive(Debug, Clone, PartialEq)]
pub struct Device {
    /// Key of the product, for messages.
    pub name: String,
    /// Keys of the states, in the product's order.
    pub keys: Vec<String>,
    /// Their numbers; `None` for a device that has states without numbers. \[°, or the state's own unit\]
    pub values: Option<Vec<f64>>,
    /// The product's curve: (profile angle \[°\], value).
    pub curve: Vec<[f64; 2]>,
    /// Section of its slats, where it is known.
    pub section: Option<SlatRow>,
    /// Its slats stand upright: their profile angle is that of the horizontal plane.
    pub upright: bool,
}

impl Device {
    /// Of a product of the catalogue.
    ///
    /// # Errors
    /// A product without states.
    pub fn of(product: &Product) -> Result<Self, StudyError> {
        if product.states.is_empty() {
            return Err(StudyError::Catalogue(format!("'{}' has no states", product.key)));
        }
        Ok(Self {
            name: product.key.clone(),
            keys: product.states.iter().map(|state| state.key.clone()).collect(),
            values: product.states.iter().map(|state| state.value).collect(),
            curve: product.control_curve.iter().map(|point| [point.profile_angle, point.value]).collect(),
            section: section_of(&product.system),
            upright: is_upright(&product.system),
        })
    }

    /// Of a description with the keys of its states.
    pub fn described(file: &SystemFile, text: &str, keys: Vec<String>) -> Self {
        let blind = blind_of(text);
        let curve = blind.as_ref().map(|blind| control_curve(&file.control, blind)).unwrap_or_default();
        Self {
            name: file.system.name.clone(),
            values: keys.iter().map(|key| key.parse().ok().filter(|value: &f64| value.is_finite())).collect(),
            keys,
            curve: curve.iter().map(|point| [point.profile_angle, point.value]).collect(),
            section: section_of(text),
            upright: is_upright(text),
        }
    }

    /// Of a family of files.
    pub fn of_family(states: &[FamilyState]) -> Self {
        Self {
            name: states.first().map_or_else(String::new, |one| one.file.display().to_string()),
            keys: states.iter().map(|one| one.state.clone()).collect(),
            values: Some(states.iter().map(|one| one.value).collect()),
            curve: Vec::new(),
            section: None,
            upright: false,
        }
    }

    /// Index of a state by its key; the error names the key of the scene.
    pub fn state(&self, key: &str, scene_key: &str) -> Result<usize, StudyError> {
        self.keys.iter().position(|known| known == key).ok_or_else(|| {
            StudyError::key(
                scene_key,
                format!("'{}' has no state '{key}'; it has: {}", self.name, self.keys.join(", ")),
            )
        })
    }
}

/// The slats of a description: those of products that the program computes are in the catalogue.
fn section_of(system: &str) -> Option<SlatRow> {
    SlatRow::of(&slats_of(system)?.0)
}

/// Does what moves in a description stand upright?
pub fn is_upright(system: &str) -> bool {
    moving_part(system).is_some_and(|moving| moving.upright)
}

/// The section that a scene describes.
pub fn section_from_keys(keys: &SlatKeys) -> Result<SlatRow, StudyError> {
    let wrong = |message: &str| StudyError::key("control.slats", message);
    let profile = match (keys.width, keys.profile.is_empty()) {
        (Some(width), true) => SlatProfile::curved(width, keys.rise.unwrap_or(0.0)),
        (None, false) if keys.rise.is_none() => SlatProfile::Polyline(keys.profile.clone()),
        _ => return Err(wrong("needs either width (and rise) or profile, besides spacing")),
    };
    SlatRow::new(profile, keys.spacing).ok_or_else(|| {
        wrong("is no section: width and spacing are lengths above 0 m, rise is at most half the width, a profile has two points or more")
    })
}
