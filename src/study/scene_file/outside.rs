//! Keys of obstructions in a scene file: boxes in front of the façade and above the roof, building, skyline; and of
//! frame and dirt.

use serde::{Deserialize, Serialize};

/// Entry `[[outside]]` of a scene file: box outside the room, with vertical sides.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OutsideKeys {
    /// Name of the box; optional.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Position and size of the box.
    #[serde(rename = "box")]
    pub solid: BoxKeys,
    /// Diffuse reflectance of the box, 0 … 1, which is lit by sky, sun and ground; 0.3 where neither this nor a
    /// luminance is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reflectance: Option<f64>,
    /// Luminance of all faces of the box in place of a reflectance, independent of the light on it. \[cd/m²\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub luminance: Option<f64>,
}

/// Key `outside.box`: position and size of a box in room axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoxKeys {
    /// Smallest x, y and z of the box before rotation, in room axes. \[m\]
    pub from: [f64; 3],
    /// Largest x, y and z of the box before rotation, in room axes. \[m\]
    pub to: [f64; 3],
    /// Rotation about the vertical axis through the centre of the box, counter-clockwise seen from above. \[°\]
    #[serde(default)]
    pub turn: f64,
}

/// Section `[building]` of a scene file: box of the building of which the room is a part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BuildingKeys {
    /// Smallest x, y and z of the building, in room axes. \[m\]
    pub from: [f64; 3],
    /// Largest x, y and z of the building, in room axes. \[m\]
    pub to: [f64; 3],
    /// Diffuse reflectance of the building, 0 … 1.
    #[serde(default = "usual_reflectance")]
    pub reflectance: f64,
}

const fn usual_reflectance() -> f64 {
    USUAL_REFLECTANCE
}

/// Default diffuse reflectance of a box or building, as of weathered concrete or plaster.
pub const USUAL_REFLECTANCE: f64 = 0.3;

/// Key `sky.skyline`: skyline whose altitude varies with the bearing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SkylineKeys {
    /// Points of the skyline: compass bearing (clockwise from north) and altitude, linear between them, all round.
    /// \[°\]
    pub altitudes: Vec<[f64; 2]>,
    /// Luminance of everything below the skyline. \[cd/m²\]
    #[serde(default)]
    pub luminance: f64,
}

/// Returns the default of `aperture.dirt`, which is 1 (clean).
pub(super) const fn clean() -> f64 {
    1.0
}

/// Whether the dirt factor has the default value, which is not written to the file.
pub(super) fn is_clean(dirt: &f64) -> bool {
    *dirt == clean()
}

/// Whether a frame fraction is 0, which is not written to the file.
pub(super) fn is_none(share: &f64) -> bool {
    *share == 0.0
}
