//! Tensor trees: BTDFs and BRDFs on the squares that Shirley and Chiu map to the disk of direction cosines (Radiance's
//! adaptive BSDF).
//!
//! A tree of rank 4 divides (incident square) × (emergent square); one of rank 3 has a single incident coordinate, 0.5
//! − sinθ/2, and an emergent square that rotates with the azimuth of incidence. Every leaf is a constant q. The squares
//! are those of the *file*, with the orientation [`TreeAxes`] to the façade frame; nothing is converted when a tree is
//! read, so that directions on borders fall into the same leaf as in Radiance.
//!
//! Child k of a branch lies in the upper half of dimension d if bit d of k is set. Reference: Radiance `bsdf_t.c`
//! (dimension order, rotation of rank 3, reciprocity).

use super::pyramid::Pyramid;
use crate::compute::basis::{AzimuthMap, MAX_LEVEL, RingBasis, SquareGrid, square_from_disk};
use crate::compute::direction::{Dir, Emergent, Facade, Incident};
use std::f64::consts::PI;
use std::sync::Arc;

/// Rank of a tensor tree: its number of coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TreeRank {
    /// Rank 3, for rotationally symmetric systems: sinθ of incidence, and the emergent square relative to the azimuth
    /// of incidence.
    Three,
    /// Rank 4, for any system: incident square and emergent square.
    Four,
}

impl TreeRank {
    /// Returns the number of coordinates of a tree of this rank.
    pub const fn dimensions(self) -> usize {
        match self {
            Self::Three => 3,
            Self::Four => 4,
        }
    }

    /// Returns the number of children of every branch of a tree of this rank.
    pub const fn children(self) -> usize {
        1 << self.dimensions()
    }
}

/// Orientation of the axes of a tensor tree's squares relative to x and y of the façade frame, with emergent directions
/// reversed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TreeAxes {
    /// Axes (x, −y) for light from outside, corresponding to [`AzimuthMap::KLEMS_FRONT`].
    Front,
    /// Axes (−x, y) for light from inside, corresponding to [`AzimuthMap::KLEMS_BACK`].
    Back,
}

impl TreeAxes {
    /// Returns the azimuth convention of ring bases that corresponds to these axes.
    pub const fn azimuth(self) -> AzimuthMap {
        match self {
            Self::Front => AzimuthMap::KLEMS_FRONT,
            Self::Back => AzimuthMap::KLEMS_BACK,
        }
    }

    /// Converts disk coordinates from the façade frame to the tree's axes, or vice versa.
    pub(super) fn turn(self, [x, y]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Front => [x, -y],
            Self::Back => [-x, y],
        }
    }

    /// Converts column and row of a grid cell from the façade frame to the tree's axes, or vice versa.
    pub(super) const fn turn_cell(self, [ix, iy]: [usize; 2], resolution: usize) -> [usize; 2] {
        match self {
            Self::Front => [ix, resolution - 1 - iy],
            Self::Back => [resolution - 1 - ix, iy],
        }
    }
}

/// Node of a tensor tree in its list of nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TreeNode {
    /// Leaf: constant q in its whole box. \[1/sr\]
    Leaf(f64),
    /// Branch: index of the first of its 2^rank consecutive children.
    Branch(u32),
}

/// Error of a list of nodes that is not a valid tensor tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum TreeError {
    /// List without nodes.
    #[error("the tree has no nodes")]
    Empty,
    /// Branch whose children do not follow it in the list or are not in it.
    #[error("node {0} names children that are not in the list behind it")]
    Children(usize),
    /// Tree with more than [`MAX_LEVEL`] levels.
    #[error("the tree is more than {MAX_LEVEL} levels deep")]
    Depth,
    /// Two branches with the same children; such a list could have an exponential number of leaves.
    #[error("node {0} names children that another node has already")]
    Shared(usize),
    /// Leaf with a value that is negative or not finite.
    #[error("node {0} holds a value that is negative or not finite")]
    Value(usize),
}

/// BTDF or BRDF as a tensor tree of rank 3 or 4 (Radiance's adaptive BSDF).
#[derive(Debug, Clone, PartialEq)]
pub struct TensorTree {
    rank: TreeRank,
    axes: TreeAxes,
    grid: SquareGrid,
    nodes: Arc<Vec<TreeNode>>,
    /// Transmittance τ of every finest incident cell: for rank 4 of the square in the tree's axes, row by row; for rank
    /// 3 of rings of equal steps of sinθ from the normal outwards.
    tau: Arc<Vec<f64>>,
}

