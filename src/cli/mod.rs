//! The command line.

pub mod lid;
