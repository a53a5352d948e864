//! The command line.

pub mod catalogue;
pub mod convert;
pub mod dataset_file;
pub mod info;
