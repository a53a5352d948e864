//! Reciprocity of tensor trees: the function for light in the opposite direction, and the difference of two trees.

use super::tensor_tree::{TensorTree, TreeNode, TreeRank, radial_coordinate, rotate};
use crate::compute::basis::{disk_from_square, square_from_disk};

impl TensorTree {
    /// Returns the transmission of light in the opposite direction by reciprocity: q_back(ω′, ω_e) = q_front(ω_e, ω′).
    ///
    /// Rank 4: the two squares are exchanged, exactly. Rank 3: the exchanged function is not constant on the same
    /// cells; it is averaged over them again (27 points per leaf), with the exact hemispherical transmittance. A
    /// rotationally symmetric system is assumed to be mirror-symmetric, too.
    pub fn reversed(&self) -> Self {
        match self.rank() {
            TreeRank::Four => {
                let mut nodes = vec![TreeNode::Leaf(0.0)];
                self.exchange(0, 0, &mut nodes);
                Self::new(self.rank(), self.axes(), nodes).expect("exchanged squares make a tree of the same depth")
            }
            TreeRank::Three => self.reversed_isotropic(),
        }
    }

    fn exchange(&self, from: usize, to: usize, nodes: &mut Vec<TreeNode>) {
        match self.nodes()[from] {
            leaf @ TreeNode::Leaf(_) => nodes[to] = leaf,
            TreeNode::Branch(first) => {
                let start = nodes.len();
                nodes[to] = TreeNode::Branch(start as u32);
                nodes.extend([TreeNode::Leaf(0.0); 16]);
                for child in 0..16 {
                    let exchanged = ((child & 3) << 2) | (child >> 2);
                    self.exchange(first as usize + exchanged, start + child, nodes);
                }
            }
        }
    }

    /// Returns the tree of rank 3 for light in the opposite direction, scaled to the same hemispherical transmittance.
    fn reversed_isotropic(&self) -> Self {
        // Points along each coordinate of a leaf: the middles of its thirds. Chosen: cost; the flux is kept exactly.
        // Held by the test `reversing_a_rank_3_tree_keeps_smooth_functions`.
        const POINTS: [f64; 3] = [1.0 / 6.0, 0.5, 5.0 / 6.0];
        let resolution = self.incident_grid().resolution();
        let side = 1.0 / resolution as f64;
        let mean = |corner: [usize; 3]| -> f64 {
            let at = |d: usize, p: f64| (corner[d] as f64 + p) * side;
            let mut sum = 0.0;
            let mut weight = 0.0;
            for p in POINTS {
                let r_in = 1.0 - 2.0 * at(0, p);
                for (u, v) in POINTS.iter().flat_map(|&u| POINTS.map(|v| (u, v))) {
                    let twin = disk_from_square([at(1, u), at(2, v)]);
                    // Incidence at r_in along the axis and emergence at `twin` become incidence at |twin| and emergence
                    // at r_in, rotated back by the azimuth of `twin`; mirrored as well, which changes no value but
                    // keeps undeviated light on its side of the border at azimuth 0.
                    let r_out = twin[0].hypot(twin[1]);
                    let [c, d] = square_from_disk(rotate([r_in, 0.0], twin[1].atan2(twin[0])));
                    sum += r_in * self.leaf(&[radial_coordinate([r_out, 0.0]), c, d]);
                    weight += r_in;
                }
            }
            sum / weight
        };
        let mut nodes = vec![TreeNode::Leaf(0.0)];
        build_isotropic(self.incident_grid().level(), [0; 3], 0, resolution / 2, &mean, &mut nodes);
        let mut tree = Self::new(self.rank(), self.axes(), nodes).expect("means of leaves are finite and not negative");
        let (want, got) = (self.tau_hemispherical(), tree.tau_hemispherical());
        if got > 0.0 {
            let scaled = tree.nodes().iter().map(|node| match *node {
                TreeNode::Leaf(q) => TreeNode::Leaf(q * want / got),
                branch @ TreeNode::Branch(_) => branch,
            });
            tree = Self::new(self.rank(), self.axes(), scaled.collect()).expect("scaling keeps a tree a tree");
        }
        tree
    }

    /// Returns the mean relative difference from another tree of the same rank, weighted like in
    /// [`super::reciprocity_error`]; `None` for different ranks.
    pub(super) fn relative_difference(&self, other: &Self) -> Option<f64> {
        if self.rank() != other.rank() {
            return None;
        }
        // Front and back axes differ by a half turn of both squares; relative azimuths of rank 3 are not touched.
        let flip = if self.axes() != other.axes() && self.rank() == TreeRank::Four { 15 } else { 0 };
        let mut total = (0.0, 0.0);
        self.compare(0, other, 0, flip, (0, 1.0), &mut total);
        Some(if total.1 > 0.0 { total.0 / total.1 } else { 0.0 })
    }

    fn compare(
        &self,
        here: usize,
        other: &Self,
        there: usize,
        flip: usize,
        (level, weight): (u32, f64),
        total: &mut (f64, f64),
    ) {
        let below = (level + 1, weight / self.rank().children() as f64);
        for child in 0..self.rank().children() {
            // The upper half of the radial coordinate is not used.
            if self.rank() == TreeRank::Three && level == 0 && child & 1 == 1 {
                continue;
            }
            let (a, b) = match (self.nodes()[here], other.nodes()[there]) {
                (TreeNode::Leaf(p), TreeNode::Leaf(q)) => {
                    total.0 += weight * (p - q).abs();
                    total.1 += weight * 0.5 * (p + q);
                    return;
                }
                (TreeNode::Branch(first), TreeNode::Leaf(_)) => (first as usize + child, there),
                (TreeNode::Leaf(_), TreeNode::Branch(first)) => (here, first as usize + (child ^ flip)),
                (TreeNode::Branch(p), TreeNode::Branch(q)) => (p as usize + child, q as usize + (child ^ flip)),
            };
            self.compare(a, other, b, flip, below, total);
        }
    }
}

/// Builds a full tree of rank 3 from the means of its finest boxes, with equal children merged and 0 in the unused half
/// of the first coordinate.
pub(super) fn build_isotropic(
    levels_below: u32,
    corner: [usize; 3],
    place: usize,
    used: usize,
    mean: &impl Fn([usize; 3]) -> f64,
    nodes: &mut Vec<TreeNode>,
) {
    if levels_below == 0 {
        nodes[place] = TreeNode::Leaf(if corner[0] < used { mean(corner) } else { 0.0 });
        return;
    }
    if corner[0] << levels_below >= used {
        nodes[place] = TreeNode::Leaf(0.0);
        return;
    }
    let start = nodes.len();
    nodes[place] = TreeNode::Branch(start as u32);
    nodes.extend([TreeNode::Leaf(0.0); 8]);
    for child in 0..8 {
        let below = std::array::from_fn(|d| 2 * corner[d] + (child >> d & 1));
        build_isotropic(levels_below - 1, below, start + child, used, mean, nodes);
    }
    let first = nodes[start];
    if nodes.len() == start + 8 && matches!(first, TreeNode::Leaf(_)) && nodes[start..].iter().all(|n| *n == first) {
        nodes.truncate(start);
        nodes[place] = first;
    }
}
