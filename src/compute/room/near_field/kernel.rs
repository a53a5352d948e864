//! Kernel of eq 17: illuminance of a sensor per luminance and area of a point of the aperture.

use crate::compute::room::aperture::View;
use glam::DVec3;

/// Returns cosθ_F max(0, n·ω)/r² for a point of the aperture, given by the vector `to` from the sensor to it, façade
/// frame \[m\]; θ_F is the angle to the aperture's normal, n the sensor's normal. \[1/m²\]
pub(super) fn kernel(view: &View, to: DVec3) -> f64 {
    let square = to.length_squared();
    view.distance * view.normal.dot(to).max(0.0) / (square * square)
}
