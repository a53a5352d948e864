//! Uncertainty of patch-averaged luminances by diffuse light: a luminance that changes from patch to patch changes
//! within them, too, and from a sensor only a part of the patches at the edge of an aperture is visible.

use super::Emission;
use crate::compute::direction::Dir;
use glam::DVec3;

/// Deviation of half a patch from its mean, as a share of the difference between the patches on both sides. With this
/// and [`MIDDLE`] 65 of 66 sensor points behind foils with forward lobes of 4 to 15° half width are within the
/// uncertainty (`tests/scenes/sky_in_cells.rs`).
const HALVES: f64 = 0.2;
/// Deviation of a patch's middle, as a share of the difference to the mean of its neighbours.
const MIDDLE: f64 = 0.5;

impl Emission {
    /// Adds the uncertainty of the luminance by diffuse light on the emergent patches of the data, estimated from its
    /// differences to neighbouring patches along both axes of the façade frame. Beyond the last patches the luminance
    /// counts as constant.
    pub fn estimate_patch_uncertainty(&mut self) {
        let Some(light) = self.cells.first_mut() else { return };
        let value = |d: DVec3| Dir::new(d).filter(|_| d.z > 0.0).and_then(|d| light.basis.index(d));
        let mut uncertainties = [const { Vec::new() }; 3];
        for (cell, own) in light.basis.cells().zip(&light.diffuse) {
            let (v, width) = (cell.centre().vector(), cell.solid_angle().sqrt());
            let [[left, right], [below, above]] = [DVec3::X, DVec3::Y].map(|axis| {
                let step = width * (axis - v * axis.dot(v)).normalize_or_zero();
                [v - step, v + step].map(|d| value(d).map_or(*own, |k| light.diffuse[k]))
            });
            uncertainties[0].push(HALVES * (right - left));
            uncertainties[1].push(HALVES * (above - below));
            uncertainties[2].push(MIDDLE * (own - 0.25 * (left + right + below + above)));
        }
        light.uncertainties.extend(uncertainties);
    }
}
