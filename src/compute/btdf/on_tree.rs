//! Any function as a tensor tree: what writers of trees make of functions on other cells, and what pruning costs.
//!
//! The function is averaged over a full grid of 2^level steps a coordinate, each incident cell scaled to its exact
//! flux; then boxes whose values hardly differ become one leaf with their mean. Which boxes, one number decides: the
//! mean absolute deviation inside the box, a threshold found by bisection such that all merging together misplaces no
//! more than the stated share of the light. (Radiance's `rttree_reduce` asks for a percentile of boxes instead, which
//! bounds the size of the file rather than its error.) The rule treats both squares alike, so that reciprocal data stay
//! reciprocal.

use super::tensor_tree::{TensorTree, TreeAxes, TreeError, TreeNode, TreeRank};
use super::{Btdf, CellMatrix, Scattered};
use crate::compute::basis::{RingBasis, SquareGrid};
use crate::compute::direction::{Emergent, Incident};
use rayon::prelude::*;
use std::borrow::Cow;
use std::f64::consts::PI;

mod prune;
mod turning;

/// Finest tree of rank 4: 2⁶ steps a coordinate, 16.8 million boxes before pruning.
pub const MOST_LEVEL_4: u32 = 6;
/// Finest tree of rank 3: 2⁸ steps a coordinate, as many boxes.
pub const MOST_LEVEL_3: u32 = 8;

/// The tree that is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TreeShape {
    /// Coordinates.
    pub rank: TreeRank,
    /// log₂ of the finest steps of a coordinate.
    pub level: u32,
    /// Largest share of the light that merging boxes may misplace, 0 … 1.
    pub tolerance: f64,
}

/// A tree and how it differs from its source.
#[derive(Debug, Clone, PartialEq)]
pub struct OnTree {
    /// The tree.
    pub tree: TensorTree,
    /// Share of the light that merging boxes misplaced, of the grid before.
    pub misplaced: f64,
    /// Largest change of τ that merging made at any finest incident cell.
    pub tau_change: f64,
    /// Rank 3: share of the light by which single azimuths of incidence differ from the mean that the tree keeps.
    pub turned: f64,
}

/// Why there is no such tree.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum OnTreeError {
    /// Too coarse or too fine.
    #[error("a tree of level {level}; expected 1 … {most} for rank {rank}")]
    Level {
        /// Asked for.
        level: u32,
        /// Most for the rank.
        most: u32,
        /// Its coordinates.
        rank: usize,
    },
    /// No share.
    #[error("a tolerance of {0}; expected a share of the light, 0 … 1")]
    Tolerance(f64),
    /// Larger than any reader takes.
    #[error("a tree of more than {most} nodes; expected a coarser level or a larger tolerance")]
    Size {
        /// Limit.
        most: usize,
    },
    /// Values that no tree can hold.
    #[error(transparent)]
    Tree(#[from] TreeError),
}

impl TreeShape {
    /// The finest level that is made for a rank.
    pub const fn most_level(rank: TreeRank) -> u32 {
        match rank {
            TreeRank::Four => MOST_LEVEL_4,
            TreeRank::Three => MOST_LEVEL_3,
        }
    }

    /// The coarsest level whose cells are about a quarter of the source's, at most 6.
    pub fn level_for(btdf: &Btdf) -> u32 {
        let cells = match &btdf.scattered {
            Some(Scattered::Tree(tree)) => return tree.incident_grid().level().min(MOST_LEVEL_4),
            Some(Scattered::Cells(matrix)) => matrix.incident().len().max(matrix.emergent().len()),
            Some(Scattered::Directions(data)) => data.incident().len().max(data.emergent().len()),
            Some(Scattered::Lambert(_)) | None => 145,
        };
        (1..MOST_LEVEL_4).find(|level| 1_usize << (2 * level) >= 4 * cells).unwrap_or(MOST_LEVEL_4)
    }

    fn check(self) -> Result<SquareGrid, OnTreeError> {
        if !(0.0..=1.0).contains(&self.tolerance) {
            return Err(OnTreeError::Tolerance(self.tolerance));
        }
        let most = Self::most_level(self.rank);
        let wrong = OnTreeError::Level { level: self.level, most, rank: self.rank.dimensions() };
        if self.level > most {
            return Err(wrong);
        }
        SquareGrid::new(self.level).ok_or(wrong)
    }
}

