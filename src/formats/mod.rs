//! Bytes to compute types and back.
pub mod scan;
