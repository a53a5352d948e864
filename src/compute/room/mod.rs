//! Light in a box room: apertures, the near field at a sensor, interreflection.

pub mod aperture;
pub mod cell_weights;
pub mod polygon;
pub mod through;
