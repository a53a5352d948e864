//! Annual figures of a room: from the illuminances of its hours to figures for daylight, glare and lighting.
//!
//! | file | content |
//! | --- | --- |
//! | `hours` | the illuminances of a year, and which of its hours are occupied |
//! | `autonomy` | daylight autonomy, useful daylight, spatial autonomy, sunlight exposure |
//! | `blinds` | blinds operated by IES LM-83-12's own rule |
//! | `provision` | EN 17037, daylight provision by hours |
//! | `glare` | simplified daylight glare probability |
//! | `probability` | daylight glare probability, its classes |
//! | `lighting` | lighting energy beside daylight |
//! | `transmittance` | directional-hemispherical transmittance of a system for any direction |
//! | `received` | light that an aperture receives, by cell, under one outside after the other |
//! | `solar` | solar energy transmitted directly through apertures, by month and hour |
//!
//! Every definition is that of its edition; where an edition allows two readings, each has its own name.

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

pub use hours::{Light, Step, StepTable};
