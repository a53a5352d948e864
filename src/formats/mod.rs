//! Bytes to compute types and back.

pub mod eulumdat;
pub mod ies;
pub mod luminaire;
