//! Light through clear bodies that are endless along x and repeat periodically upwards: prismatic sheets, profiles
//! between panes.
//!
//! The tracing takes place in the section (z outward, y upward) because the direction cosine along x is never changed:
//! in a material of index n the wave vector (k_x, k_y, k_z) of length n keeps k_x, and what is left obeys Snell's law
//! in the plane with the index √(n² − k_x²). Fresnel's equations are those of the true plane of incidence, with the
//! polarisation carried along from surface to surface. Waves are not coherent (no diffraction, no interference) and
//! there is one index: dispersion is left out.
//!
//! A beam is a parallel bundle of finite width. It is split exactly at the edges of the bodies, and divides at every
//! surface into a reflected and a transmitted part, so that parts are chosen at random only where their share is small.

/// Method by which data of clear bodies are computed, as text in the data and in reports.
const METHOD: &str = "section of endless clear bodies, beams followed with their polarisation, both sides averaged by \
                      reciprocity, no dispersion, no interference";

mod beam;
mod hit;
mod model;
mod outline;
mod polarised;
pub mod prism;
pub mod redirecting;
mod section;
mod trace;

pub use outline::{Outline, OutlineError};
pub use polarised::Stokes;
pub use section::{Body, ClearSection, Material};
pub use trace::{Emission, Leaving};
