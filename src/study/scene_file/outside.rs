//! Keys of the obstructions: boxes in front of the façade and above the roof, a skyline; and of frame and dirt.

use serde::{Deserialize, Serialize};

/// Table `[[outside]]`: a vertical box outside the room's own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OutsideKeys {
    /// Name of the box; optional.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Position and size of the box.
    #[serde(rename = "box")]
    pub solid: BoxKeys,
    /// Diffuse reflectance, 0 … 1, of a box lit by sky, sun and ground; 0.3 where neither this nor a luminance is
    /// written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reflectance: Option<f64>,
    /// Luminance of all faces instead of a reflectance, independent of incident light. \[cd/m²\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub luminance: Option<f64>,
}

/// Key `outside.box`: position and size of a box.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoxKeys {
    /// Minimum x, y and z, room axes. \[m\]
    pub from: [f64; 3],
    /// Maximum x, y and z before the rotation, room axes. \[m\]
    pub to: [f64; 3],
    /// Rotation about the vertical axis through the centre, counter-clockwise seen from above. \[°\]
    #[serde(default)]
    pub turn: f64,
}

/// Section `[building]`: box of the building that the room is part of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BuildingKeys {
    /// Minimum x, y and z, room axes. \[m\]
    pub from: [f64; 3],
    /// Maximum x, y and z, room axes. \[m\]
    pub to: [f64; 3],
    /// Diffuse reflectance, 0 … 1.
    #[serde(default = "usual_reflectance")]
    pub reflectance: f64,
}

const fn usual_reflectance() -> f64 {
    USUAL_REFLECTANCE
}

/// Default diffuse reflectance of a box or building: concrete, plaster in the weather.
pub const USUAL_REFLECTANCE: f64 = 0.3;

/// Key `sky.skyline`: skyline that rises and falls with the bearing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SkylineKeys {
    /// Compass bearing and altitude, linear between the points, all round. \[°\]
    pub altitudes: Vec<[f64; 2]>,
    /// Luminance below the skyline. \[cd/m²\]
    #[serde(default)]
    pub luminance: f64,
}

/// Returns the default of `aperture.dirt`.
pub(super) const fn clean() -> f64 {
    1.0
}

/// Whether the dirt factor is the default, which is not written.
pub(super) fn is_clean(dirt: &f64) -> bool {
    *dirt == clean()
}

/// Whether the share is 0, which is not written.
pub(super) fn is_none(share: &f64) -> bool {
    *share == 0.0
}
