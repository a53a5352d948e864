//! Description of the system from which a dataset was computed.
//!
//! The cells of a dataset blur beams to their size; from the description the redirection of beams can be computed again
//! exactly, for any direction of the sun. Here the description is only text that is stored with the data: nothing in
//! `compute` reads it.

/// Description of a system, and the state of it that a dataset holds.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct DescribedState {
    /// Text of a system file (`.system.toml`) without references to other files: a stack contains its layers.
    pub text: String,
    /// Key of the state in the description; empty for a system without states.
    pub state: String,
}
