//! Conversion of any BTDF or BRDF to a tensor tree for file formats with trees, and the error of pruning.
//!
//! The function is averaged over a full grid of 2^level steps per coordinate, each incident cell scaled to its exact
//! flux; then boxes whose values hardly differ are replaced by one leaf with their mean. The criterion is the mean
//! absolute deviation inside the box; its threshold is found by bisection such that all merging together changes the
//! direction of no more than the stated share of the flux. (Radiance's `rttree_reduce` asks for a percentile of boxes
//! instead, which bounds the size of the file rather than its error.) The criterion is the same for both squares, so
//! that reciprocal data remain reciprocal.

use super::tensor_tree::{TensorTree, TreeAxes, TreeNode, TreeRank};
use super::{Btdf, Scattered};
use crate::compute::basis::{RingBasis, SquareGrid};
use crate::compute::direction::{Emergent, Incident};
use rayon::prelude::*;
use std::f64::consts::PI;

mod codes;
mod prune;
mod shape;
mod turning;

use codes::{Codes, matrix_of, spread_leaves, to_flux};
pub use shape::{OnTree, OnTreeError, TreeShape};

impl TensorTree {
    /// Returns the same function with its squares in the axes `axes`, exactly: front and back axes differ by a rotation
    /// of 180°, which does not change the relative azimuths of rank 3.
    pub fn with_axes(&self, axes: TreeAxes) -> Self {
        if axes == self.axes() {
            return self.clone();
        }
        let nodes = match self.rank() {
            TreeRank::Three => self.nodes().to_vec(),
            TreeRank::Four => {
                let mut nodes = self.nodes().to_vec();
                for node in self.nodes() {
                    if let TreeNode::Branch(first) = *node {
                        // Upper halves become lower ones in all four coordinates.
                        nodes[first as usize..first as usize + 16].reverse();
                    }
                }
                nodes
            }
        };
        Self::new(self.rank(), axes, nodes).expect("siblings in another order make a tree of the same depth")
    }
}

/// Converts a BTDF or BRDF to a tensor tree of the requested shape in the given axes. A tree of the same rank is only
/// pruned further; with a tolerance of 0 and a level not coarser than its own it is unchanged. Regular transmission is
/// stored in the emergent cell of undeviated light; in rank 3 in the two cells on both sides of azimuth 0.
///
/// # Errors
/// Returns an error if the level or the tolerance is out of range, or if the tree has more nodes than readers of files
/// accept.
pub fn tree_on(btdf: &Btdf, axes: TreeAxes, shape: TreeShape) -> Result<OnTree, OnTreeError> {
    let grid = shape.check()?;
    if let (None, Some(Scattered::Tree(tree))) = (&btdf.regular, &btdf.scattered)
        && tree.rank() == shape.rank
        && tree.incident_grid().level() <= shape.level
        && shape.tolerance == 0.0
    {
        return Ok(OnTree { tree: tree.with_axes(axes), misplaced: 0.0, tau_change: 0.0, turned: 0.0 });
    }
    let codes = Codes::new(shape);
    let (values, turned) = match shape.rank {
        TreeRank::Four => (four(btdf, axes, grid, &codes), 0.0),
        TreeRank::Three => turning::three(btdf, axes, grid, &codes),
    };
    prune::prune(values, axes, shape, turned)
}

/// Returns the mean q of every box of the full grid of rank 4, in the order of `codes`. \[1/sr\]
fn four(btdf: &Btdf, axes: TreeAxes, grid: SquareGrid, codes: &Codes) -> Vec<f64> {
    let mut values = vec![0.0; codes.values];
    let (resolution, n) = (grid.resolution(), grid.len());
    // Codes of the incident and of the emergent cells, by their index in the façade frame.
    let place = |dimension, cell: usize| {
        codes.of_square(dimension, axes.turn_cell([cell % resolution, cell / resolution], resolution))
    };
    let inward: Vec<usize> = (0..n).map(|cell| place(0, cell)).collect();
    let outward: Vec<usize> = (0..n).map(|cell| place(2, cell)).collect();
    let mut fill = |row_of: &(dyn Fn(usize) -> Vec<f64> + Sync)| {
        // In blocks of rows, so that not all rows are in memory in addition to the values.
        for block in (0..n).collect::<Vec<_>>().chunks(256) {
            let rows: Vec<Vec<f64>> = block.par_iter().map(|&i| row_of(i)).collect();
            for (&i, row) in block.iter().zip(rows) {
                for (place, q) in outward.iter().zip(row) {
                    values[inward[i] | place] += q;
                }
            }
        }
    };
    match &btdf.scattered {
        None => {}
        Some(Scattered::Lambert(tau)) => fill(&|i| {
            let mean = grid.cell(i).samples(4).map(|d| tau.at(d.theta())).sum::<f64>() / 16.0;
            vec![mean / PI; n]
        }),
        Some(Scattered::Tree(tree)) if tree.rank() == TreeRank::Four => {
            spread_leaves(&tree.with_axes(axes), grid.level(), codes, &mut values);
        }
        Some(Scattered::Tree(tree)) => fill(&|i| {
            let incident: Vec<Incident> = grid.cell(i).samples(2).map(Incident).collect();
            let mut row: Vec<f64> = grid
                .cells()
                .map(|cell| {
                    let each = cell.samples(2).map(Emergent::from_undeviated);
                    each.map(|out| incident.iter().map(|&from| tree.q(from, out)).sum::<f64>()).sum::<f64>() / 16.0
                })
                .collect();
            let tau = grid.cell(i).samples(4).map(|d| tree.tau(Incident(d))).sum::<f64>() / 16.0;
            to_flux(&mut row, tau, grid.projected_solid_angle());
            row
        }),
        Some(scattered) => {
            let Some(matrix) = matrix_of(scattered) else { return values };
            let all = matrix.values();
            let shares_in = shares(grid, matrix.incident());
            let shares_out = shares(grid, matrix.emergent());
            let wide = matrix.emergent().len();
            fill(&|i| {
                let mut mean = vec![0.0; wide];
                for &(cell, share) in &shares_in[i] {
                    mean.iter_mut().zip(&all[cell * wide..][..wide]).for_each(|(m, q)| *m += share * q);
                }
                let mut row: Vec<f64> =
                    shares_out.iter().map(|list| list.iter().map(|&(o, share)| share * mean[o]).sum()).collect();
                let tau = shares_in[i].iter().map(|&(cell, share)| share * matrix.tau_by_cell()[cell]).sum();
                to_flux(&mut row, tau, grid.projected_solid_angle());
                row
            });
        }
    }
    if let Some(tau) = &btdf.regular {
        for i in 0..n {
            let mean = grid.cell(i).samples(4).map(|d| tau.at(d.theta())).sum::<f64>() / 16.0;
            values[inward[i] | outward[i]] += mean / grid.projected_solid_angle();
        }
    }
    values
}

/// Returns for every grid cell the ring cells that overlap it, with their shares of it.
fn shares(grid: SquareGrid, basis: &RingBasis) -> Vec<Vec<(usize, f64)>> {
    let side = (512 / grid.resolution()).max(4);
    let one = 1.0 / (side * side) as f64;
    let of_cell = |k: usize| {
        let mut list: Vec<(usize, f64)> = Vec::new();
        for place in grid.cell(k).samples(side).filter_map(|direction| basis.index(direction)) {
            match list.iter_mut().find(|entry| entry.0 == place) {
                Some(entry) => entry.1 += one,
                None => list.push((place, one)),
            }
        }
        list
    };
    (0..grid.len()).into_par_iter().map(of_cell).collect()
}

#[cfg(test)]
mod tests;
