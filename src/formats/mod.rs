//! Bytes to compute types and back.

pub mod dataset_blob;
pub mod package;
