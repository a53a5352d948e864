//! The description that a dataset was computed from.
//!
//! Cells say where light goes only as finely as they are; what a described system does to a beam is computed again from
//! its description, for any sun. Here it is text that goes with the data: nothing in `compute` reads it.

/// A description and the state of it that a dataset holds.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct DescribedState {
    /// Text of a system file (`.system.toml`) that names no other files: a stack holds its layers itself.
    pub text: String,
    /// Key of the state within the description; empty for a system without states.
    pub state: String,
}
