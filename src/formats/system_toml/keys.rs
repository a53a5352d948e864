//! Keys of a system file as the user types them, with their defaults. Angles in degrees, lengths in metres. The key
//! `solar` is converted by [`super::solar`].

use serde::Deserialize;
use toml::Table;

/// Table `venetian`: blind of equal slats.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Venetian {
    /// Width of a slat along its chord; not given together with `profile`. \[m\]
    #[serde(default)]
    pub width: f64,
    /// Vertical pitch of the slats. \[m\]
    pub spacing: f64,
    /// Thickness of a slat; 0 for a thin sheet. \[m\]
    #[serde(default)]
    pub thickness: f64,
    /// Height of the slat's crown over the chord, positive with the convex side up; 0 for a flat slat. \[m\]
    #[serde(default)]
    pub rise: f64,
    /// Polyline of (outward, upward) points of a slat at tilt 0 from one edge to the other, instead of `width` and
    /// `rise`. \[m\]
    pub profile: Option<Vec<Pair>>,
    /// Tilt angles of the states, from −90° to 90°, positive with the outer edge lowered. \[°\]
    pub angles: Angles,
    /// Finish of the face of a slat that looks upwards at tilt 0.
    pub upper: Face,
    /// Finish of the face of a slat that looks downwards at tilt 0.
    pub lower: Face,
}

/// Tilt angles of the states \[°\]: a list, or a range with a step.
#[derive(Debug, Deserialize)]
#[serde(untagged, expecting = "a list of degrees, or { from, to, step }")]
pub(super) enum Angles {
    /// List of the tilt angles. \[°\]
    Listed(Vec<f64>),
    /// Range of the tilt angles with a constant step.
    Steps(Steps),
}

/// Range of tilt angles with a constant step.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Steps {
    /// First tilt angle. \[°\]
    pub from: f64,
    /// Upper limit of the tilt angles, included if a step reaches it. \[°\]
    pub to: f64,
    /// Step between tilt angles, positive. \[°\]
    pub step: f64,
}

/// Finish of a face of a slat.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Face {
    /// Diffuse (Lambertian) reflectance, 0 … 1.
    pub reflectance: f64,
    /// Specular reflectance, 0 … 1; with `reflectance` at most 1.
    #[serde(default)]
    pub specular: f64,
    /// Standard deviation of the specularly reflected direction about the ideal one, 0 … 45. \[°\]
    #[serde(default)]
    pub roughness: f64,
    /// Values of the other keys in the solar band, read by [`super::solar`].
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

/// Table `laser-cut-panel`: clear sheet with plane cuts that reflect totally.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LaserCut {
    /// Refractive index of the sheet, at least √2.
    pub index: f64,
    /// Vertical distance between cuts. \[m\]
    pub spacing: f64,
    /// Thickness of the sheet, i.e. depth of the cuts. \[m\]
    pub depth: f64,
    /// Absorption coefficient of the sheet. \[1/m\]
    #[serde(default)]
    pub absorption: f64,
    /// Share of the light that is lost at every reflection at a cut, 0 … 1.
    #[serde(default)]
    pub cut_loss: f64,
    /// Values of the other keys in the solar band, read by [`super::solar`].
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

/// Table `prismatic`: clear sheet with prisms on one face.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Prismatic {
    /// Refractive index of the sheet.
    pub index: f64,
    /// Angles of the upper and of the lower flank of a ridge against the plane of the sheet. \[°\]
    pub angles: Pair,
    /// Vertical distance between ridges. \[m\]
    pub pitch: f64,
    /// Thickness of the sheet under the prisms, from the flat face to a valley. \[m\]
    pub base: f64,
    /// Whether the prisms face the outside instead of the room.
    #[serde(default)]
    pub flipped: bool,
    /// Absorption coefficient of the sheet. \[1/m\]
    #[serde(default)]
    pub absorption: f64,
    /// Values of the other keys in the solar band, read by [`super::solar`].
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

/// Table `redirecting-glass`: profiles of clear material between two panes.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RedirectingGlass {
    /// Refractive index of the profiles.
    pub index: f64,
    /// Absorption coefficient of the profiles. \[1/m\]
    #[serde(default)]
    pub absorption: f64,
    /// Vertical period of the profiles. \[m\]
    pub spacing: f64,
    /// Closed outlines of the profiles of one period, as (outward, upward) points. \[m\]
    pub bodies: Vec<Vec<Pair>>,
    /// Pane on the outside, if there is one.
    pub outer: Option<Sheet>,
    /// Pane on the room side, if there is one.
    pub inner: Option<Sheet>,
    /// Values of the other keys in the solar band, read by [`super::solar`].
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

/// Clear pane in front of or behind the profiles of light-redirecting glass.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Sheet {
    /// Refractive index of the pane.
    pub index: f64,
    /// Thickness of the pane. \[m\]
    pub thickness: f64,
    /// Absorption coefficient of the pane. \[1/m\]
    #[serde(default)]
    pub absorption: f64,
    /// Values of the other keys in the solar band, read by [`super::solar`].
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

