//! Shading control of a product with several states: the study's module, as the window uses it.

pub use crate::study::product_control::*;
