//! The window.

pub mod paint;
pub mod views;
