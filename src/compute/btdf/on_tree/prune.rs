//! Merging of boxes of a full grid into leaves, as many as a stated share of misplaced flux allows.

use super::shape::{OnTree, OnTreeError, TreeShape};
use crate::compute::basis::SquareGrid;
use crate::compute::btdf::tensor_tree::{TensorTree, TreeAxes, TreeNode, TreeRank};
use crate::compute::direction::{Dir, Incident};
use crate::compute::limits::TREE_NODES;
use rayon::prelude::*;

/// Mean absolute deviation in a box, relative to its mean, up to which its values count as equal except for rounding.
/// Sums of up to 10⁴ terms round to 2⁻⁵² · 10⁴ ≈ 2e-12; held by the test `a_diffuser_is_one_leaf`.
const ROUNDING: f64 = 1e-10;

/// Box of the grid that could become a leaf.
#[derive(Clone, Copy)]
struct Merged {
    mean: f64,
    /// Mean absolute deviation from the mean.
    deviation: f64,
    /// Weight of the box in the sum of the flux over all incident directions.
    weight: f64,
}

struct Grid<'a> {
    shape: TreeShape,
    values: &'a [f64],
    /// Boxes of every level, the level of the root first.
    levels: Vec<Vec<Merged>>,
}

/// Creates a pruned tree from the values of a full grid in the order of the tree, with the differences by pruning.
/// `turned`: share of light that differs between azimuths, for rank 3.
pub(super) fn prune(values: Vec<f64>, axes: TreeAxes, shape: TreeShape, turned: f64) -> Result<OnTree, OnTreeError> {
    let weights = ring_weights(shape);
    let grid = Grid { shape, values: &values, levels: levels(&values, shape, &weights) };
    // Rank 3 does not use one half of its first coordinate: weight and flux are 0 there.
    let flux: f64 = values.iter().enumerate().map(|(k, q)| q * weight(shape, &weights, k)).sum();
    let mut threshold = 0.0;
    if shape.tolerance > 0.0 && flux > 0.0 {
        let mut high = values.iter().copied().fold(0.0, f64::max);
        for _ in 0..48 {
            let middle = 0.5 * (threshold + high);
            if grid.misplaced(middle, 0, 0) <= shape.tolerance * flux {
                threshold = middle;
            } else {
                high = middle;
            }
        }
    }
    let misplaced = if flux > 0.0 { grid.misplaced(threshold, 0, 0) / flux } else { 0.0 };
    let mut nodes = vec![TreeNode::Leaf(0.0)];
    grid.build(threshold, 0, 0, 0, &mut nodes)?;
    let tree = TensorTree::new(shape.rank, axes, nodes)?;
    let tau_change = tau_change(&tree, axes, shape, &values);
    Ok(OnTree { tree, misplaced, tau_change, turned })
}

/// Returns the weight of every step of sinθ, proportional to its projected solid angle; empty for rank 4, whose boxes
/// are equal.
fn ring_weights(shape: TreeShape) -> Vec<f64> {
    match shape.rank {
        TreeRank::Four => Vec::new(),
        TreeRank::Three => {
            let n = 1_usize << shape.level;
            (0..n).map(|at| (1.0 - (2.0 * at as f64 + 1.0) / n as f64).max(0.0)).collect()
        }
    }
}

/// Returns the weight of the finest box with the index `place`; `weights`: see [`ring_weights`].
fn weight(shape: TreeShape, weights: &[f64], place: usize) -> f64 {
    if weights.is_empty() {
        return 1.0;
    }
    weights[(0..shape.level as usize).map(|bit| (place >> (3 * bit) & 1) << bit).sum::<usize>()]
}

/// Returns, by level from the root, what every box would hold if it were merged into one leaf.
fn levels(values: &[f64], shape: TreeShape, weights: &[f64]) -> Vec<Vec<Merged>> {
    let bits = shape.rank.dimensions() as u32;
    (0..shape.level)
        .map(|level| {
            let boxes = 1_usize << (bits * (shape.level - level));
            let of_slice = |(index, slice): (usize, &[f64])| {
                let weight = |k: usize| weight(shape, weights, index * boxes + k);
                let (sum, all) = slice
                    .iter()
                    .enumerate()
                    .fold((0.0, 0.0), |(sum, all), (k, q)| (sum + weight(k) * q, all + weight(k)));
                let mean = if all > 0.0 { sum / all } else { 0.0 };
                let deviations: f64 = slice.iter().enumerate().map(|(k, q)| weight(k) * (q - mean).abs()).sum();
                Merged { mean, deviation: if all > 0.0 { deviations / all } else { 0.0 }, weight: all }
            };
            values.par_chunks(boxes).enumerate().map(of_slice).collect()
        })
        .collect()
}

