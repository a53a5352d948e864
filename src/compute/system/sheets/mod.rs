//! Thin sheets: diffusers, fabrics, perforated and expanded metal.

pub mod diffuser;
mod hole;
mod holes;
mod lobe;
mod perforated;
pub mod sheet;
mod walls;
mod woven;

pub use diffuser::Diffuser;
pub use hole::{Hole, Perforated};
pub use woven::Woven;
