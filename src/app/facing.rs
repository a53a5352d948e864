//! Directions relative to the scene's façade or roof: the study's module, as the window uses it.

pub use crate::study::facing::*;
