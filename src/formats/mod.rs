//! Bytes to compute types and back.
