//! Export of pictures of the tiles and of reports as PDF. Functions take results and return bytes; they use neither
//! files nor the window.
//!
//! A tile's picture is a [`Drawing`](crate::drawing::Drawing) made from a [`Subject`](crate::study::subject::Subject),
//! so that window and command line export the same, whatever the window's size and theme. A report is pages of such
//! drawings.

#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::disallowed_methods))]

// Layers have these names in all crates.
use cfs_catalogue as catalogue;
use cfs_compute as compute;
use cfs_drawing as drawing;
use cfs_study as study;
use cfs_texts as texts;

pub mod comparison;
mod error;
pub mod pages;
pub mod pdf;
pub mod picture;
pub mod product;
pub mod size;
pub mod study_report;
pub mod table;
pub mod tender;
pub mod tiles;
pub mod words;

pub use error::ReportError;
pub use picture::{Look, Origin, picture};
pub use size::Size;
pub use tiles::TileKind;
