//! Layers one behind the other.

mod adding;
mod data;
mod halves;
mod layers;

pub use adding::Stack;
pub use data::DataLayer;
pub use layers::{Layer, LayerSource};
