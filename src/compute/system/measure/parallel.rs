//! Parallel light of one exact direction after a system: sharp beams, and scattered light on cells.

use crate::compute::direction::{Dir, Facade};

/// Beam that parallel light becomes. Directions are through directions, see [`super`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beam {
    /// Through directions of both ends: equal for a parallel beam; the fan of a curved mirror is uniform between them.
    pub names: [Dir<Facade>; 2],
    /// Share of the incident flux.
    pub share: f64,
    /// Whether the beam is transmitted; otherwise it is reflected.
    pub transmitted: bool,
}

impl Beam {
    /// Creates a parallel beam that is transmitted.
    pub const fn through(name: Dir<Facade>, share: f64) -> Self {
        Self { names: [name, name], share, transmitted: true }
    }

    /// Creates a parallel beam that is reflected.
    pub const fn back(name: Dir<Facade>, share: f64) -> Self {
        Self { names: [name, name], share, transmitted: false }
    }
}

/// Scattered part of parallel light, all that is not in beams.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScatteredLight {
    /// q of transmitted light by emergent cell, a mean over each; empty if there is none. \[1/sr\]
    pub transmitted: Vec<f64>,
    /// q of reflected light by emergent cell, a mean over each; empty if there is none. \[1/sr\]
    pub reflected: Vec<f64>,
    /// Estimated absolute error of the scattered shares transmitted and reflected, the larger one.
    pub error: f64,
}
