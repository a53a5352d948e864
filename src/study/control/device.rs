//! Properties of a product that a shading control needs: its states with their numbers, its control curve, and the
//! section of its slats.

use super::super::error::StudyError;
use super::keys::SlatKeys;
use crate::catalogue::{Product, blind_of, control_curve, moving_part, slats_of};
use crate::compute::control::cut_off::SlatRow;
use crate::compute::system::slats::SlatProfile;
use crate::formats::system_toml::SystemFile;
use crate::study::scene_file::FamilyState;

/// Shading device with states that a control can set.
#[derive(Debug, Clone, PartialEq)]
pub struct Device {
    /// Key of the product, for messages.
    pub name: String,
    /// Keys of the states, in the order of the product.
    pub keys: Vec<String>,
    /// Numbers of the states, such as slat angles; `None` for a device that has states without numbers.
    /// \[°, or the unit of the states\]
    pub values: Option<Vec<f64>>,
    /// Control curve of the product as points: profile angle of the sun \[°\], and number of the state such as the slat
    /// angle \[°\].
    pub curve: Vec<[f64; 2]>,
    /// Cross-section of the slats, where it is known; it determines whether direct sun passes between them.
    pub section: Option<SlatRow>,
    /// Whether the slats are vertical, so that their profile angle is that of the horizontal plane.
    pub upright: bool,
}

impl Device {
    /// Creates a device from a product of the catalogue.
    ///
    /// # Errors
    /// Returns an error if the product has no states.
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

    /// Creates a device from a described system. `text`: text of the description; `keys`: keys of its states.
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

    /// Creates a device from the states of a family of files in a scene.
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

    /// Returns the index of a state by its key.
    ///
    /// # Errors
    /// Returns an error that names the key of the scene file (`scene_key`) and the existing states if the device does
    /// not have the state.
    pub fn state(&self, key: &str, scene_key: &str) -> Result<usize, StudyError> {
        self.keys.iter().position(|known| known == key).ok_or_else(|| {
            StudyError::key(
                scene_key,
                format!("'{}' has no state '{key}'; it has: {}", self.name, self.keys.join(", ")),
            )
        })
    }
}

/// Returns the cross-section of the slats in the text of a system description; `None` for systems without slats.
fn section_of(system: &str) -> Option<SlatRow> {
    SlatRow::of(&slats_of(system)?.0)
}

/// Whether the slats in the text of a system description are vertical.
pub fn is_upright(system: &str) -> bool {
    moving_part(system).is_some_and(|moving| moving.upright)
}

/// Creates the cross-section of slats from the keys `control.slats` of a scene.
///
/// # Errors
/// Returns an error if the keys do not give a section.
pub fn section_from_keys(keys: &SlatKeys) -> Result<SlatRow, StudyError> {
    let wrong = |message: &str| StudyError::key("control.slats", message);
    let profile = match (keys.width, keys.profile.is_empty()) {
        (Some(width), true) => SlatProfile::curved(width, keys.rise.unwrap_or(0.0)),
        (None, false) if keys.rise.is_none() => SlatProfile::Polyline(keys.profile.clone()),
        _ => return Err(wrong("needs either width (and rise) or profile, besides spacing")),
    };
    SlatRow::new(profile, keys.spacing).ok_or_else(|| {
        wrong("is not a valid section: width and spacing are lengths above 0 m, rise is at most half the width, a profile has two points or more")
    })
}