impl TensorTree {
    /// The same function with its squares in other axes, exact: front and back axes differ by a half turn, which
    /// leaves the relative azimuths of rank 3 as they are.
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

/// A function as a tree in the given axes. A tree of the same rank is only pruned further, and kept as it is by a
/// tolerance of 0 and a level that is not coarser than its own. Light that goes straight on fills its own cell; in rank
/// 3 the two cells on both sides of azimuth 0.
///
/// # Errors
/// A level or tolerance out of range; a tree with more nodes than readers take.
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

/// Places of boxes in the order of the tree: the children of a branch side by side on every level, so that all that
/// lies in one box is one slice.
struct Codes {
    /// Bits of a coordinate, spread to those of its dimension 0.
    spread: Vec<usize>,
    values: usize,
}

impl Codes {
    fn new(shape: TreeShape) -> Self {
        let dimensions = shape.rank.dimensions();
        let spread = (0..1_usize << shape.level)
            .map(|at| (0..shape.level as usize).map(|bit| (at >> bit & 1) << (dimensions * bit)).sum())
            .collect();
        Self { spread, values: 1 << (dimensions as u32 * shape.level) }
    }

    fn of(&self, dimension: usize, at: usize) -> usize {
        self.spread[at] << dimension
    }

    fn of_square(&self, dimension: usize, [x, y]: [usize; 2]) -> usize {
        self.of(dimension, x) | self.of(dimension + 1, y)
    }
}

/// The plain matrix behind cells or directions.
fn matrix_of(scattered: &Scattered) -> Option<Cow<'_, CellMatrix>> {
    match scattered {
        Scattered::Cells(matrix) => Some(Cow::Borrowed(matrix)),
        Scattered::Directions(data) => Some(Cow::Owned(data.to_cells())),
        Scattered::Lambert(_) | Scattered::Tree(_) => None,
    }
}

fn four(btdf: &Btdf, axes: TreeAxes, grid: SquareGrid, codes: &Codes) -> Vec<f64> {
    let mut values = vec![0.0; codes.values];
    let (resolution, n) = (grid.resolution(), grid.len());
    // Both squares by cells of the façade frame.
    let place = |dimension, cell: usize| {
        codes.of_square(dimension, axes.turn_cell([cell % resolution, cell / resolution], resolution))
    };
    let inward: Vec<usize> = (0..n).map(|cell| place(0, cell)).collect();
    let outward: Vec<usize> = (0..n).map(|cell| place(2, cell)).collect();
    let mut fill = |row_of: &(dyn Fn(usize) -> Vec<f64> + Sync)| {
        // A few rows at a time, so that they need not all be kept beside the values.
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
                    let each = cell.samples(2).map(Emergent::from_through_name);
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

/// Scales a row of emergent cells to its flux.
fn to_flux(row: &mut [f64], tau: f64, projected_solid_angle: f64) {
    let got = row.iter().sum::<f64>() * projected_solid_angle;
    if got > 0.0 {
        row.iter_mut().for_each(|q| *q *= tau / got);
    }
}

/// For every grid cell the ring cells that it lies in, with their shares of it.
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

/// A tree's leaves on the full grid; finer ones averaged.
fn spread_leaves(tree: &TensorTree, level: u32, codes: &Codes, values: &mut [f64]) {
    let dimensions = tree.rank().dimensions();
    tree.for_each_leaf(&mut |at, corner, q| {
        let coarser = at.saturating_sub(level);
        let code: usize =
            (0..dimensions).map(|d| codes.of(d, (corner[d] >> coarser) << level.saturating_sub(at))).sum();
        let boxes = 1_usize << (dimensions as u32 * level.saturating_sub(at));
        let part = 0.5_f64.powi((dimensions as u32 * coarser) as i32);
        values[code..code + boxes].iter_mut().for_each(|value| *value += part * q);
    });
}

#[cfg(test)]
mod tests;
