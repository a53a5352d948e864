//! Illuminance in a box room: apertures, direct light at sensors near to them, interreflection.

pub mod aperture;
pub mod back_reflection;
pub mod band_weights;
pub mod beam;
pub mod beams_past;
pub mod cell_weights;
pub mod direct;
pub mod exchange;
pub mod first_bounce;
pub mod form_factor;
pub mod gather;
pub mod grid;
pub mod mesh;
pub mod near_field;
pub mod nodes;
pub mod outline;
pub mod patch_weights;
pub mod radiosity;
pub mod sunlit_part;
pub mod through;
