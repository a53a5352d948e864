//! Described systems, one module per family: slats, clear profiles, panes, laser-cut panels, thin sheets, stacks of
//! all.
//!
//! Every family implements the same interface ([`Family`]): its keys, states and structure, a drawing of its section,
//! and an [`OpticalModel`], from which the virtual goniophotometer ([`measure`]) computes data. A family is added by a
//! separate module, its kind in [`SystemKind`] and its arm in [`SystemKind::family`]; the keys of its system files are
//! in `formats::system_toml`.

pub mod clear;
mod family;
pub mod laser_cut;
pub mod measure;
pub mod panes;
pub mod sheets;
pub mod slats;
pub mod stack;

pub use family::{Family, OpticalModelError, state_key};

use clear::prism::Prisms;
use clear::redirecting::RedirectingGlass;
use laser_cut::CutPanel;
use measure::OpticalModel;
use measure::upright::Upright;
use panes::PaneStack;
use sheets::{Diffuser, Perforated, Woven};
use slats::Venetian;
use stack::Layer;

/// System described by geometry and material (content of a `.system.toml` file), with its product name.
#[derive(Debug, Clone, PartialEq)]
pub struct SystemDescription {
    /// Product name.
    pub name: String,
    /// Description in free text.
    pub description: String,
    /// Geometry and material of the system, by its kind.
    pub kind: SystemKind,
    /// Whether the system is rotated by 90° about the normal, so that horizontal slats become vertical louvres: the
    /// upward direction then points to the right as seen from outside.
    pub upright: bool,
}

/// Kinds of systems that can be computed.
#[derive(Debug, Clone, PartialEq)]
pub enum SystemKind {
    /// Venetian blind or louvres: endless array of horizontal slats.
    Venetian(Venetian),
    /// Laser-cut panel: clear sheet with plane cuts that reflect totally.
    LaserCutPanel(CutPanel),
    /// Prismatic sheet: clear sheet with prisms on one face.
    Prismatic(Prisms),
    /// Light-redirecting glass: profiles of clear material between two panes.
    RedirectingGlass(RedirectingGlass),
    /// Glazing of equal plane-parallel panes.
    Pane(PaneStack),
    /// Diffuser: sheet that scatters light.
    Diffuser(Diffuser),
    /// Woven screen: fabric of yarns with openings.
    Woven(Woven),
    /// Opaque sheet with holes: perforated and expanded metal, grids.
    Perforated(Perforated),
    /// Stack of layers, one behind the other, from outside to inside.
    Stack(Vec<Layer>),
}

impl SystemKind {
    /// Returns the interface of the system's family: states, drawing and optical model.
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
    /// Returns the interface of the system's family: states, drawing and optical model.
    pub fn family(&self) -> &dyn Family {
        self.kind.family()
    }

    /// Returns the keys of the system's states (e.g. slat angles in degrees); one empty key for a system without
    /// states.
    pub fn states(&self) -> Vec<String> {
        self.family().states()
    }

    /// Creates the optical model of the system in the state with key `state`, if it needs no other files.
    ///
    /// # Errors
    /// Returns an error for an unknown state, for geometry that encloses nothing, and for a stack, whose layers only
    /// its caller can find.
    pub fn optical_model(&self, state: &str) -> Result<Box<dyn OpticalModel>, OpticalModelError> {
        let family = self.family();
        let states = self.states();
        if !states.iter().any(|key| key == state) {
            let states: Vec<String> = states.iter().map(|key| format!("\"{key}\"")).collect();
            return Err(OpticalModelError(format!("no such state; its states are {}", states.join(", "))));
        }
        let made =
            family.optical_model(state).map_err(|error| OpticalModelError(format!("{}: {error}", family.word())))?;
        Ok(if self.upright { Box::new(Upright(made)) } else { made })
    }
}
