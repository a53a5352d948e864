//! Tensor trees: scattering on the squares that Shirley and Chiu map to the disk of direction cosines.
//!
//! A tree of rank 4 divides (incident square) × (emergent square); one of rank 3 has a single incident coordinate,
//! 0.5 − sinθ/2, and an emergent square that turns with the azimuth of incidence. Every leaf is a constant q.
//! Squares are those of the *file*, whose axes stand to the façade frame as [`TreeAxes`] says; nothing is converted
//! when a tree is read, so that directions on borders fall into the same leaf as in Radiance.
//!
//! Child k of a branch lies in the upper half of dimension d where bit d of k is set.
//! Reference: Radiance `bsdf_t.c` (dimension order, rotation of rank 3, reciprocity).

use super::pyramid::Pyramid;
use crate::compute::basis::{AzimuthMap, MAX_LEVEL, RingBasis, SquareGrid, square_from_disk};
use crate::compute::direction::{Dir, Emergent, Facade, Incident};
use std::f64::consts::PI;
use std::sync::Arc;

/// Number of coordinates of a tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TreeRank {
    /// Rank 3, rotationally symmetric: sinθ of incidence, and the emergent square relative to the azimuth of incidence.
    Three,
    /// Rank 4: incident square and emergent square.
    Four,
}

impl TreeRank {
    /// Returns the number of coordinates.
    pub const fn dimensions(self) -> usize {
        match self {
            Self::Three => 3,
            Self::Four => 4,
        }
    }

    /// Returns the number of children of every branch.
    pub const fn children(self) -> usize {
        1 << self.dimensions()
    }
}

/// Orientation of the squares' axes to the façade frame, with through directions on both sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TreeAxes {
    /// Axes for light from outside: (x, −y), as [`AzimuthMap::KLEMS_FRONT`].
    Front,
    /// Axes for light from inside: (−x, y), as [`AzimuthMap::KLEMS_BACK`].
    Back,
}

impl TreeAxes {
    /// Returns the azimuth map of these axes.
    pub const fn azimuth(self) -> AzimuthMap {
        match self {
            Self::Front => AzimuthMap::KLEMS_FRONT,
            Self::Back => AzimuthMap::KLEMS_BACK,
        }
    }

    /// Converts disk coordinates to the tree's axes. An involution: the same for the way back.
    pub(super) fn turn(self, [x, y]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Front => [x, -y],
            Self::Back => [-x, y],
        }
    }

    /// Converts a grid cell between the tree's axes and the façade frame.
    pub(super) const fn turn_cell(self, [ix, iy]: [usize; 2], resolution: usize) -> [usize; 2] {
        match self {
            Self::Front => [ix, resolution - 1 - iy],
            Self::Back => [resolution - 1 - ix, iy],
        }
    }
}

/// Node of a tree in its list form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TreeNode {
    /// Constant q in the whole box. \[1/sr\]
    Leaf(f64),
    /// Index of the first of 2^rank consecutive children.
    Branch(u32),
}

/// Reason why a list of nodes is not a tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum TreeError {
    /// List without nodes.
    #[error("the tree has no nodes")]
    Empty,
    /// Branch that names children that do not follow it or are not in the list.
    #[error("node {0} names children that are not in the list behind it")]
    Children(usize),
    /// Tree finer than any instrument or simulation.
    #[error("the tree is more than {MAX_LEVEL} levels deep")]
    Depth,
    /// Two branches with the same children: what looks small could have more leaves than can be counted.
    #[error("node {0} names children that another node has already")]
    Shared(usize),
    /// Value that is negative or not finite.
    #[error("node {0} holds a value that is negative or not finite")]
    Value(usize),
}

/// BTDF or BRDF as a tensor tree.
#[derive(Debug, Clone, PartialEq)]
pub struct TensorTree {
    rank: TreeRank,
    axes: TreeAxes,
    grid: SquareGrid,
    nodes: Arc<Vec<TreeNode>>,
    /// τ of every finest incident cell: rank 4 the square in the tree's own axes, row by row; rank 3 rings of equal
    /// steps of sinθ from the normal outwards.
    tau: Arc<Vec<f64>>,
}

