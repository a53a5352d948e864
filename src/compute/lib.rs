//! Numbers in, numbers out: photometry and numerics without files, windows or clocks.
//!
//! # Rooms, foundations first
//!
//! Each room uses only those before it, and inside a room no two files use each other; `tests/tidy` reads this list.
//!
//! - `limits`: the table of all limits
//! - `angle`: angles and bearings as types
//! - `direction`: directions, frames and what points where
//! - `profile_angle`: directions in the section across slats
//! - `dot`: sums of products
//! - `estimate`: numbers with their error, progress and cancelling
//! - `quadrature`: integrals with errors
//! - `sweep`: several quantities integrated along one variable at once, with errors
//! - `sequence`: random and evenly spread numbers
//! - `scaling`: matrices scaled to given sums, symmetric ones kept so
//! - `polygon`: convex polygons cut, their areas and solid angles
//! - `basis`: divisions of the hemisphere into cells
//! - `wavelet`: compact rows of values on cells
//! - `btdf`: the four functions of a system as data
//! - `surroundings`: boxes and a skyline before the façade, their edges and shadows
//! - `sky`: luminances outside, the sun and its disc
//! - `weather`: the weather of a place, interval by interval, with sun and light
//! - `system`: described systems, a room a family, and the goniophotometer that makes data of them
//! - `incidence`: between incident directions
//! - `doctor`: faults of data and their repair
//! - `lid`: the aperture as a luminaire
//! - `room`: apertures, direct light and interreflection
//! - `glare`: what an eye sees of apertures, and how much that disturbs
//! - `sunlight`: hours of sun on an opening, the view out of it
//! - `control`: which state a moving system takes
//! - `year`: what the illuminances of a year come to
//! - `rank`: which of many is best, as far as figures with errors tell
//!
//! # Symbols
//!
//! | symbol | identifier | unit | meaning |
//! | --- | --- | --- | --- |
//! | q | `q`, luminance coefficient | 1/sr | luminance leaving per illuminance arriving (eq 2) |
//! | τ | `tau` | – | directional-hemispherical transmittance (eq 1) |
//! | E | `illuminance` | lx | |
//! | L | `luminance` | cd/m² | |
//! | I | `intensity` | cd | eq 5 |
//! | Φ | `flux` | lm | |
//! | ω_e | [`direction::Incident`] | | towards the source |
//! | ω_a | [`direction::Emergent`] | | where light goes |
//! | PΩ | `projected_solid_angle` | sr | ∫cosθ dω of a cell |
//! | γ | `altitude` | rad | above the horizon |
//!
//! Equation numbers are those of the IEA SHC Task 31 report of 2005. Everything is SI; angles are radians inside.

#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::disallowed_methods))]

// Layers have these names in all crates.
use crate as compute;

pub mod angle;
pub mod basis;
pub mod btdf;
pub mod control;
pub mod direction;
pub mod doctor;
pub mod dot;
pub mod estimate;
pub mod glare;
pub mod incidence;
pub mod lid;
pub mod limits;
pub mod polygon;
pub mod profile_angle;
pub mod quadrature;
pub mod rank;
pub mod room;
pub mod scaling;
pub mod sequence;
pub mod sky;
pub mod sunlight;
pub mod surroundings;
pub mod sweep;
pub mod system;
pub mod wavelet;
pub mod weather;
pub mod year;
