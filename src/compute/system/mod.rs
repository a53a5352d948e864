//! Described systems, a room a family: slats, clear profiles, panes, laser-cut panels, thin sheets, stacks of all.
//!
//! Every family answers the same questions ([`Family`]): its words, states and structure, a drawing of its section, and
//! a [`Specimen`] that the numerical goniophotometer ([`measure`]) makes data from. A family is added
//! by a room of its own, its kind in [`SystemKind`] and its arm in [`SystemKind::family`]; its keys in system files are
//! in `formats::system_toml`.

pub mod clear;
mod family;
pub mod laser_cut;
pub mod measure;
pub mod panes;
pub mod sheets;
pub mod slats;
pub mod stack;

pub use family::{Family, NoSpecimen, state_key};

use clear::prism::Prisms;
use clear::redirecting::RedirectingGlass;
use laser_cut::CutPanel;
use measure::Specimen;
use measure::upright::Upright;
use panes::PaneStack;
use sheets::{Diffuser, Perforated, Woven};
use slats::Venetian;
use stack::Layer;

/// A described system.
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

impl SystemKind {
    /// The family's answers.
    pub fn family(&self) -> &dyn Family {
        match self {
            Self::Venetian(blind) => blind,
            Self::LaserCutPanel(panel) => panel,
            Self::Prismatic(sheet) => sheet,
            Self::RedirectingGlass(glass) => glass,
            Self::Pane(stack) => stack,
            Self::Diffuser(sheet) => sheet,
            Self::Woven(fabric) => fabric,
            Self::Perforated(sheet) => sheet,
            Self::Stack(layers) => layers,
        }
    }
}

impl SystemDescription {
    /// The family's answers.
    pub fn family(&self) -> &dyn Family {
        self.kind.family()
    }

    /// Keys of the states; one empty key for a system without states.
    pub fn states(&self) -> Vec<String> {
        self.family().states()
    }

    /// The specimen of one state of a system that needs no other files.
    ///
    /// # Errors
    /// A state that is not there, geometry that encloses nothing; a stack, whose layers only its caller can find.
    pub fn specimen(&self, state: &str) -> Result<Box<dyn Specimen>, NoSpecimen> {
        let family = self.family();
        let states = self.states();
        if !states.iter().any(|key| key == state) {
            let states: Vec<String> = states.iter().map(|key| format!("\"{key}\"")).collect();
            return Err(NoSpecimen(format!("no such state; its states are {}", states.join(", "))));
        }
        let made = family.specimen(state).map_err(|error| NoSpecimen(format!("{}: {error}", family.word())))?;
        Ok(if self.upright { Box::new(Upright(made)) } else { made })
    }
}
