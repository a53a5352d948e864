//! Readings of the numbers of a band: each block as given, or turned, transposed, without a factor, or taken for
//! another one.

use super::blocks::{Blocks, Turn};
use crate::compute::btdf::Component;

/// Factor that is suspected in values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Factor {
    /// Values multiplied by the cosine of the emergent angle.
    CosineTooMuch,
    /// Values divided by the cosine of the emergent angle.
    CosineTooLittle,
    /// Values divided by the cosine of the incident angle. It leaves symmetric values wherever a surplus cosine of
    /// emergence does. No repair undoes it; it is a rival of the hypotheses with a repair.
    IncidentTooLittle,
    /// Values multiplied by the cosine of the incident angle.
    IncidentTooMuch,
    /// Values multiplied by the projected solid angle of the emergent cell.
    SolidAngle,
}

impl Factor {
    /// Whether the factor depends on the emergent angle or cell.
    pub(super) const fn of_emergence(self) -> bool {
        !matches!(self, Self::IncidentTooLittle | Self::IncidentTooMuch)
    }

    /// Returns the inverse of the factor, by incident cell and by emergent cell; a value is multiplied by both.
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

/// Reading of one block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Part {
    /// Index in [`Component::ALL`] of the block whose numbers are read.
    pub(super) source: usize,
    /// Turn of the directions, if any.
    pub(super) turn: Option<Turn>,
    /// Whether incident and emergent directions are exchanged.
    pub(super) transposed: bool,
    /// Factor that is removed from the values, if any.
    pub(super) factor: Option<Factor>,
}

impl Part {
    /// Creates the reading of a block as given.
    pub(super) const fn plain(source: usize) -> Self {
        Self { source, turn: None, transposed: false, factor: None }
    }
}

/// Readings of the four functions.
pub(super) type Reading = [Option<Part>; 4];

/// Returns the reading of all blocks as given.
pub(super) fn as_it_is(blocks: &Blocks) -> Reading {
    Component::ALL.map(|component| blocks.get(component).map(|_| Part::plain(component as usize)))
}

/// Returns the composition of two turns, neither of them a quarter turn.
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
