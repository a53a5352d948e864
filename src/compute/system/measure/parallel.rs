//! What parallel light of one very direction becomes: beams, kept apart and exact, and scattered light on cells.

use crate::compute::direction::{Dir, Facade};

/// One of the beams that parallel light becomes. Names of directions are those of [`super`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beam {
    /// Where it goes: from and to. Alike for a parallel beam; the fan of a curved mirror lies evenly between them.
    pub names: [Dir<Facade>; 2],
    /// Share of the incident flux.
    pub share: f64,
    /// Transmitted, or thrown back.
    pub transmitted: bool,
}

impl Beam {
    /// A parallel beam that is transmitted.
    pub const fn through(name: Dir<Facade>, share: f64) -> Self {
        Self { names: [name, name], share, transmitted: true }
    }

    /// A parallel beam that is thrown back.
    pub const fn back(name: Dir<Facade>, share: f64) -> Self {
        Self { names: [name, name], share, transmitted: false }
    }
}

/// What of parallel light is no beam.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScatteredLight {
    /// q of transmitted light by emergent cell, a mean over each. \[1/sr\] Empty: none.
    pub transmitted: Vec<f64>,
    /// q of light thrown back, the same. \[1/sr\] Empty: none.
    pub reflected: Vec<f64>,
    /// Estimated absolute error of the shares that are transmitted and thrown back so, the larger one.
    pub error: f64,
}
