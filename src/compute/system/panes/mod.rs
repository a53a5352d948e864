//! Plane-parallel panes: clear, absorbing and coated, one behind the other with air between.

pub mod coated;
pub mod glazing;
mod measure;
mod pane_stack;

pub use measure::Panes;
pub use pane_stack::PaneStack;
