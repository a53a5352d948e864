//! The command line.
pub mod sky;
