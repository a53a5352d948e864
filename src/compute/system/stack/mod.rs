//! Layers one behind the other.

mod adding;
mod halves;
mod layers;

pub use adding::{DataLayer, Stack};
pub use layers::{Layer, LayerSource};
