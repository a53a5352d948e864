//! Divisions of the hemisphere into cells: one type for all bases of rings about the normal (Klems, Tregenza, measured
//! rings, equal-area rings), the square grid of tensor trees, and the resampling from one basis to another.

mod neighbours;
mod resample;
mod rings;
mod shirley_chiu;
mod sub_directions;

pub use neighbours::Neighbours;
pub use resample::{Resampling, same_cells};
pub use rings::{AzimuthMap, BasisError, Cell, Ring, RingBasis};
pub use shirley_chiu::{MAX_LEVEL, SquareCell, SquareGrid, disk_from_square, square_from_disk};
pub use sub_directions::{cell_mean, sub_directions};