/// Table `pane`: glazing of equal plane-parallel panes.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Pane {
    /// Refractive index of the panes.
    pub index: f64,
    /// Thickness of a pane. \[m\]
    #[serde(default)]
    pub thickness: f64,
    /// Absorption coefficient of the panes, instead of `transmittance_normal`. \[1/m\]
    pub absorption: Option<f64>,
    /// Transmittance of a pane at normal incidence, 0 … 1.
    pub transmittance_normal: Option<f64>,
    /// Reflectance of a coated pane at normal incidence for light from outside, 0 … 1.
    pub reflectance_normal: Option<f64>,
    /// Reflectance of a coated pane at normal incidence for light from inside, 0 … 1; by default `reflectance_normal`.
    pub reflectance_normal_back: Option<f64>,
    /// Number of panes, 1 … 10.
    #[serde(default = "one")]
    pub panes: usize,
    /// Values of the other keys in the solar band, read by [`super::solar`].
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

/// Pair of exactly two numbers; a longer list is an error.
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

/// Returns the default number of panes.
fn one() -> usize {
    1
}

/// Table `diffuser`: sheet that scatters light.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Diffuser {
    /// Scattering model, which decides the other keys.
    pub model: DiffuserModel,
    /// Direct-hemispherical transmittance at normal incidence, 0 … 1.
    pub transmittance: f64,
    /// Diffuse reflectance at normal incidence, 0 … 1; for the models `lambertian` and `opal`.
    pub reflectance: Option<f64>,
    /// Refractive index; for the models `opal` and `spreading`.
    pub index: Option<f64>,
    /// Share of the transmitted light that is undeviated, 0 … 1; for the model `spreading`.
    pub regular: Option<f64>,
    /// Share of the transmitted light in a lobe about the undeviated direction, 0 … 1; for the model `spreading`.
    pub lobe: Option<f64>,
    /// Standard deviation of the lobe, 0.6 … 60; for the model `spreading`. \[°\]
    pub spread: Option<f64>,
    /// Absorbed share of the light that is not transmitted, 0 … 1; for the model `spreading`.
    pub absorbed: Option<f64>,
    /// Values of the other keys in the solar band, read by [`super::solar`].
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

/// Scattering model of a diffuser.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum DiffuserModel {
    /// Lambertian sheet: the same luminance in all directions.
    Lambertian,
    /// Scattering volume between two smooth surfaces.
    Opal,
    /// Sheet that transmits one part of the light undeviated, one in a lobe and one diffusely.
    Spreading,
}

/// Table `woven`: fabric of yarns with openings.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Woven {
    /// Open share of the area at normal incidence, 0 … 0.95.
    pub openness: f64,
    /// Diffuse reflectance of the yarn on the outer face, 0 … 1.
    pub reflectance: f64,
    /// Diffuse reflectance of the yarn on the inner face, 0 … 1; by default that on the outer face.
    pub reflectance_back: Option<f64>,
    /// Diffuse transmittance of the yarn, 0 … 1.
    #[serde(default)]
    pub transmittance: f64,
    /// Values of the other keys in the solar band, read by [`super::solar`].
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

/// Shape of the holes of a perforated sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum HoleShape {
    /// Circle, given by its diameter.
    Round,
    /// Rectangle, given by width and height.
    Rectangle,
    /// Rhombus with horizontal and vertical diagonals.
    Rhombus,
}

/// Table `perforated`: opaque sheet with equal holes.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Perforated {
    /// Shape of the holes.
    pub hole: HoleShape,
    /// Diameter, width or horizontal diagonal of a hole. \[m\]
    pub width: f64,
    /// Height or vertical diagonal of a hole that is not round; by default `width`. \[m\]
    pub height: Option<f64>,
    /// Horizontal and vertical distance between holes. \[m\]
    pub pitch: Pair,
    /// Whether every rectangle of four neighbouring holes has another hole in its middle.
    #[serde(default)]
    pub staggered: bool,
    /// Thickness of the sheet. \[m\]
    pub thickness: f64,
    /// Height by which the room-side end of a hole lies above its outer end. \[m\]
    #[serde(default)]
    pub rise: f64,
    /// Diffuse reflectance of the outer face, 0 … 1.
    pub reflectance: f64,
    /// Diffuse reflectance of the inner face, 0 … 1; by default that of the outer face.
    pub reflectance_back: Option<f64>,
    /// Diffuse reflectance of the walls of the holes, 0 … 1; by default that of the outer face.
    pub reflectance_wall: Option<f64>,
    /// Values of the other keys in the solar band, read by [`super::solar`].
    #[serde(rename = "solar")]
    _solar: Option<Table>,
}

/// Table `stack`: layers one behind the other.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Stack {
    /// Layers from outside to inside.
    pub layers: Vec<Layer>,
}

/// Layer of a stack: exactly one of a file, a product of the catalogue or a system.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Layer {
    /// Path of the system file or data file of the layer.
    pub file: Option<String>,
    /// Key of the layer's product in the catalogue.
    pub catalogue: Option<String>,
    /// Description of the layer inside the stack, with the keys of a system file.
    pub system: Option<Table>,
    /// Key of the layer's state; empty for a layer without states, `each` for a stack with all states of the layer.
    #[serde(default)]
    pub state: String,
}

/// Keys of a system file that only the catalogue uses.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Catalogue {
    /// Key of the product in the catalogue.
    pub key: String,
    /// Tags by which the catalogue can be filtered.
    pub tags: Vec<String>,
    /// Key of the control rule from which the product's control curve is computed; empty for none.
    pub control: String,
}
