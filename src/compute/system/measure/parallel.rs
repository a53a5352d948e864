//! Parallel light of one exact direction after a system: sharp beams, and scattered light on cells.

use crate::compute::direction::{Dir, Facade};

/// Beam or fan that parallel light becomes in a system. Its directions are directions of undeviated light, see
/// [`super`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beam {
    /// Directions of undeviated light of both ends: equal for a parallel beam; the fan of a curved mirror is uniformly
    /// distributed between them.
    pub directions: [Dir<Facade>; 2],
    /// Share of the incident flux that the beam carries.
    pub share: f64,
    /// Whether the beam is transmitted; otherwise it is reflected.
    pub transmitted: bool,
}

impl Beam {
    /// Creates a transmitted parallel beam with the direction of undeviated light `direction`, which carries `share` of
    /// the incident flux.
    pub const fn through(direction: Dir<Facade>, share: f64) -> Self {
        Self { directions: [direction, direction], share, transmitted: true }
    }

    /// Creates a reflected parallel beam with the direction of undeviated light `direction`, which carries `share` of
    /// the incident flux.
    pub const fn back(direction: Dir<Facade>, share: f64) -> Self {
        Self { directions: [direction, direction], share, transmitted: false }
    }
}

/// Scattered part of the light that parallel light becomes in a system: all that is not in beams.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScatteredLight {
    /// Luminance coefficient q of transmitted light, as a mean over each emergent cell; empty if there is none.
    /// \[1/sr\]
    pub transmitted: Vec<f64>,
    /// Luminance coefficient q of reflected light, as a mean over each emergent cell; empty if there is none. \[1/sr\]
    pub reflected: Vec<f64>,
    /// Estimated absolute error of the scattered part of τ or of ρ, the larger one.
    pub error: f64,
}
