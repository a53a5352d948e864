//! A year in a room as figures: from the illuminances of its hours to what is asked of daylight, glare and lighting.
//!
//! | file | what |
//! | --- | --- |
//! | `hours` | the illuminances of a year, and which of its hours are occupied |
//! | `autonomy` | daylight autonomy, useful daylight, spatial autonomy, sunlight exposure |
//! | `blinds` | blinds worked by IES LM-83-12's own rule |
//! | `provision` | EN 17037, daylight provision by hours |
//! | `glare` | simplified daylight glare probability |
//! | `probability` | daylight glare probability, its classes |
//! | `lighting` | what lamps take beside daylight |
//! | `transmittance` | what a system lets through from any direction, as one figure |
//! | `received` | what an aperture receives, by cell, under one outside after the other |
//! | `solar` | solar energy straight through apertures, by month and hour |
//!
//! Every definition is that of its edition; where an edition leaves two readings, both have names of their own.

pub mod autonomy;
pub mod blinds;
pub mod glare;
mod hours;
pub mod lighting;
pub mod probability;
pub mod provision;
pub mod received;
pub mod solar;
pub mod transmittance;

pub use hours::{Light, Step};