impl TensorTree {
    /// Creates a tree from its nodes, the root first and every branch before its children.
    ///
    /// # Errors
    /// Returns an error if the nodes are not a valid tree, or if a value is negative or not finite.
    pub fn new(rank: TreeRank, axes: TreeAxes, nodes: Vec<TreeNode>) -> Result<Self, TreeError> {
        if nodes.is_empty() {
            return Err(TreeError::Empty);
        }
        // Level 0: not yet the child of another node.
        let mut level = vec![0_u8; nodes.len()];
        let mut depth = 0;
        for (index, node) in nodes.iter().enumerate() {
            match *node {
                TreeNode::Leaf(q) if q.is_finite() && q >= 0.0 => {}
                TreeNode::Leaf(_) => return Err(TreeError::Value(index)),
                TreeNode::Branch(first) => {
                    let children = first as usize..first as usize + rank.children();
                    if children.start <= index || children.end > nodes.len() {
                        return Err(TreeError::Children(index));
                    }
                    let below = level[index] + 1;
                    if u32::from(below) > MAX_LEVEL {
                        return Err(TreeError::Depth);
                    }
                    if level[children.clone()].iter().any(|level| *level > 0) {
                        return Err(TreeError::Shared(index));
                    }
                    depth = depth.max(below);
                    level[children].fill(below);
                }
            }
        }
        let grid = SquareGrid::new(u32::from(depth).max(1)).ok_or(TreeError::Depth)?;
        let mut tree = Self { rank, axes, grid, nodes: Arc::new(nodes), tau: Arc::default() };
        tree.tau = Arc::new(tree.tau_of_cells());
        Ok(tree)
    }

    /// Returns the rank of the tree.
    pub const fn rank(&self) -> TreeRank {
        self.rank
    }

    /// Returns the orientation of the squares' axes to the façade frame.
    pub const fn axes(&self) -> TreeAxes {
        self.axes
    }

    /// Returns the nodes of the tree, the root first.
    pub fn nodes(&self) -> &[TreeNode] {
        &self.nodes
    }

    /// Returns the number of leaves of the tree.
    pub fn leaves(&self) -> usize {
        self.nodes.iter().filter(|node| matches!(node, TreeNode::Leaf(_))).count()
    }

    /// Returns the grid of the finest incident (and emergent) cells, in the façade frame.
    pub const fn incident_grid(&self) -> SquareGrid {
        self.grid
    }

    /// Returns the number of cells along one side of the finest incident grid. Rank 3 resolves sinθ in half as many
    /// steps.
    pub const fn incident_resolution(&self) -> usize {
        self.grid.resolution()
    }

    /// Returns the directional-hemispherical transmittance of every cell of [`Self::incident_grid`], in its order.
    pub fn tau_by_cell(&self) -> Vec<f64> {
        let resolution = self.grid.resolution();
        self.grid
            .cells()
            .map(|cell| match self.rank {
                TreeRank::Four => {
                    let [ix, iy] = self.axes.turn_cell(cell.position(), resolution);
                    self.tau[iy * resolution + ix]
                }
                TreeRank::Three => self.tau[frame_of(cell.position(), resolution)],
            })
            .collect()
    }

    /// Returns the largest directional-hemispherical transmittance of any incident cell.
    pub fn tau_max(&self) -> f64 {
        self.tau.iter().copied().fold(0.0, f64::max)
    }

    /// Returns the luminance coefficient q of the leaf that contains an incident and an emergent direction; 0 for
    /// directions on the wrong side. \[1/sr\]
    pub fn q(&self, incident: Incident, emergent: Emergent) -> f64 {
        let (Some(incident), Some(undeviated)) = (self.disk(incident.0), self.disk(emergent.undeviated_incident()))
        else {
            return 0.0;
        };
        match self.rank {
            TreeRank::Four => {
                let ([a, b], [c, d]) = (square_from_disk(incident), square_from_disk(undeviated));
                self.leaf(&[a, b, c, d])
            }
            TreeRank::Three => {
                let [c, d] = square_from_disk(rotate(undeviated, -incident[1].atan2(incident[0])));
                self.leaf(&[radial_coordinate(incident), c, d])
            }
        }
    }

    /// Returns the directional-hemispherical transmittance of the finest incident cell that contains the direction; 0
    /// for z < 0.
    pub fn tau(&self, incident: Incident) -> f64 {
        self.disk(incident.0).map_or(0.0, |disk| match self.rank {
            TreeRank::Four => {
                let [ix, iy] = self.grid.position(disk);
                self.tau[iy * self.grid.resolution() + ix]
            }
            TreeRank::Three => self.tau[self.ring(disk)],
        })
    }

    /// Returns the hemispherical transmittance, for light from a hemisphere of uniform luminance.
    pub fn tau_hemispherical(&self) -> f64 {
        match self.rank {
            TreeRank::Four => self.tau.iter().sum::<f64>() / self.tau.len() as f64,
            TreeRank::Three => {
                let n = self.tau.len() as f64;
                self.tau.iter().enumerate().map(|(k, tau)| tau * (2.0 * k as f64 + 1.0) / (n * n)).sum()
            }
        }
    }

