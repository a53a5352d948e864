//! Ways to read the numbers of a band: each block as it stands, or turned, transposed, without a factor, or taken for
//! another one.

use super::blocks::{Blocks, Turn};
use crate::compute::btdf::Component;

/// A factor that is suspected in values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Factor {
    /// Multiplied by the cosine of the emergent angle.
    CosineTooMuch,
    /// Divided by the cosine of the emergent angle.
    CosineTooLittle,
    /// Divided by the cosine of the incident angle: what leaves symmetric values when the cosine of emergence is too
    /// much does so too. No repair undoes it; it stands against those that do.
    IncidentTooLittle,
    /// Multiplied by the cosine of the incident angle.
    IncidentTooMuch,
    /// Multiplied by the projected solid angle of the emergent cell.
    SolidAngle,
}

impl Factor {
    /// Is it one of the emergent angle or cell?
    pub(super) const fn of_emergence(self) -> bool {
        !matches!(self, Self::IncidentTooLittle | Self::IncidentTooMuch)
    }

    /// What undoes it for an incident and an emergent cell, as a product of both.
    pub(super) fn undone(self, blocks: &Blocks) -> (Vec<f64>, Vec<f64>) {
        let one = vec![1.0; blocks.weight.len()];
        let inverse = |list: &[f64]| list.iter().map(|value| 1.0 / value).collect();
        match self {
            Self::CosineTooMuch => (one, inverse(&blocks.cosine)),
            Self::CosineTooLittle => (one, blocks.cosine.clone()),
            Self::IncidentTooLittle => (blocks.cosine.clone(), one),
            Self::IncidentTooMuch => (inverse(&blocks.cosine), one),
            Self::SolidAngle => (one, inverse(&blocks.weight)),
        }
    }
}

/// One block, read in one way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Part {
    /// The block whose numbers these are, by its place in [`Component::ALL`].
    pub(super) source: usize,
    /// Turned so.
    pub(super) turn: Option<Turn>,
    /// Incident and emergent directions exchanged.
    pub(super) transposed: bool,
    /// Without this factor.
    pub(super) factor: Option<Factor>,
}

impl Part {
    /// As it stands.
    pub(super) const fn plain(source: usize) -> Self {
        Self { source, turn: None, transposed: false, factor: None }
    }
}

/// What is read for each of the four functions.
pub(super) type Reading = [Option<Part>; 4];

/// The numbers as they stand.
pub(super) fn as_it_is(blocks: &Blocks) -> Reading {
    Component::ALL.map(|component| blocks.get(component).map(|_| Part::plain(component as usize)))
}

/// A turn after another; both without the quarter turn.
pub(super) fn after(a: Option<Turn>, b: Option<Turn>) -> Option<Turn> {
    use Turn::{HalfRound, LeftRight, UpDown};
    match (a, b) {
        (None, turn) | (turn, None) => turn,
        (Some(a), Some(b)) if a == b => None,
        (Some(UpDown), Some(LeftRight)) | (Some(LeftRight), Some(UpDown)) => Some(HalfRound),
        (Some(UpDown), Some(_)) | (Some(_), Some(UpDown)) => Some(LeftRight),
        (Some(_), Some(_)) => Some(UpDown),
    }
}
