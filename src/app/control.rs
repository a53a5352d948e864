//! What control does with a moving product: the study's, as the window uses it.

pub use crate::study::product_control::*;
