//! Requested shape of a tree, and the report on the tree made.

use crate::compute::basis::SquareGrid;
use crate::compute::btdf::tensor_tree::{TensorTree, TreeError, TreeRank};
use crate::compute::btdf::{Btdf, Scattered};

/// Level of the finest tree of rank 4: 2⁶ steps per coordinate, 16.8 million boxes before pruning. Chosen: limit of
/// memory (134 MB); finer ones are refused.
pub const MOST_LEVEL_4: u32 = 6;
/// Level of the finest tree of rank 3: 2⁸ steps per coordinate, 16.8 million boxes before pruning. Chosen: limit of
/// memory (134 MB); finer ones are refused.
pub const MOST_LEVEL_3: u32 = 8;

/// Requested shape of a tree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TreeShape {
    /// Rank: the number of coordinates.
    pub rank: TreeRank,
    /// Number of finest steps of a coordinate, as log₂.
    pub level: u32,
    /// Largest share of the light that merging boxes may misplace, 0 … 1.
    pub tolerance: f64,
}

/// Tree, and its differences from its source.
#[derive(Debug, Clone, PartialEq)]
pub struct OnTree {
    /// Tree that was made.
    pub tree: TensorTree,
    /// Share of the grid's light that merging boxes misplaced.
    pub misplaced: f64,
    /// Largest change of τ that merging made at any finest incident cell.
    pub tau_change: f64,
    /// Share of the light by which single azimuths of incidence differ from the mean that a tree of rank 3 keeps.
    pub turned: f64,
}

/// Reason why a function cannot be made a tree of the requested shape.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum OnTreeError {
    /// Level too coarse or too fine.
    #[error("a tree of level {level}; expected 1 … {most} for rank {rank}")]
    Level {
        /// Requested level.
        level: u32,
        /// Maximum level for the rank.
        most: u32,
        /// Number of coordinates of the requested tree.
        rank: usize,
    },
    /// Tolerance that is not a share.
    #[error("a tolerance of {0}; expected a share of the light, 0 … 1")]
    Tolerance(f64),
    /// Tree larger than any reader takes.
    #[error("a tree of more than {most} nodes; expected a coarser level or a larger tolerance")]
    Size {
        /// Maximum number of nodes.
        most: usize,
    },
    /// Values that no tree can hold.
    #[error(transparent)]
    Tree(#[from] TreeError),
}

impl TreeShape {
    /// Returns the finest level that is made for a rank.
    pub const fn most_level(rank: TreeRank) -> u32 {
        match rank {
            TreeRank::Four => MOST_LEVEL_4,
            TreeRank::Three => MOST_LEVEL_3,
        }
    }

    /// Returns the coarsest level whose cells are about a quarter of the source's, at most 6.
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
