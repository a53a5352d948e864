//! Sunlight that leaves the room side of an aperture as beams that are only as wide as the sun's disc.

use super::Facing;
use crate::compute::btdf::AngularTransmittance;
use crate::compute::direction::{Dir, Facade};
use std::f64::consts::PI;

/// Beam of sunlight that leaves the room side of an aperture without scattering, per area of the aperture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamLight {
    /// Direction of undeviated light for the beam: its emergent direction reversed (unit vector with z > 0, façade
    /// frame). For an undeviated beam it points towards the sun.
    pub to: Dir<Facade>,
    /// Flux that leaves the aperture with the beam, per area. \[lm/m²\]
    pub exitance: f64,
    /// Illuminance on a plane perpendicular to the beam at a point from which the whole disc of the beam is visible
    /// through the aperture. \[lx\]
    pub normal: f64,
    /// Whether the beam is undeviated, so that an obstruction that hides a part of the sun hides the same part of the
    /// beam.
    pub straight: bool,
    /// Estimated relative numerical error of the beam's flux.
    pub error: f64,
    /// Relative uncertainty of the beam's flux, because the data do not resolve neighbouring positions of the sun.
    pub uncertainty: f64,
}

impl BeamLight {
    /// Returns the beam with its exitance and illuminance multiplied by `factor`.
    pub fn scaled(self, factor: f64) -> Self {
        Self { exitance: factor * self.exitance, normal: factor * self.normal, ..self }
    }

    /// Returns the direction of the whole beam as a direction of undeviated light (reversed emergent direction, façade
    /// frame); for an undeviated beam it is that to the middle of the visible part of the sun. `None` if that direction
    /// does not lead through the aperture.
    pub fn entering(&self, facing: &Facing<'_>) -> Option<Dir<Facade>> {
        let to = if self.straight { facing.unhidden(self.to)? } else { self.to };
        (to.vector().z > 0.0).then_some(to)
    }

    /// Computes the undeviated beam of the sun behind a system with the regular transmittance `tau`; `None` if no
    /// sunlight is transmitted.
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