impl Grid<'_> {
    /// Returns the box as a leaf if its deviation is within the threshold.
    fn leaf(&self, threshold: f64, level: usize, index: usize) -> Option<Merged> {
        let merged = self.levels.get(level)?[index];
        // The root of rank 3 must stay a branch, because half of it is not used.
        let whole = level > 0 || self.shape.rank == TreeRank::Four;
        (whole && merged.deviation <= threshold.max(ROUNDING * merged.mean)).then_some(merged)
    }

    /// Returns the weighted deviation that merging causes in a box with this threshold.
    fn misplaced(&self, threshold: f64, level: usize, index: usize) -> f64 {
        if level == self.shape.level as usize {
            return 0.0;
        }
        if let Some(merged) = self.leaf(threshold, level, index) {
            return merged.deviation * merged.weight;
        }
        let children = self.shape.rank.children();
        (0..children).map(|child| self.misplaced(threshold, level + 1, index * children + child)).sum()
    }

    /// Appends the nodes below a box, given by its level and index, to `nodes`, and sets the node `place` of the box
    /// itself.
    fn build(
        &self,
        threshold: f64,
        level: usize,
        index: usize,
        place: usize,
        nodes: &mut Vec<TreeNode>,
    ) -> Result<(), OnTreeError> {
        if level == self.shape.level as usize {
            nodes[place] = TreeNode::Leaf(self.values[index]);
            return Ok(());
        }
        if let Some(merged) = self.leaf(threshold, level, index) {
            nodes[place] = TreeNode::Leaf(merged.mean);
            return Ok(());
        }
        let (start, children) = (nodes.len(), self.shape.rank.children());
        if start + children > TREE_NODES {
            return Err(OnTreeError::Size { most: TREE_NODES });
        }
        nodes[place] = TreeNode::Branch(start as u32);
        nodes.resize(start + children, TreeNode::Leaf(0.0));
        for child in 0..children {
            self.build(threshold, level + 1, index * children + child, start + child, nodes)?;
        }
        Ok(())
    }
}

/// Returns the largest difference of τ between the tree and the grid from which it was created.
fn tau_change(tree: &TensorTree, axes: TreeAxes, shape: TreeShape, values: &[f64]) -> f64 {
    let Some(grid) = SquareGrid::new(shape.level) else { return 0.0 };
    let resolution = grid.resolution();
    let mut tau = vec![0.0; if shape.rank == TreeRank::Four { grid.len() } else { resolution }];
    let dimensions = shape.rank.dimensions();
    let coordinate = |place: usize, d: usize| -> usize {
        (0..shape.level as usize).map(|bit| (place >> (dimensions * bit + d) & 1) << bit).sum()
    };
    for (place, q) in values.iter().enumerate().filter(|(_, q)| **q != 0.0) {
        let at = match shape.rank {
            TreeRank::Four => coordinate(place, 1) * resolution + coordinate(place, 0),
            TreeRank::Three => coordinate(place, 0),
        };
        tau[at] += q * grid.projected_solid_angle();
    }
    let differs = |(at, tau): (usize, &f64)| {
        let direction = match shape.rank {
            TreeRank::Four => {
                let [ix, iy] = axes.turn_cell([at % resolution, at / resolution], resolution);
                grid.cell(iy * resolution + ix).centre()
            }
            TreeRank::Three => {
                Dir::from_theta_phi((1.0 - (2.0 * at as f64 + 1.0) / resolution as f64).max(0.0).asin(), 0.7)
            }
        };
        (tree.tau(Incident(direction)) - tau).abs()
    };
    let used = if shape.rank == TreeRank::Four { tau.len() } else { resolution / 2 };
    tau[..used].iter().enumerate().map(differs).fold(0.0, f64::max)
}
