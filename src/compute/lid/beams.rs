//! Sunlight that leaves the room side of an aperture as beams: as sharp as the sun's disc.

use super::Facing;
use crate::compute::btdf::AngularTransmittance;
use crate::compute::direction::{Dir, Facade};
use std::f64::consts::PI;

/// One beam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamLight {
    /// Where it goes, by through-name.
    pub to: Dir<Facade>,
    /// Flux that leaves the aperture with it, per area. \[lm/m²\]
    pub exitance: f64,
    /// Illuminance that it gives across itself where nothing hides any part of its disc. \[lx\]
    pub normal: f64,
    /// Straight on: what hides a part of the sun hides the same part of it.
    pub straight: bool,
    /// Error of its strength, a share of it.
    pub error: f64,
    /// What is not known of its strength, a share of it: how far the data tell apart neighbouring suns.
    pub doubt: f64,
}

impl BeamLight {
    /// The same with its light times a factor.
    pub fn scaled(self, factor: f64) -> Self {
        Self { exitance: factor * self.exitance, normal: factor * self.normal, ..self }
    }

    /// Where it goes as a whole: straight on by the middle of what is seen of the sun. `None` where that is not through
    /// the aperture.
    pub fn entering(&self, facing: &Facing<'_>) -> Option<Dir<Facade>> {
        let to = if self.straight { facing.unhidden(self.to)? } else { self.to };
        (to.vector().z > 0.0).then_some(to)
    }

    /// What a regular transmittance makes of the sun; `None` without sun.
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
            doubt: if tau > 0.0 { uncertainty / tau } else { 0.0 },
        };
        (beam.exitance > 0.0).then_some(beam)
    }
}
