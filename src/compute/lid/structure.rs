//! Directions relative to a structure that is endless along an axis of the façade frame: along x (horizontal slats), or
//! along y (upright).

use crate::compute::direction::{Dir, Facade};
use glam::DVec3;

/// Returns the direction (façade frame, z ≥ 0) with the profile angle `psi` \[rad\] and the direction cosine `along`
/// the structure.
pub(super) fn direction_of(upright: bool, along: f64, psi: f64) -> Dir<Facade> {
    let across = (1.0 - along * along).max(0.0).sqrt();
    let (sin, cos) = psi.sin_cos();
    Dir::from_unit(if upright {
        DVec3::new(across * sin, along, across * cos)
    } else {
        DVec3::new(along, across * sin, across * cos)
    })
}

/// Returns the direction cosine along the structure and the profile angle \[rad\] of a direction of the façade frame.
pub(super) fn angles(upright: bool, direction: Dir<Facade>) -> (f64, f64) {
    let v = direction.vector();
    if upright { (v.y, v.x.atan2(v.z)) } else { (v.x, v.y.atan2(v.z)) }
}

/// Returns the angle along a structure (−π/2 … π/2, 0 perpendicular to it) and the profile angle of a direction of the
/// façade frame. \[rad\] `upright`: whether the structure runs along y instead of x.
pub fn structure_angles(upright: bool, direction: Dir<Facade>) -> [f64; 2] {
    let (along, psi) = angles(upright, direction);
    [along.clamp(-1.0, 1.0).asin(), psi]
}

/// Returns the direction of the façade frame with an angle along a structure and a profile angle \[rad\]; the inverse
/// of [`structure_angles`]. `upright`: whether the structure runs along y instead of x.
pub fn direction(upright: bool, [along, psi]: [f64; 2]) -> Dir<Facade> {
    direction_of(upright, along.sin(), psi)
}
