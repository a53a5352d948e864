//! Luminances of an aperture's patches towards the eye.

use super::field::{Field, Patch};
use crate::compute::btdf::AngularTransmittance;
use crate::compute::direction::Emergent;
use crate::compute::lid::{Emission, Facing};
use std::f64::consts::FRAC_PI_2;

/// Adds the scattered light of an aperture, that of luminaires in its place too, to the luminances of all patches;
/// `aperture` is its number in the field. Regular transmission is left out.
pub fn add_emitted(field: &Field, aperture: usize, emission: &Emission, facing: &Facing<'_>, luminance: &mut [f64]) {
    let range = field.of[aperture].clone();
    if range.is_empty() {
        return;
    }
    let scattered = Emission { regular: None, beams: Vec::new(), notes: Vec::new(), ..emission.clone() };
    // A luminance does not depend on the size of the aperture.
    let lid = scattered.lid(facing, [1.0; 2]);
    for (sum, patch) in luminance[range.clone()].iter_mut().zip(&field.patches[range]) {
        *sum += lid.luminance(Emergent::from_through_name(patch.through));
    }
}

/// Adds the outside that is visible through a regular transmittance. `facing` has the outside as seen from the eye.
pub fn add_seen_through(
    field: &Field,
    aperture: usize,
    tau: &AngularTransmittance,
    facing: &Facing<'_>,
    luminance: &mut [f64],
) {
    let range = field.of[aperture].clone();
    let seen = |patch: &Patch| tau.at(patch.through.theta().min(FRAC_PI_2)) * facing.luminance(patch.through);
    for (sum, patch) in luminance[range.clone()].iter_mut().zip(&field.patches[range]) {
        *sum += seen(patch);
    }
}