    /// Returns the basis whose cell centres are used for listings of τ: the full Klems basis with θ = 0, 10, 20, … 70,
    /// 82.5° and azimuths for light from outside, the orientation of a front tree's square. Only the centres matter: τ
    /// is that of the tree's cell that contains them, not of the Klems patch.
    pub fn incident_listing(&self) -> RingBasis {
        RingBasis::klems_full(AzimuthMap::KLEMS_FRONT)
    }

    /// Returns the disk coordinates of a direction in the tree's axes; `None` for z < 0.
    pub(super) fn disk(&self, d: Dir<Facade>) -> Option<[f64; 2]> {
        let v = d.vector();
        // The square has a border on the vertical meridian, a frequent azimuth of the sun. Such directions belong to
        // the counter-clockwise side, so that rounding of a cosine does not decide.
        let x = if v.x.abs() < 1e-12 && v.y != 0.0 { (-1e-12_f64).copysign(-v.y) } else { v.x };
        (v.z >= -1e-12).then(|| self.axes.turn([x, v.y]))
    }

    /// Returns the index of the ring of equal steps of sinθ that contains a point of the disk, from the normal
    /// outwards.
    pub(super) fn ring(&self, disk: [f64; 2]) -> usize {
        let rings = self.grid.resolution() / 2;
        rings - 1 - ((radial_coordinate(disk) * self.grid.resolution() as f64) as usize).min(rings - 1)
    }

    /// Returns q of the leaf that contains the point `at` (coordinates 0 … 1). \[1/sr\]
    pub(super) fn leaf(&self, at: &[f64]) -> f64 {
        let mut at = [at[0], at[1], at[2], at.get(3).copied().unwrap_or(0.0)];
        let mut index = 0;
        loop {
            match self.nodes[index] {
                TreeNode::Leaf(q) => return q,
                TreeNode::Branch(first) => {
                    let mut child = 0;
                    for (d, s) in at.iter_mut().enumerate().take(self.rank.dimensions()) {
                        *s *= 2.0;
                        if *s >= 1.0 {
                            *s -= 1.0;
                            child |= 1 << d;
                        }
                    }
                    index = first as usize + child;
                }
            }
        }
    }

    /// Calls `f` for every leaf, with its level, the corner of its box in cells of that level, and its q.
    pub(super) fn for_each_leaf(&self, f: &mut impl FnMut(u32, [usize; 4], f64)) {
        self.walk(0, 0, [0; 4], f);
    }

    fn walk(&self, index: usize, level: u32, corner: [usize; 4], f: &mut impl FnMut(u32, [usize; 4], f64)) {
        match self.nodes[index] {
            TreeNode::Leaf(q) => f(level, corner, q),
            TreeNode::Branch(first) => {
                for child in 0..self.rank.children() {
                    if self.rank == TreeRank::Three && level == 0 && child & 1 == 1 {
                        continue;
                    }
                    let corner = std::array::from_fn(|d| 2 * corner[d] + (child >> d & 1));
                    self.walk(first as usize + child, level + 1, corner, f);
                }
            }
        }
    }

    /// Returns τ of every incident cell (rank 4), or of every ring of sinθ from the normal outwards (rank 3).
    fn tau_of_cells(&self) -> Vec<f64> {
        let level = self.grid.level();
        match self.rank {
            TreeRank::Four => {
                let mut sums = Pyramid::new(level);
                self.for_each_leaf(&mut |level, corner, q| {
                    // An emergent box of that level has 4^−level of the disk's projected solid angle π.
                    *sums.at(level, corner[0], corner[1]) += q * PI / 4_f64.powi(level as i32);
                });
                sums.spread()
            }
            TreeRank::Three => {
                let rings = self.grid.resolution() / 2;
                let mut tau = vec![0.0; rings];
                self.for_each_leaf(&mut |at, corner, q| {
                    let cells = self.grid.resolution() >> at;
                    let from = corner[0] * cells;
                    for cell in from..(from + cells).min(rings) {
                        tau[rings - 1 - cell] += q * PI / 4_f64.powi(at as i32);
                    }
                });
                tau
            }
        }
    }
}

/// Returns the incident coordinate of rank 3 for a point of the disk. A small shift assigns borders to the ring farther
/// out, like in Radiance.
pub(super) fn radial_coordinate(disk: [f64; 2]) -> f64 {
    (0.5 - 1e-12 - 0.5 * disk[0].hypot(disk[1])).max(0.0)
}

/// Returns a point rotated counter-clockwise by an angle. \[rad\]
pub(super) fn rotate([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// Returns the index of the concentric square frame, from the centre, in which a grid cell lies.
pub(super) fn frame_of([ix, iy]: [usize; 2], resolution: usize) -> usize {
    let half = resolution / 2;
    let from_centre = |i: usize| if i >= half { i - half } else { half - 1 - i };
    from_centre(ix).max(from_centre(iy))
}

#[cfg(test)]
mod tests;
