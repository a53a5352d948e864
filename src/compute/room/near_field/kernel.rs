//! What a point of the aperture counts for at a sensor.

use crate::compute::room::aperture::View;
use glam::DVec3;

/// cosθ_F max(0, n·ω)/r² of a point of the aperture, given as the vector towards it. \[1/m²\]
pub(super) fn kernel(view: &View, to: DVec3) -> f64 {
    let square = to.length_squared();
    view.distance * view.normal.dot(to).max(0.0) / (square * square)
}
