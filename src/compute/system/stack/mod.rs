//! Stacks of layers one behind the other, with all reflections between them.

mod adding;
mod data;
mod flows;
mod halves;
mod layers;
mod passage;
mod single;

pub use adding::Stack;
pub use data::DataLayer;
pub use layers::{Layer, LayerSource};
