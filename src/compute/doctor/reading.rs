//! Readings (interpretations) of the numbers of a band: each function as given, or with its directions rotated,
//! mirrored or exchanged, with a factor removed, or taken for another function.

use super::blocks::{Blocks, Turn};
use crate::compute::btdf::Component;

/// Factor that the values of a function are suspected to contain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Factor {
    /// Values wrongly multiplied by the cosine of the emergent angle.
    CosineTooMuch,
    /// Values wrongly divided by the cosine of the emergent angle.
    CosineTooLittle,
    /// Values wrongly divided by the cosine of the incident angle. The data look symmetric wherever they do with a
    /// surplus cosine of the emergent angle, so that it is a rival hypothesis; no repair undoes it.
    IncidentTooLittle,
    /// Values wrongly multiplied by the cosine of the incident angle.
    IncidentTooMuch,
    /// Values wrongly multiplied by the projected solid angle of the emergent cell (fluxes instead of luminance
    /// coefficients).
    SolidAngle,
}

impl Factor {
    /// Whether the factor depends on the emergent angle or cell, not on the incident one.
    pub(super) const fn of_emergence(self) -> bool {
        !matches!(self, Self::IncidentTooLittle | Self::IncidentTooMuch)
    }

    /// Returns the inverse of the factor as two lists, by incident and by emergent cell; a value is multiplied by both
    /// to remove the factor.
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

/// Reading (interpretation) of the numbers of one function.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Part {
    /// Index in [`Component::ALL`] of the function whose numbers are read.
    pub(super) source: usize,
    /// Rotation or reflection of the directions, if any.
    pub(super) turn: Option<Turn>,
    /// Whether incident and emergent directions are exchanged.
    pub(super) transposed: bool,
    /// Factor that is removed from the values, if any.
    pub(super) factor: Option<Factor>,
}

impl Part {
    /// Creates the reading of a function's numbers as given.
    pub(super) const fn plain(source: usize) -> Self {
        Self { source, turn: None, transposed: false, factor: None }
    }
}

/// Readings of the four functions of a band, in the order of [`Component::ALL`]; `None` where the file has no function.
pub(super) type Reading = [Option<Part>; 4];

/// Returns the reading of all functions of a band as given.
pub(super) fn as_it_is(blocks: &Blocks) -> Reading {
    Component::ALL.map(|component| blocks.get(component).map(|_| Part::plain(component as usize)))
}

/// Returns the composition of two rotations or reflections, neither of them by 90°; `None` is the identity.
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
