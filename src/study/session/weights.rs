//! Responses of the sensors to light on the patches of the room and on cells, for storage in a session.

use super::bytes::of_rows;
use crate::compute::room::mesh::{Mesh, Wall};
use crate::compute::room::radiosity::Radiosity;
use half::bf16;
use std::ops::Range;

/// Number of sensors whose responses are computed together, by one matrix product.
pub(super) const TOGETHER: usize = 32;

/// Response of one sensor to light on each patch of the fine mesh.
pub(crate) struct Response {
    /// Interreflected illuminance per illuminance of each patch before interreflection. \[lx per lx\]
    pub value: Vec<f64>,
    /// Differences of these between the fine and the coarse mesh, wall by wall. Only the uncertainty depends on them, so
    /// that two digits are enough: in single precision it differed by up to 0.5 % of itself, in a year of an office
    /// with sensors 5 to 20 mm from its walls. \[lx per lx\]
    pub walls: Vec<Vec<bf16>>,
}

impl Response {
    /// Returns the memory that the weights take. \[bytes\]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.value[..]) + of_rows(&self.walls)
    }
}

/// Interreflected illuminances at the sensors per luminance of each emergent cell, sensor by sensor. \[lx per cd/m²\]
pub(crate) struct ByCells {
    pub value: Vec<Vec<f64>>,
    /// Differences of these illuminances between the fine and the coarse mesh, sensor by sensor, wall by wall; no
    /// walls where not requested. \[lx per cd/m²\]
    pub walls: Vec<Vec<Vec<bf16>>>,
}

impl ByCells {
    /// Returns the memory that the illuminances take. \[bytes\]
    pub fn bytes(&self) -> usize {
        of_rows(&self.value) + self.walls.iter().map(|walls| of_rows(walls)).sum::<usize>()
    }
}

/// Returns the weights with which a sensor sees the patches of each wall, in the fine and the coarse mesh.
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
