//! Luminances of an aperture's patches towards the eye.

use super::field::{Field, Patch};
use crate::compute::btdf::AngularTransmittance;
use crate::compute::direction::Emergent;
use crate::compute::lid::{Emission, Facing};
use std::f64::consts::FRAC_PI_2;

/// Adds the luminance of an aperture's scattered light towards the eye to that of its patches. \[cd/m²\] `aperture` is
/// its index in `field`, `emission` its light (also that of luminaires that replace it), `luminance` has one entry per
/// patch of the field. Regular transmission is left out.
pub fn add_emitted(field: &Field, aperture: usize, emission: &Emission, facing: &Facing<'_>, luminance: &mut [f64]) {
    let range = field.of[aperture].clone();
    if range.is_empty() {
        return;
    }
    let scattered = Emission { regular: None, beams: Vec::new(), notes: Vec::new(), ..emission.clone() };
    // A luminance does not depend on the size of the aperture.
    let lid = scattered.lid(facing, [1.0; 2]);
    for (sum, patch) in luminance[range.clone()].iter_mut().zip(&field.patches[range]) {
        *sum += lid.luminance(Emergent::from_undeviated(patch.through));
    }
}

/// Adds the luminance of the outside that the eye sees through the regular transmittance `tau` of an aperture to that
/// of its patches. \[cd/m²\] `aperture` is its index in `field`, `facing` has the outside as seen from the eye,
/// `luminance` has one entry per patch of the field.
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
