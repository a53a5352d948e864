//! The command line.

pub mod lid;
pub mod sky;
