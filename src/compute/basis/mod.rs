//! Divisions of the hemisphere into cells: one type for every lattice made of rings about the normal
//! (Klems, Tregenza, measured rings, equal-area rings), and the resampling from one to another.

mod resample;
mod rings;
mod shirley_chiu;

pub use resample::{Resampling, resample_matrix, same_cells};
pub use rings::{AzimuthMap, BasisError, Cell, Ring, RingBasis};
pub use shirley_chiu::{MAX_LEVEL, SquareCell, SquareGrid, disk_from_square, square_from_disk};
