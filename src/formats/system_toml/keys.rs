//! Keys of a system file as typed, with their defaults. Angles in degrees, lengths in metres. `solar` is checked by
//! [`super::solar`], which makes other keys of it.

use serde::Deserialize;
use toml::Table;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Venetian {
    #[serde(default)]
    pub width: f64,
    pub spacing: f64,
    #[serde(default)]
    pub thickness: f64,
    #[serde(default)]
    pub rise: f64,
    pub profile: Option<Vec<Pair>>,
    pub angles: Angles,
    pub upper: Face,
    pub lower: Face,
}

/// Angles as a list, or from … to in steps.
#[derive(Debug, Deserialize)]
#[serde(untagged, expecting = "a list of degrees, or { from, to, step }")]
pub(super) enum Angles {
    Listed(Vec<f64>),
    Steps(Steps),
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Steps {
    pub from: f64,
    pub to: f64,
    pub step: f64,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Face {
    pub reflectance: f64,
    #[serde(default)]
    pub specular: f64,
    #[serde(default)]
    pub roughness: f64,
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LaserCut {
    pub index: f64,
    pub spacing: f64,
    pub depth: f64,
    #[serde(default)]
    pub absorption: f64,
    #[serde(default)]
    pub cut_loss: f64,
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Prismatic {
    pub index: f64,
    pub angles: Pair,
    pub pitch: f64,
    pub base: f64,
    #[serde(default)]
    pub flipped: bool,
    #[serde(default)]
    pub absorption: f64,
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RedirectingGlass {
    pub index: f64,
    #[serde(default)]
    pub absorption: f64,
    pub spacing: f64,
    pub bodies: Vec<Vec<Pair>>,
    pub outer: Option<Sheet>,
    pub inner: Option<Sheet>,
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Sheet {
    pub index: f64,
    pub thickness: f64,
    #[serde(default)]
    pub absorption: f64,
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Pane {
    pub index: f64,
    #[serde(default)]
    pub thickness: f64,
    pub absorption: Option<f64>,
    pub transmittance_normal: Option<f64>,
    pub reflectance_normal: Option<f64>,
    pub reflectance_normal_back: Option<f64>,
    #[serde(default = "one")]
    pub panes: usize,
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

/// Pair of numbers, and no more: an array would leave further ones unread.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "Vec<f64>")]
pub(super) struct Pair(pub [f64; 2]);

impl TryFrom<Vec<f64>> for Pair {
    type Error = String;

    fn try_from(list: Vec<f64>) -> Result<Self, String> {
        let count = list.len();
        list.try_into().map(Self).map_err(|_| format!("{count} numbers, expected two"))
    }
}

fn one() -> usize {
    1
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Diffuser {
    pub model: DiffuserModel,
    pub transmittance: f64,
    pub reflectance: Option<f64>,
    pub index: Option<f64>,
    pub regular: Option<f64>,
    pub lobe: Option<f64>,
    pub spread: Option<f64>,
    pub absorbed: Option<f64>,
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum DiffuserModel {
    Lambertian,
    Opal,
    Spreading,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Woven {
    pub openness: f64,
    pub reflectance: f64,
    pub reflectance_back: Option<f64>,
    #[serde(default)]
    pub transmittance: f64,
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum HoleShape {
    Round,
    Rectangle,
    Rhombus,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Perforated {
    pub hole: HoleShape,
    pub width: f64,
    pub height: Option<f64>,
    pub pitch: Pair,
    #[serde(default)]
    pub staggered: bool,
    pub thickness: f64,
    #[serde(default)]
    pub rise: f64,
    pub reflectance: f64,
    pub reflectance_back: Option<f64>,
    pub reflectance_wall: Option<f64>,
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Stack {
    pub layers: Vec<Layer>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Layer {
    pub file: Option<String>,
    pub catalogue: Option<String>,
    /// Description of the layer itself, with the keys of a system file.
    pub system: Option<Table>,
    #[serde(default)]
    pub state: String,
}

/// Keys that only the catalogue uses.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Catalogue {
    pub key: String,
    pub tags: Vec<String>,
    pub control: String,
}
