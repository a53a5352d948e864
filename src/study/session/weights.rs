//! Weights that a session keeps.

use crate::compute::room::mesh::{Mesh, Wall};
use crate::compute::room::radiosity::Radiosity;
use std::ops::Range;

/// Sensors whose weights are found at once, by one product of matrices.
pub(super) const TOGETHER: usize = 32;

/// Weights of one sensor, by fine patch.
pub(crate) struct Response {
    /// Of all first illuminance. \[lx per lx\]
    pub value: Vec<f64>,
    /// The difference of the two densities, wall by wall.
    pub walls: Vec<Vec<f64>>,
}

/// Sensor by sensor weights of the luminance of cells.
pub(crate) struct ByCells {
    pub value: Vec<Vec<f64>>,
    /// Wall by wall; empty where not asked for.
    pub walls: Vec<Vec<Vec<f64>>>,
}

/// The weights of the walls that a sensor sees, one by one.
pub(super) fn by_walls(radiosity: &Radiosity, fine: &[f64], coarse: &[f64]) -> Vec<[Vec<f64>; 2]> {
    let only = |weights: &[f64], range: Range<usize>| -> Vec<f64> {
        let mut own = vec![0.0; weights.len()];
        own[range.clone()].copy_from_slice(&weights[range]);
        own
    };
    let spans = |mesh: &Mesh| -> Vec<Range<usize>> { mesh.walls.iter().map(Wall::patches).collect() };
    spans(&radiosity.nested.fine)
        .into_iter()
        .zip(spans(&radiosity.nested.coarse))
        .filter(|(a, b)| fine[a.clone()].iter().chain(&coarse[b.clone()]).any(|w| *w != 0.0))
        .map(|(a, b)| [only(fine, a), only(coarse, b)])
        .collect()
}
