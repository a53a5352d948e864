//! Computation: photometry and numerics without files, windows or clocks.
//!
//! # Rooms, foundations first
//!
//! Each room uses only those before it, and inside a room no two files use each other; `tests/tidy` reads this list.
//!
//! - `limits`: the table of all limits
//! - `angle`: angles and bearings as types
//! - `direction`: directions and their frames
//! - `profile_angle`: directions in the section across slats
//! - `dot`: sums of products
//! - `estimate`: numbers with their error, progress and cancelling
//! - `quadrature`: integrals with errors
//! - `sweep`: several quantities integrated along one variable at once, with errors
//! - `sequence`: random and evenly spread numbers
//! - `scaling`: symmetric matrices scaled to given sums
//! - `polygon`: convex polygons cut, their areas and solid angles
//! - `basis`: divisions of the hemisphere into cells
//! - `wavelet`: compact rows of values on cells
//! - `btdf`: BSDF data of a system, its four functions
//! - `surroundings`: boxes and a skyline in front of the façade, their edges and shadows
//! - `sky`: luminances outside, the sun and its disc
//! - `weather`: the weather of a place, interval by interval, with sun and light
//! - `system`: described systems, one room per family, and the virtual goniophotometer that computes data of them
//! - `incidence`: interpolation between incident directions
//! - `doctor`: data checks and repairs
//! - `lid`: the aperture as a luminaire
//! - `room`: apertures, direct light and interreflection
//! - `glare`: glare of an observer by apertures and the sun
//! - `sunlight`: hours of sun on an aperture, the view out of it
//! - `control`: shading control, the choice of a system's state
//! - `year`: annual figures from the illuminances of a year
//! - `rank`: ranking by figures with errors
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
//! | ω_a | [`direction::Emergent`] | | in which light leaves |
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
