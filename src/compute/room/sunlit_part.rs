//! Sunlit part of an aperture among boxes.

use super::aperture::Aperture;
use super::beams_past::{lit, lit_by_rim};
use super::grid::Grid;
use super::nodes::Nodes;
use crate::compute::lid::Facing;
use crate::compute::surroundings::Surroundings;
use glam::DVec3;
use std::sync::OnceLock;

/// Share of an aperture in the sun below which none of it counts as sunlit: rounding of areas that are cut, far below
/// any stated error.
const NOTHING: f64 = 1e-9;

/// Sunlit part of an aperture, with quantities derived from it that are computed on first use.
#[derive(Debug)]
pub struct SunlitPart {
    /// Convex pieces in the room frame. \[m\]
    pub pieces: Vec<Vec<DVec3>>,
    /// Sunlit share of the aperture's area.
    pub share: f64,
    rim: OnceLock<Vec<Vec<Vec<DVec3>>>>,
    on: OnceLock<[Vec<f64>; 2]>,
}

impl SunlitPart {
    /// Finds the part that the middle of the sun's disc reaches.
    pub fn new(aperture: &Aperture, facing: &Facing<'_>, around: &Surroundings) -> Self {
        let (pieces, share) = lit(aperture, facing, around);
        Self { pieces, share, rim: OnceLock::new(), on: OnceLock::new() }
    }

    /// Returns whether the sunlit part is negligible.
    pub fn is_dark(&self) -> bool {
        self.share <= NOTHING
    }

    /// Returns whether the sunlit part is the whole aperture, up to a negligible rest.
    pub fn is_whole(&self) -> bool {
        self.share >= 1.0 - NOTHING
    }

    /// Returns the pieces that points of the disc's rim reach; arguments as for [`Self::new`].
    pub fn rim(&self, aperture: &Aperture, facing: &Facing<'_>, around: &Surroundings) -> &[Vec<Vec<DVec3>>] {
        self.rim.get_or_init(|| lit_by_rim(aperture, facing, around))
    }

    /// Returns the sunlit shares of what the points of a grid and the nodes on the aperture represent. Grid and nodes
    /// must be the same in all calls.
    pub fn on(&self, grid: &Grid, nodes: &Nodes) -> &[Vec<f64>; 2] {
        self.on.get_or_init(|| [grid.lit(&self.pieces), nodes.lit(&self.pieces)])
    }
}
