//! Order of the values on the full grid of a tensor tree.

use super::shape::TreeShape;
use crate::compute::btdf::tensor_tree::TensorTree;
use crate::compute::btdf::{CellMatrix, Scattered};
use std::borrow::Cow;

/// Indices of boxes in the order of the tree: the children of a branch are consecutive on every level, so that all
/// values in one box are one slice.
pub(super) struct Codes {
    /// Bits of a coordinate, spread to the positions of dimension 0 in the index.
    pub(super) spread: Vec<usize>,
    pub(super) values: usize,
}

impl Codes {
    pub(super) fn new(shape: TreeShape) -> Self {
        let dimensions = shape.rank.dimensions();
        let spread = (0..1_usize << shape.level)
            .map(|at| (0..shape.level as usize).map(|bit| (at >> bit & 1) << (dimensions * bit)).sum())
            .collect();
        Self { spread, values: 1 << (dimensions as u32 * shape.level) }
    }

    pub(super) fn of(&self, dimension: usize, at: usize) -> usize {
        self.spread[at] << dimension
    }

    pub(super) fn of_square(&self, dimension: usize, [x, y]: [usize; 2]) -> usize {
        self.of(dimension, x) | self.of(dimension + 1, y)
    }
}

/// Returns the scattered part as patch-averaged data if it is stored per cell or at single incident directions; `None`
/// for other kinds.
pub(super) fn matrix_of(scattered: &Scattered) -> Option<Cow<'_, CellMatrix>> {
    match scattered {
        Scattered::Cells(matrix) => Some(Cow::Borrowed(matrix)),
        Scattered::Directions(data) => Some(Cow::Owned(data.to_cells())),
        Scattered::Lambert(_) | Scattered::Tree(_) => None,
    }
}

/// Scales the values of one incident cell so that their flux is `tau`.
pub(super) fn to_flux(row: &mut [f64], tau: f64, projected_solid_angle: f64) {
    let got = row.iter().sum::<f64>() * projected_solid_angle;
    if got > 0.0 {
        row.iter_mut().for_each(|q| *q *= tau / got);
    }
}

/// Adds the leaves of a tree to the values on the full grid; finer leaves are averaged.
pub(super) fn spread_leaves(tree: &TensorTree, level: u32, codes: &Codes, values: &mut [f64]) {
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
