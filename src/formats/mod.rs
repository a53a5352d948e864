//! Bytes to compute types and back.

pub mod drawing;
pub mod eulumdat;
pub mod ies;
pub mod lid_tables;
pub mod luminaire;
pub mod scan;
