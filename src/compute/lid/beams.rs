//! Sunlight that leaves the room side of an aperture as beams: as sharp as the sun's disc.

use super::Facing;
use crate::compute::btdf::AngularTransmittance;
use crate::compute::direction::{Dir, Facade};
use std::f64::consts::PI;

/// One beam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamLight {
    /// Through direction of the beam.
    pub to: Dir<Facade>,
    /// Flux that leaves the aperture with the beam, per area. \[lm/m²\]
    pub exitance: f64,
    /// Illuminance on a plane perpendicular to the beam where nothing hides any part of its disc. \[lx\]
    pub normal: f64,
    /// Whether the beam is undeviated: what hides a part of the sun hides the same part of the beam.
    pub straight: bool,
    /// Estimated relative error of the beam's strength.
    pub error: f64,
    /// Relative uncertainty of the beam's strength, because the data do not resolve neighbouring sun positions.
    pub uncertainty: f64,
}

impl BeamLight {
    /// Returns the beam with its light multiplied by `factor`.
    pub fn scaled(self, factor: f64) -> Self {
        Self { exitance: factor * self.exitance, normal: factor * self.normal, ..self }
    }

    /// Returns the through direction of the beam as a whole; an undeviated beam goes by the middle of the visible part
    /// of the sun. `None` where that direction does not lead through the aperture.
    pub fn entering(&self, facing: &Facing<'_>) -> Option<Dir<Facade>> {
        let to = if self.straight { facing.unhidden(self.to)? } else { self.to };
        (to.vector().z > 0.0).then_some(to)
    }

    /// Computes the sun's beam through a regular transmittance; `None` without sun.
    pub fn regular(tau: Option<&AngularTransmittance>, facing: &Facing<'_>) -> Option<Self> {
        let incident = facing.sun_illuminance();
        let (sun, to) = (facing.sun?, facing.sun_direction()?);
        let theta = to.theta().min(0.5 * PI);
        let (tau, uncertainty) = (tau?.at(theta), tau?.uncertainty(theta));
        let beam = Self {
            to,
            exitance: tau * incident,
            normal: tau * sun.direct_normal,
            straight: true,
            error: 0.0,
            uncertainty: if tau > 0.0 { uncertainty / tau } else { 0.0 },
        };
        (beam.exitance > 0.0).then_some(beam)
    }
}
