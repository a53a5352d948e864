//! Directions relative to a structure that is endless along an axis: along x, or along y where it is upright.

use crate::compute::direction::{Dir, Facade};
use glam::DVec3;

/// Returns the direction of a profile angle `psi` with the direction cosine `along` the structure.
pub(super) fn name_of(upright: bool, along: f64, psi: f64) -> Dir<Facade> {
    let across = (1.0 - along * along).max(0.0).sqrt();
    let (sin, cos) = psi.sin_cos();
    Dir::from_unit(if upright {
        DVec3::new(across * sin, along, across * cos)
    } else {
        DVec3::new(along, across * sin, across * cos)
    })
}

/// Returns the direction cosine along the structure, and the profile angle.
pub(super) fn angles(upright: bool, name: Dir<Facade>) -> (f64, f64) {
    let v = name.vector();
    if upright { (v.y, v.x.atan2(v.z)) } else { (v.x, v.y.atan2(v.z)) }
}

/// Returns the angle along a structure and the profile angle of a direction. \[rad\]
pub fn structure_angles(upright: bool, name: Dir<Facade>) -> [f64; 2] {
    let (along, psi) = angles(upright, name);
    [along.clamp(-1.0, 1.0).asin(), psi]
}

/// Returns the direction of an angle along a structure and a profile angle. \[rad\]
pub fn direction(upright: bool, [along, psi]: [f64; 2]) -> Dir<Facade> {
    name_of(upright, along.sin(), psi)
}
