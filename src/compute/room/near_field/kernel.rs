//! Kernel of the near-field integral: illuminance at a sensor per luminance and area of a point of the aperture.

use crate::compute::room::aperture::View;
use glam::DVec3;

/// Returns cosθ_F max(0, n·ω)/r² for a point of the aperture, given as the vector from the sensor to it. \[1/m²\]
pub(super) fn kernel(view: &View, to: DVec3) -> f64 {
    let square = to.length_squared();
    view.distance * view.normal.dot(to).max(0.0) / (square * square)
}
