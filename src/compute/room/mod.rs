//! Light in a box room: apertures, the near field at a sensor, interreflection.

pub mod aperture;
pub mod cell_weights;
pub mod form_factor;
pub mod mesh;
pub mod polygon;
pub mod radiosity;
pub mod sun_disc;
pub mod through;
