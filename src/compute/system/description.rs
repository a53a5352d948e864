//! What a system is made of: geometry and material, enough to compute its scattering anew.

use super::coated;
use super::glazing::Pane;
use super::slat_profile::SlatProfile;
use crate::compute::dielectric::prism::Prisms;
use crate::compute::goniophotometer::panels::CutPanel;
use crate::compute::section::Surface;

/// A described system. Keys of its states are in [`SystemDescription::states`].
#[derive(Debug, Clone, PartialEq)]
pub struct SystemDescription {
    /// Product name.
    pub name: String,
    /// Free text.
    pub description: String,
    /// Geometry and material.
    pub kind: SystemKind,
    /// Turned by 90° about the normal, so that what is horizontal in the description stands upright (vertical louvres):
    /// what was up points to the right as seen from outside.
    pub upright: bool,
}

/// What can be computed.
#[derive(Debug, Clone, PartialEq)]
pub enum SystemKind {
    /// Endless array of slats.
    Venetian(Venetian),
    /// Sheet with plane cuts.
    LaserCutPanel(CutPanel),
    /// Sheet with prisms on one face.
    Prismatic(Prisms),
    /// Profiles of clear material between two panes.
    RedirectingGlass(RedirectingGlass),
    /// Plane-parallel panes.
    Pane(PaneStack),
    /// Scattering sheet.
    Diffuser(Diffuser),
    /// Fabric of yarns.
    Woven(Woven),
    /// Opaque sheet with holes: perforated and expanded metal, grids.
    Perforated(Perforated),
    /// Layers from outside to inside.
    Stack(Vec<Layer>),
}

/// Slats, horizontal, periodic upwards; they turn about the middle of their chord.
#[derive(Debug, Clone, PartialEq)]
pub struct Venetian {
    /// Section of a slat at tilt 0.
    pub profile: SlatProfile,
    /// Vertical pitch. \[m\]
    pub spacing: f64,
    /// Thickness of a slat, 0 = sheet. \[m\]
    pub thickness: f64,
    /// Tilt of each state, > 0 = outer edge lowered, 90° = closed. \[rad\]
    pub angles: Vec<f64>,
    /// Upper face.
    pub upper: Surface,
    /// Lower face.
    pub lower: Surface,
}

/// Bodies of clear material, stacked with a period, between two clear panes.
#[derive(Debug, Clone, PartialEq)]
pub struct RedirectingGlass {
    /// Refractive index of the profiles.
    pub index: f64,
    /// Absorption coefficient of the profiles. \[1/m\]
    pub absorption: f64,
    /// Vertical period. \[m\]
    pub spacing: f64,
    /// Outlines of the bodies of one period, (outward, upward). \[m\]
    pub bodies: Vec<Vec<[f64; 2]>>,
    /// Panes outside and inside.
    pub panes: [Option<Pane>; 2],
}

/// Equal panes with air between; interference left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaneStack {
    /// One pane.
    pub pane: coated::Layer,
    /// How many.
    pub panes: usize,
}

impl PaneStack {
    /// The panes one by one.
    pub fn layers(&self) -> Vec<super::coated::Layer> {
        vec![self.pane; self.panes]
    }
}

/// A sheet that scatters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Diffuser {
    /// The same luminance everywhere whatever the incidence.
    Lambertian {
        /// Transmittance.
        transmittance: f64,
        /// Reflectance.
        reflectance: f64,
    },
    /// A scattering volume between two smooth surfaces.
    Opal(super::diffuser::Opal),
    /// A sheet that keeps, spreads and diffuses shares of the light.
    Spreading(super::diffuser::Spreading),
}

/// A fabric by its openness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Woven {
    /// Open share of the area at normal incidence.
    pub openness: f64,
    /// Diffuse reflectance of the yarn on the outer and inner face.
    pub reflectance: [f64; 2],
    /// Transmittance of the yarn, all of it diffuse.
    pub transmittance: f64,
}

/// Pattern and shape of holes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hole {
    /// Round, given by its diameter. \[m\]
    Round {
        /// Diameter. \[m\]
        diameter: f64,
    },
    /// A rectangle, width and height. \[m\]
    Rectangle {
        /// Width along x. \[m\]
        width: f64,
        /// Height along y. \[m\]
        height: f64,
    },
    /// A rhombus with horizontal and vertical diagonals, as in expanded metal. \[m\]
    Rhombus {
        /// Horizontal diagonal. \[m\]
        width: f64,
        /// Vertical diagonal. \[m\]
        height: f64,
    },
}

/// An opaque Lambertian sheet with equal holes; their walls may run obliquely upwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Perforated {
    /// The hole.
    pub hole: Hole,
    /// Area of the sheet per hole. \[m²\]
    pub area: f64,
    /// Thickness of the sheet. \[m\]
    pub thickness: f64,
    /// How much higher the hole lies on the room side, > 0 = its walls rise inwards (strands of expanded metal). \[m\]
    pub rise: f64,
    /// Diffuse reflectance of the outer face, the inner face and the walls.
    pub reflectance: [f64; 3],
}

/// One layer of a stack.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// What it is, as the description names it: a system file, a dataset file or `catalogue:KEY`.
    pub source: LayerSource,
    /// Key of its state; empty for the only one.
    pub state: String,
}

/// Where a layer comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum LayerSource {
    /// A file, its path relative to the description's.
    File(String),
    /// A product of the catalogue.
    Catalogue(String),
}

impl SystemKind {
    /// The word used in files and in the catalogue.
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Venetian(_) => "venetian",
            Self::LaserCutPanel(_) => "laser-cut-panel",
            Self::Prismatic(_) => "prismatic",
            Self::RedirectingGlass(_) => "redirecting-glass",
            Self::Pane(_) => "pane",
            Self::Diffuser(_) => "diffuser",
            Self::Woven(_) => "woven",
            Self::Perforated(_) => "perforated",
            Self::Stack(_) => "stack",
        }
    }
}

impl SystemDescription {
    /// Keys of the states: angles in degrees as shortest decimals; one empty key for a system without states.
    pub fn states(&self) -> Vec<String> {
        match &self.kind {
            SystemKind::Venetian(blind) => blind.angles.iter().map(|&angle| state_key(angle)).collect(),
            _ => vec![String::new()],
        }
    }

    /// Period of what is to be seen of it. \[m\] `None` for plain sheets and stacks.
    pub fn structure(&self) -> Option<f64> {
        Some(match &self.kind {
            SystemKind::Venetian(blind) => blind.spacing,
            SystemKind::LaserCutPanel(cut) => cut.panel.spacing,
            SystemKind::Prismatic(sheet) => sheet.pitch,
            SystemKind::RedirectingGlass(glass) => glass.spacing,
            SystemKind::Perforated(sheet) => sheet.area.sqrt(),
            SystemKind::Pane(_) | SystemKind::Diffuser(_) | SystemKind::Woven(_) | SystemKind::Stack(_) => return None,
        })
    }
}

/// Key of the state at an angle \[rad\]: degrees as shortest decimal, free of the last digits that the conversion adds.
pub fn state_key(angle: f64) -> String {
    let degrees = (angle.to_degrees() * 1e9).round() / 1e9;
    // Minus zero is zero.
    format!("{}", degrees + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_shortest_decimals() {
        let keys = [-0.0, 45.0, -30.0, 22.5, 0.1 + 0.2].map(|degrees: f64| state_key(degrees.to_radians()));
        assert_eq!(keys, ["0", "45", "-30", "22.5", "0.3"]);
    }
}
