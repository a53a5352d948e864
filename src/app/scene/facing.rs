//! Directions relative to the scene's façade or roof: re-export of the study's module.

pub use crate::study::facing::*;
