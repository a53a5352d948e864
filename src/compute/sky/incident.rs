//! Illuminance of an aperture from each cell of a basis of its outer hemisphere: sky, ground and obstructions as a
//! vector over the basis.

use super::integral::integrate_region;
use super::on_dome;
use super::outside::{Before, Outside};
use super::prospect::{Parts, Prospect};
use super::region::{Frame, Region, Weight};
use crate::compute::basis::RingBasis;
use crate::compute::estimate::Estimate;
use crate::compute::quadrature::Tolerance;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Relative accuracy of the illuminance from every cell. Held by
/// `tests/compute/sky.rs::incident_cells_sum_to_the_facade`, to 4e-6.
const RELATIVE: f64 = 1e-6;

/// Computes the illuminances E_i = ∫_cell L cosθ dω of an aperture from every cell of `basis` by sky, ground and
/// obstructions, without direct sun. \[lx\] `frame`: axes of the aperture's plane. The result has the order of the
/// cells.
///
/// Cells are computed independently: the result does not depend on the number of threads.
pub fn incident_illuminances(outside: &Outside, basis: &RingBasis, frame: &Frame) -> Vec<Estimate> {
    incident_illuminances_within(outside, basis, frame, RELATIVE)
}

/// Computes the illuminances of an aperture from every cell of `basis`, like [`incident_illuminances`], to the relative
/// accuracy `relative`. \[lx\]
pub fn incident_illuminances_within(
    outside: &Outside,
    basis: &RingBasis,
    frame: &Frame,
    relative: f64,
) -> Vec<Estimate> {
    if let Some(before) = &outside.before {
        return past(outside, before, basis, frame, relative);
    }
    (0..basis.len())
        .into_par_iter()
        .map(|index| {
            let cell = basis.cell(index);
            let share = cell.projected_solid_angle() / PI;
            // Cells wider than a quarter turn are divided, because the quadrature rules are made for smooth pieces.
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

/// Computes the illuminances from the cells with surroundings: those by the unobstructed sky and ground, changed where
/// the surroundings hide them.
fn past(outside: &Outside, before: &Before, basis: &RingBasis, frame: &Frame, relative: f64) -> Vec<Estimate> {
    let open = outside.open();
    let compute = || incident_illuminances_within(&open, basis, frame, relative);
    let free = before.kept.get(basis, frame, relative, compute);
    let prospect = Prospect::new(&open, &before.surroundings, before.eye);
    let whole: f64 = free.iter().map(|e| e.value).sum();
    (0..basis.len())
        .into_par_iter()
        .with_min_len(16)
        .map(|index| {
            let cell = basis.cell(index);
            let free = free[index];
            // Cells wider than a quarter turn are divided, like without surroundings.
            let pieces = (cell.width / (0.5 * PI)).ceil().max(1.0);
            let step = cell.width / pieces;
            let share = whole * cell.projected_solid_angle() / PI;
            let (mut sum, mut error, mut met) = (Parts::default(), 0.0, false);
            let mut untouched = 0.0;
            let piece = |piece: usize| {
                let from = cell.phi - 0.5 * cell.width + piece as f64 * step;
                let region =
                    Region { frame: *frame, theta: (cell.theta_min, cell.theta_max), phi: (from, from + step) };
                on_dome::over(&prospect, &region, Weight::Projected, PAST, PAST * share / pieces)
            };
            let found = if basis.len() == 1 {
                on_dome::over_hemisphere(&prospect, frame, PAST_ALL, PAST_ALL * share)
            } else {
                (0..pieces as usize).map(piece).collect()
            };
            for part in found {
                match part {
                    Some((parts, off)) => {
                        met = true;
                        sum.before += parts.before;
                        sum.uncertainty += parts.uncertainty;
                        sum.behind += parts.behind;
                        sum.open += parts.open;
                        error += off;
                    }
                    None => untouched += 1.0,
                }
            }
            if !met {
                return free;
            }
            // Hidden and open illuminance by the same points: their ratio is exact for a fully hidden cell; where
            // little is hidden, their difference is more accurate.
            let left = if untouched == 0.0 && sum.behind > 0.5 * sum.open {
                free.value * (1.0 - sum.behind / sum.open).max(0.0)
            } else {
                (free.value - sum.behind).max(0.0)
            };
            Estimate::new(left + sum.before, free.error + error + sum.uncertainty)
        })
        .collect()
}

/// Relative accuracy of the change of an illuminance by the surroundings. Chosen: a twentieth of the default error
/// target; held by the test `narrow_and_steep_skylines_give_what_they_hold` of `on_dome`, to 1e-3.
const PAST: f64 = 5e-4;
/// Relative accuracy of the change that obstructions make to the illuminance from the whole hemisphere, which is one
/// sweep: its error is then small compared with that by the division of the aperture. Chosen: a hundredth of the
/// default error target.
const PAST_ALL: f64 = 1e-4;
