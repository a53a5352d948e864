//! Directions that represent a cell of a ring basis.

use super::rings::Cell;
use crate::compute::direction::{Dir, Facade};

/// Returns `n` × `n` directions of the façade frame, each of which represents the same share of a cell's projected
/// solid angle (midpoints in sin²θ and φ).
pub fn sub_directions(cell: &Cell, n: usize) -> impl Iterator<Item = Dir<Facade>> {
    let (low, high) = (cell.theta_min.sin().powi(2), cell.theta_max.sin().powi(2));
    let (phi, width) = (cell.phi, cell.width);
    (0..n * n).map(move |k| {
        let (row, column) = ((k / n) as f64 + 0.5, (k % n) as f64 + 0.5);
        let sin2 = low + (high - low) * row / n as f64;
        Dir::from_theta_phi(sin2.sqrt().asin(), phi + width * (column / n as f64 - 0.5))
    })
}

/// Computes the mean of a function over a cell, weighted by projected solid angle, from `n` × `n` directions.
pub fn cell_mean(cell: &Cell, n: usize, f: impl Fn(Dir<Facade>) -> f64) -> f64 {
    sub_directions(cell, n).map(f).sum::<f64>() / (n * n) as f64
}
