//! Sunlit part of an aperture that obstructions shade.

use super::aperture::Aperture;
use super::beams_past::{lit, lit_by_rim};
use super::grid::Grid;
use super::nodes::Nodes;
use crate::compute::lid::Facing;
use crate::compute::surroundings::Surroundings;
use glam::DVec3;
use std::sync::OnceLock;

/// Sunlit share of an aperture below which it counts as wholly shaded: rounding of areas, far below any stated error.
const NOTHING: f64 = 1e-9;

/// Sunlit part of an aperture that obstructions shade, with derived quantities that are computed on first use.
#[derive(Debug)]
pub struct SunlitPart {
    /// Convex pieces of the sunlit part, by their corners in the room's frame. \[m\]
    pub pieces: Vec<Vec<DVec3>>,
    /// Sunlit share of the aperture's area, 0 … 1.
    pub share: f64,
    rim: OnceLock<Vec<Vec<Vec<DVec3>>>>,
    on: OnceLock<[Vec<f64>; 2]>,
}

impl SunlitPart {
    /// Computes the part of an aperture that is sunlit for the centre of the sun's disc. `facing`: sun and orientation;
    /// `around`: obstructions.
    pub fn new(aperture: &Aperture, facing: &Facing<'_>, around: &Surroundings) -> Self {
        let (pieces, share) = lit(aperture, facing, around);
        Self { pieces, share, rim: OnceLock::new(), on: OnceLock::new() }
    }

    /// Whether the sunlit part is negligible.
    pub fn is_dark(&self) -> bool {
        self.share <= NOTHING
    }

    /// Whether the sunlit part is the whole aperture, except for a negligible rest.
    pub fn is_whole(&self) -> bool {
        self.share >= 1.0 - NOTHING
    }

    /// Returns the convex sunlit pieces for each of four points on the rim of the sun's disc, room's frame \[m\]. The
    /// arguments are those of [`Self::new`].
    pub fn rim(&self, aperture: &Aperture, facing: &Facing<'_>, around: &Surroundings) -> &[Vec<Vec<DVec3>>] {
        self.rim.get_or_init(|| lit_by_rim(aperture, facing, around))
    }

    /// Returns the sunlit share of the area of the aperture that each grid point and each node represents. Grid and
    /// nodes must be the same in all calls.
    pub fn on(&self, grid: &Grid, nodes: &Nodes) -> &[Vec<f64>; 2] {
        self.on.get_or_init(|| [grid.lit(&self.pieces), nodes.lit(&self.pieces)])
    }
}
