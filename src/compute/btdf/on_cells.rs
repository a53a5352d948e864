//! Conversion of any BTDF or BRDF to patch-averaged data on given bases, for file formats with fixed cells.

use super::resample::resample_matrix;
use super::{Btdf, CellMatrix, Scattered, TensorTree};
use crate::compute::basis::{Resampling, RingBasis, SquareGrid};
use crate::compute::quadrature::midpoints;
use std::f64::consts::PI;

/// Converts a BTDF or BRDF to patch-averaged data: means of q over the cells of `incident` and `emergent`, with the
/// flux conserved. Regular transmission is spread over the emergent cells that its incident cell covers. Single
/// incident directions represent the cells around them.
pub fn matrix_on(btdf: &Btdf, incident: &RingBasis, emergent: &RingBasis) -> CellMatrix {
    sampled_on(btdf, incident, emergent, 1024)
}

/// Converts a BTDF or BRDF to patch-averaged data like [`matrix_on`], with tensor trees sampled at a sixteenth of the
/// directions: for comparisons, not for files.
pub fn matrix_roughly_on(btdf: &Btdf, incident: &RingBasis, emergent: &RingBasis) -> CellMatrix {
    sampled_on(btdf, incident, emergent, 256)
}

/// Converts a BTDF or BRDF to patch-averaged data. `side`: number of sampled directions along each side of the square
/// of a tensor tree.
fn sampled_on(btdf: &Btdf, incident: &RingBasis, emergent: &RingBasis, side: usize) -> CellMatrix {
    let n = emergent.len();
    let across = midpoints(ACROSS);
    let mut values = match &btdf.scattered {
        None => vec![0.0; incident.len() * n],
        Some(Scattered::Cells(matrix)) => resample_matrix(matrix, incident, emergent).values().to_vec(),
        Some(Scattered::Directions(data)) => resample_matrix(&data.to_cells(), incident, emergent).values().to_vec(),
        Some(Scattered::Lambert(tau)) => incident
            .cells()
            .flat_map(|cell| std::iter::repeat_n(tau.ring_mean(cell.theta_min, cell.theta_max, &across) / PI, n))
            .collect(),
        Some(Scattered::Tree(tree)) => tree_on(tree, incident, emergent, side),
    };
    if let Some(tau) = &btdf.regular {
        let mean: Vec<f64> = incident
            .cells()
            .map(|cell| tau.ring_mean(cell.theta_min, cell.theta_max, &across) / cell.projected_solid_angle())
            .collect();
        if incident == emergent {
            (0..n).for_each(|k| values[k * n + k] += mean[k]);
        } else {
            let overlaps = Resampling::new(incident, emergent);
            for o in 0..n {
                for &(i, share) in overlaps.shares(o) {
                    values[i * n + o] += share * mean[i];
                }
            }
        }
    }
    CellMatrix::new(incident.clone(), emergent.clone(), values).expect("a row was made for every incident cell")
}

/// Number of angles across a ring over which τ is averaged. Midpoints err by 1/(24 · 512²) ≈ 2e-7 of a smooth
/// function's curvature over the ring.
const ACROSS: usize = 512;

/// Computes the mean emergent distribution of a tensor tree for uniform luminance of each incident cell. The shares of
/// tree cells in ring cells are counted on `side`² directions of equal weight; every distribution is then scaled to its
/// exact flux.
fn tree_on(tree: &TensorTree, incident: &RingBasis, emergent: &RingBasis, side: usize) -> Vec<f64> {
    let grid = tree.incident_grid();
    let inward = grid_shares(grid, incident, side);
    let outward = if incident == emergent { inward.clone() } else { grid_shares(grid, emergent, side) };
    let weights = emergent.projected_solid_angles();
    let from_rings = Resampling::new(&grid.rings(), emergent);
    let tau = tree.tau_by_cell();
    let mut values = Vec::with_capacity(incident.len() * emergent.len());
    for cells in &inward {
        let mut illuminance = vec![0.0; grid.len()];
        for &(cell, share) in cells {
            illuminance[cell] = share;
        }
        let mut row: Vec<f64> = match tree.luminance_on_grid(&illuminance) {
            Some(luminance) => {
                outward.iter().map(|cell| cell.iter().map(|&(k, share)| share * luminance[k]).sum()).collect()
            }
            None => from_rings.apply(&tree.luminance(&illuminance).1),
        };
        let flux: f64 = cells.iter().map(|&(cell, share)| share * tau[cell]).sum();
        let got: f64 = row.iter().zip(&weights).map(|(q, w)| q * w).sum();
        if got > 0.0 {
            row.iter_mut().for_each(|q| *q *= flux / got);
        }
        values.extend(row);
    }
    values
}

/// Returns for every cell of the basis the grid cells that cover it, with their shares of the cell (sum 1).
fn grid_shares(grid: SquareGrid, basis: &RingBasis, side: usize) -> Vec<Vec<(usize, f64)>> {
    let per_side = (side / grid.resolution()).max(1);
    let mut counts: Vec<Vec<(usize, f64)>> = vec![Vec::new(); basis.len()];
    for (k, cell) in grid.cells().enumerate() {
        for direction in cell.samples(per_side) {
            let Some(place) = basis.index(direction) else { continue };
            match counts[place].last_mut() {
                Some(last) if last.0 == k => last.1 += 1.0,
                _ => counts[place].push((k, 1.0)),
            }
        }
    }
    for (place, list) in counts.iter_mut().enumerate() {
        if list.is_empty() {
            // A cell finer than the samples is represented by its centre.
            list.extend(grid.index(basis.cell(place).centre()).map(|k| (k, 1.0)));
        }
        let total: f64 = list.iter().map(|entry| entry.1).sum();
        list.iter_mut().for_each(|entry| entry.1 /= total);
    }
    counts
}
