//! Requested shape of a tensor tree, and the resulting tree with its differences from the source.

use crate::compute::basis::SquareGrid;
use crate::compute::btdf::tensor_tree::{TensorTree, TreeError, TreeRank};
use crate::compute::btdf::{Btdf, Scattered};

/// Level of the finest tree of rank 4: 2⁶ steps per coordinate, 16.8 million boxes before pruning. Chosen: limit of
/// memory (134 MB); finer ones are refused.
pub const MOST_LEVEL_4: u32 = 6;
/// Level of the finest tree of rank 3: 2⁸ steps per coordinate, 16.8 million boxes before pruning. Chosen: limit of
/// memory (134 MB); finer ones are refused.
pub const MOST_LEVEL_3: u32 = 8;

/// Requested rank, resolution and accuracy of a tensor tree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TreeShape {
    /// Rank of the tree.
    pub rank: TreeRank,
    /// Level of the finest boxes: log₂ of the number of steps of each coordinate.
    pub level: u32,
    /// Maximum share of the flux whose direction may change by the merging of boxes, 0 … 1.
    pub tolerance: f64,
}

/// Tensor tree converted from another BTDF or BRDF, with its differences from the source.
#[derive(Debug, Clone, PartialEq)]
pub struct OnTree {
    /// Resulting tree.
    pub tree: TensorTree,
    /// Share of the flux of the full grid whose direction was changed by the merging of boxes.
    pub misplaced: f64,
    /// Largest change of τ of any finest incident cell by the merging of boxes.
    pub tau_change: f64,
    /// Share of the flux by which single azimuths of incidence differ from their mean, which a tree of rank 3 stores; 0
    /// for rank 4.
    pub turned: f64,
}

/// Error of a conversion to a tensor tree of the requested shape.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum OnTreeError {
    /// Level outside the allowed range.
    #[error("a tree of level {level}; expected 1 … {most} for rank {rank}")]
    Level {
        /// Requested level.
        level: u32,
        /// Maximum level for this rank.
        most: u32,
        /// Number of coordinates of the requested tree.
        rank: usize,
    },
    /// Tolerance outside 0 … 1.
    #[error("a tolerance of {0}; expected a share of the light, 0 … 1")]
    Tolerance(f64),
    /// Tree with more nodes than readers of files accept.
    #[error("a tree of more than {most} nodes; expected a coarser level or a larger tolerance")]
    Size {
        /// Maximum number of nodes.
        most: usize,
    },
    /// Values that are not valid in a tensor tree.
    #[error(transparent)]
    Tree(#[from] TreeError),
}

impl TreeShape {
    /// Returns the maximum level of trees of a rank.
    pub const fn most_level(rank: TreeRank) -> u32 {
        match rank {
            TreeRank::Four => MOST_LEVEL_4,
            TreeRank::Three => MOST_LEVEL_3,
        }
    }

    /// Returns the suggested level for a conversion: the coarsest whose cells are about a quarter of those of the
    /// source, at most 6.
    pub fn level_for(btdf: &Btdf) -> u32 {
        let cells = match &btdf.scattered {
            Some(Scattered::Tree(tree)) => return tree.incident_grid().level().min(MOST_LEVEL_4),
            Some(Scattered::Cells(matrix)) => matrix.incident().len().max(matrix.emergent().len()),
            Some(Scattered::Directions(data)) => data.incident().len().max(data.emergent().len()),
            Some(Scattered::Lambert(_)) | None => 145,
        };
        (1..MOST_LEVEL_4).find(|level| 1_usize << (2 * level) >= 4 * cells).unwrap_or(MOST_LEVEL_4)
    }

    pub(super) fn check(self) -> Result<SquareGrid, OnTreeError> {
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
