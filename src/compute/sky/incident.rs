//! Illuminance of an aperture from each cell of a division of its hemisphere: the outside as a vector over a basis.

use super::integral::integrate_region;
use super::outside::Outside;
use super::region::{Frame, Region, Weight};
use crate::compute::basis::RingBasis;
use crate::compute::estimate::Estimate;
use crate::compute::quadrature::Tolerance;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Relative accuracy asked of every cell.
const RELATIVE: f64 = 1e-6;

/// E_i = ∫_cell L cosθ dω for every cell of `basis`, in its order. \[lx\] Without the beam.
///
/// Every cell is computed by itself: the result does not depend on the number of threads.
pub fn incident_illuminances(outside: &Outside, basis: &RingBasis, frame: &Frame) -> Vec<Estimate> {
    incident_illuminances_within(outside, basis, frame, RELATIVE)
}

/// [`incident_illuminances`] to a relative accuracy of one's own.
pub fn incident_illuminances_within(
    outside: &Outside,
    basis: &RingBasis,
    frame: &Frame,
    relative: f64,
) -> Vec<Estimate> {
    (0..basis.len())
        .into_par_iter()
        .map(|index| {
            let cell = basis.cell(index);
            let share = cell.projected_solid_angle() / PI;
            // Cells wider than a quarter are cut: the rules are made for smooth pieces.
            let pieces = (cell.width / (0.5 * PI)).ceil().max(1.0);
            let step = cell.width / pieces;
            let tolerance = Tolerance {
                relative,
                ..Tolerance::absolute(0.1 * relative * outside.diffuse_horizontal * share / pieces)
            };
            (0..pieces as usize)
                .map(|piece| {
                    let from = cell.phi - 0.5 * cell.width + piece as f64 * step;
                    let theta = (cell.theta_min, cell.theta_max);
                    let region = Region { frame: *frame, theta, phi: (from, from + step) };
                    integrate_region(outside, &region, Weight::Projected, tolerance)
                })
                .sum()
        })
        .collect()
}
