//! Divisions of the hemisphere into cells: one type for every lattice made of rings about the normal
//! (Klems, Tregenza, measured rings, equal-area rings), and the resampling from one to another.

mod rings;

pub use rings::{AzimuthMap, BasisError, Cell, Ring, RingBasis};
