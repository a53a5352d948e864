//! Weights of light at the sensors, as a session keeps them.

use crate::compute::room::mesh::{Mesh, Wall};
use crate::compute::room::radiosity::Radiosity;
use std::ops::Range;

/// Number of sensors whose weights are computed together, by one product of matrices.
pub(super) const TOGETHER: usize = 32;

/// Response of one sensor: weights by fine patch.
pub(crate) struct Response {
    /// Interreflected light per first illuminance of each patch. \[lx per lx\]
    pub value: Vec<f64>,
    /// Differences of the two densities, wall by wall. \[lx per lx\]
    pub walls: Vec<Vec<f64>>,
}

/// Weights of the luminance of cells, sensor by sensor.
pub(crate) struct ByCells {
    pub value: Vec<Vec<f64>>,
    /// Differences of the two densities, wall by wall; empty where not requested.
    pub walls: Vec<Vec<Vec<f64>>>,
}

/// Returns the weights of the patches of each wall that a sensor sees, fine and coarse.
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
