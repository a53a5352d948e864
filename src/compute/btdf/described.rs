//! Description that a dataset was computed from.
//!
//! Cells resolve directions only as finely as they are; how a described system redirects a beam is computed again from
//! its description, for any sun. Here it is text that goes with the data: nothing in `compute` reads it.

/// Description, and the state of it that a dataset holds.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct DescribedState {
    /// Text of a system file (`.system.toml`) that names no other files: a stack holds its layers itself.
    pub text: String,
    /// Key of the state within the description; empty for a system without states.
    pub state: String,
}
