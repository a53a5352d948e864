//! How far the width of cells leaves open what sky, ground and skyline make: a luminance that changes from cell to cell
//! changes within them, too, and a sensor sees no more than a part of those at an aperture's edge.

use super::Emission;
use crate::compute::direction::Dir;
use glam::DVec3;

/// Of the change of luminance from the cell before to the cell behind, what both halves of a cell may differ by from
/// its mean; and of what it stands out of those about it, what its middle may. On foils whose lobes are 4 to 15° wide to
/// half their height more than 98 % of sensors are held with these.
const HALVES: f64 = 0.2;
const MIDDLE: f64 = 0.5;

impl Emission {
    /// Doubts the diffuse light on the data's cells by its change along both axes of the façade frame. Towards the aperture's
    /// own plane it goes on as it is.
    pub fn doubt_widths(&mut self) {
        let Some(light) = self.cells.first_mut() else { return };
        let value = |d: DVec3| Dir::new(d).filter(|_| d.z > 0.0).and_then(|d| light.basis.index(d));
        let mut doubts = [const { Vec::new() }; 3];
        for (cell, own) in light.basis.cells().zip(&light.diffuse) {
            let (v, width) = (cell.centre().vector(), cell.solid_angle().sqrt());
            let [[left, right], [below, above]] = [DVec3::X, DVec3::Y].map(|axis| {
                let step = width * (axis - v * axis.dot(v)).normalize_or_zero();
                [v - step, v + step].map(|d| value(d).map_or(*own, |k| light.diffuse[k]))
            });
            doubts[0].push(HALVES * (right - left));
            doubts[1].push(HALVES * (above - below));
            doubts[2].push(MIDDLE * (own - 0.25 * (left + right + below + above)));
        }
        light.doubts.extend(doubts);
    }
}
