//! Numbers in, numbers out: photometry and numerics without files, windows or clocks.
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

pub mod angle;
pub mod basis;
pub mod btdf;
pub mod control;
pub mod dielectric;
pub mod direction;
pub mod doctor;
pub mod estimate;
pub mod goniophotometer;
pub mod incidence;
pub mod lid;
pub mod polygon;
pub mod quadrature;
pub mod room;
pub mod scaling;
pub mod section;
pub mod sequence;
pub mod sky;
pub mod system;
pub mod wavelet;
