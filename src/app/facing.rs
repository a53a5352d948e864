//! Directions as the scene's façade or roof sees them: the study's, as the window uses it.

pub use crate::study::facing::*;
