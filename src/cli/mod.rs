//! The command line.

pub mod lid;
mod output;
pub mod sky;
