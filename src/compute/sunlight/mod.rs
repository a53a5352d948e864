//! Openings by EN 17037:2018+A1:2021: hours of exposure to sunlight, and view out.
//!
//! | file | contents |
//! | --- | --- |
//! | `exposure` | exposure to sunlight on a cloudless day |
//! | `view_out` | sight angle, distance and layers of the view |
//!
//! The standard's own text was not at hand: the levels are those of its public summaries.

pub mod exposure;
pub mod view_out;
