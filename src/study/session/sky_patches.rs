//! Patches of the outside in front of an aperture, and values that depend on nothing else, computed once for all
//! systems and states.

use super::far::{self, Constants};
use crate::compute::basis::RingBasis;
use crate::compute::sky::{Frame, Outside, SkySamples, incident_illuminances_within};
use crate::study::scene::Scene;

/// Relative accuracy of the illuminances by ground and skyline, which do not depend on the sky.
const RELATIVE: f64 = 1e-7;

/// Patches of the outside in front of an aperture, with the directions in which skies are evaluated and the constant
/// illuminances through them.
pub(crate) struct SkyPatches {
    /// Basis of the incident hemisphere.
    pub patches: RingBasis,
    /// Orientation of the hemisphere in the world frame.
    pub frame: Frame,
    /// Directions in which skies are evaluated, in the patches that reach above horizon and skyline.
    pub samples: SkySamples,
    /// Hash that identifies these directions.
    pub fingerprint: u64,
    /// Illuminance of the aperture through every patch by a ground of luminance 1. \[lx per cd/m²\]
    pub ground: Vec<f64>,
    /// Illuminance of the aperture through every patch by a skyline of luminance 1. \[lx per cd/m²\]
    pub skyline: Vec<f64>,
}

impl SkyPatches {
    /// Returns the memory that directions and illuminances take. \[bytes\]
    pub fn bytes(&self) -> usize {
        self.samples.len() * size_of::<[f64; 4]>() + size_of_val(&self.ground[..]) + size_of_val(&self.skyline[..])
    }

    /// Creates the patches in front of an aperture of a scene. `patches`: basis of the incident hemisphere; `spacing`:
    /// maximum distance between the directions \[rad\].
    pub fn new(scene: &Scene, index: usize, patches: RingBasis, spacing: f64) -> Self {
        let frame = Frame::of_aperture(scene.orientation, scene.facing(index).surface);
        let mut samples = SkySamples::new(&patches, &frame, scene.outside.skyline_altitude(), spacing);
        let constants = Constants::of(&scene.outside);
        if let (Some(even), Some(skyline)) = (&constants.even, far::shape(&scene.outside)) {
            let open = illuminances(even, &patches, &frame, RELATIVE);
            let open: Vec<f64> = samples.cells().iter().map(|&cell| open[cell]).collect();
            samples.without(|d| skyline.covers(d), &open);
        }
        let [ground, skyline] = [&constants.ground, &constants.skyline].map(|outside| {
            outside.as_ref().map_or_else(|| vec![0.0; patches.len()], |o| illuminances(o, &patches, &frame, RELATIVE))
        });
        Self { fingerprint: samples.fingerprint(), patches, frame, samples, ground, skyline }
    }
}

/// Returns the illuminance of an aperture through every patch, by integration with the relative accuracy `relative`.
/// \[lx\]
pub(crate) fn illuminances(outside: &Outside, basis: &RingBasis, frame: &Frame, relative: f64) -> Vec<f64> {
    incident_illuminances_within(outside, basis, frame, relative).into_iter().map(|e| e.value).collect()
}
