//! What stands outside, as typed: boxes before the façade and above the roof, a skyline, frame and dirt.

use serde::{Deserialize, Serialize};

/// `[[outside]]`: an upright box, outside the room's own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OutsideKeys {
    /// What it is called; may be left out.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Where it stands.
    #[serde(rename = "box")]
    pub solid: BoxKeys,
    /// Diffuse, 0 … 1: lit by sky, sun and ground. 0.3 where neither this nor a luminance is written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reflectance: Option<f64>,
    /// Instead: the same on all faces, whatever falls on them. \[cd/m²\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub luminance: Option<f64>,
}

/// `outside.box`
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoxKeys {
    /// Least x, y and z, room axes. \[m\]
    pub from: [f64; 3],
    /// Greatest x, y and z, before it is turned. \[m\]
    pub to: [f64; 3],
    /// About the vertical through its centre, counter-clockwise seen from above. \[°\]
    #[serde(default)]
    pub turn: f64,
}

/// `[building]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BuildingKeys {
    /// Least x, y and z, room axes. \[m\]
    pub from: [f64; 3],
    /// Greatest x, y and z. \[m\]
    pub to: [f64; 3],
    /// Diffuse, 0 … 1.
    #[serde(default = "usual_reflectance")]
    pub reflectance: f64,
}

const fn usual_reflectance() -> f64 {
    USUAL_REFLECTANCE
}

/// Diffuse reflectance of a box or building that names none: concrete, plaster in the weather.
pub const USUAL_REFLECTANCE: f64 = 0.3;

/// `sky.skyline`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SkylineKeys {
    /// Compass bearing and altitude, linear between, all round. \[°\]
    pub altitudes: Vec<[f64; 2]>,
    /// Of what stands below it. \[cd/m²\]
    #[serde(default)]
    pub luminance: f64,
}

/// `aperture.dirt` where nothing is written.
pub(super) const fn clean() -> f64 {
    1.0
}

/// Nothing that the file needs to say.
pub(super) fn is_clean(dirt: &f64) -> bool {
    *dirt == clean()
}

/// Nothing that the file needs to say.
pub(super) fn is_none(share: &f64) -> bool {
    *share == 0.0
}