impl TensorTree {
    /// Creates a tree from nodes, the root first and every branch before its children.
    pub fn new(rank: TreeRank, axes: TreeAxes, nodes: Vec<TreeNode>) -> Result<Self, TreeError> {
        if nodes.is_empty() {
            return Err(TreeError::Empty);
        }
        // 0: nobody's child.
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

    /// Returns the rank.
    pub const fn rank(&self) -> TreeRank {
        self.rank
    }

    /// Returns the orientation of the squares' axes to the façade frame.
    pub const fn axes(&self) -> TreeAxes {
        self.axes
    }

    /// Returns the nodes, root first.
    pub fn nodes(&self) -> &[TreeNode] {
        &self.nodes
    }

    /// Returns the number of leaves.
    pub fn leaves(&self) -> usize {
        self.nodes.iter().filter(|node| matches!(node, TreeNode::Leaf(_))).count()
    }

    /// Returns the finest incident (and emergent) grid in the façade frame.
    pub const fn incident_grid(&self) -> SquareGrid {
        self.grid
    }

    /// Returns the number of cells along one side of the finest incident square. Rank 3 resolves sinθ in half as many
    /// steps.
    pub const fn incident_resolution(&self) -> usize {
        self.grid.resolution()
    }

    /// Returns the directional-hemispherical transmittance for every cell of [`Self::incident_grid`], façade frame.
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

    /// Returns the largest τ of any incident cell.
    pub fn tau_max(&self) -> f64 {
        self.tau.iter().copied().fold(0.0, f64::max)
    }

    /// Returns q of the leaf that holds the two directions; 0 for directions from behind. \[1/sr\]
    pub fn q(&self, incident: Incident, emergent: Emergent) -> f64 {
        let (Some(incident), Some(twin)) = (self.disk(incident.0), self.disk(emergent.through_name())) else {
            return 0.0;
        };
        match self.rank {
            TreeRank::Four => {
                let ([a, b], [c, d]) = (square_from_disk(incident), square_from_disk(twin));
                self.leaf(&[a, b, c, d])
            }
            TreeRank::Three => {
                let [c, d] = square_from_disk(rotate(twin, -incident[1].atan2(incident[0])));
                self.leaf(&[radial_coordinate(incident), c, d])
            }
        }
    }

    /// Returns the directional-hemispherical transmittance of the incident cell that holds the direction.
    pub fn tau(&self, incident: Incident) -> f64 {
        self.disk(incident.0).map_or(0.0, |disk| match self.rank {
            TreeRank::Four => {
                let [ix, iy] = self.grid.position(disk);
                self.tau[iy * self.grid.resolution() + ix]
            }
            TreeRank::Three => self.tau[self.ring(disk)],
        })
    }

    /// Returns the transmittance for uniform luminance.
    pub fn tau_hemispherical(&self) -> f64 {
        match self.rank {
            TreeRank::Four => self.tau.iter().sum::<f64>() / self.tau.len() as f64,
            TreeRank::Three => {
                let n = self.tau.len() as f64;
                self.tau.iter().enumerate().map(|(k, tau)| tau * (2.0 * k as f64 + 1.0) / (n * n)).sum()
            }
        }
    }

    /// Returns directions to list τ by: the centres of Klems' full basis, θ = 0, 10, 20, … 70, 82.5°, azimuths counted
    /// as Klems counts them for light from outside, which is also the way of a front tree's square. Only the centres
    /// matter: τ belongs to the tree's cell that holds them, not to the Klems patch.
    pub fn incident_listing(&self) -> RingBasis {
        RingBasis::klems_full(AzimuthMap::KLEMS_FRONT)
    }

    /// Returns disk coordinates in the tree's axes; `None` from behind.
    pub(super) fn disk(&self, d: Dir<Facade>) -> Option<[f64; 2]> {
        let v = d.vector();
        // The square has a border on the vertical meridian, where suns are often put. Such directions count to the
        // counter-clockwise side, so that rounding of a cosine does not decide.
        let x = if v.x.abs() < 1e-12 && v.y != 0.0 { (-1e-12_f64).copysign(-v.y) } else { v.x };
        (v.z >= -1e-12).then(|| self.axes.turn([x, v.y]))
    }

    /// Returns the ring of equal steps of sinθ that holds a point of the disk.
    pub(super) fn ring(&self, disk: [f64; 2]) -> usize {
        let rings = self.grid.resolution() / 2;
        rings - 1 - ((radial_coordinate(disk) * self.grid.resolution() as f64) as usize).min(rings - 1)
    }

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

    /// Calls `f` for every leaf, with its level and the corner of its box in cells of that level.
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

/// Returns the incident coordinate of rank 3; the small shift puts borders into the ring farther out, as Radiance does.
pub(super) fn radial_coordinate(disk: [f64; 2]) -> f64 {
    (0.5 - 1e-12 - 0.5 * disk[0].hypot(disk[1])).max(0.0)
}

/// Returns a point rotated counter-clockwise.
pub(super) fn rotate([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// Returns the number of the concentric frame, from the centre, in which a grid cell lies.
pub(super) fn frame_of([ix, iy]: [usize; 2], resolution: usize) -> usize {
    let half = resolution / 2;
    let from_centre = |i: usize| if i >= half { i - half } else { half - 1 - i };
    from_centre(ix).max(from_centre(iy))
}

#[cfg(test)]
mod tests;
