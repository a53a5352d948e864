//! How fine a tree is asked for, and what is told of one.

use crate::compute::basis::SquareGrid;
use crate::compute::btdf::tensor_tree::{TensorTree, TreeError, TreeRank};
use crate::compute::btdf::{Btdf, Scattered};

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
