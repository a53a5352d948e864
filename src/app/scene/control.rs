//! Shading control of a product with several states: re-export of the study's module.

pub use crate::study::product_control::*;
