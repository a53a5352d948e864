//! Pictures that need no window: lines, areas and text, written as SVG, as PNG or (by `cfs-report`) as PDF, and what
//! plots show, for these drawings ([`chart`]) as for the window. Pure: numbers in, shapes, text and bytes out.
//!
//! Coordinates are units of the drawing, x right, y down; files state the size of a unit. Text is set in DejaVu Sans
//! ([`font`]), whose widths are known here, so that SVG, PNG and PDF agree.

#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::disallowed_methods))]

// Layers have these names in all crates.
use cfs_compute as compute;
use cfs_texts as texts;

pub mod chart;
pub mod colours;
pub mod contour;
pub mod flux_split;
pub mod font;
pub mod hemisphere;
pub mod hour_map;
pub mod legend;
pub mod lid_curves;
mod paper;
pub mod plot;
mod raster;
pub mod shape;
mod svg;
pub mod thumbnail;
pub mod ticks;

pub use paper::{Drawing, missing_characters};
pub use shape::{Align, Frame, Point, Rgb, Shape, TEXT, circle};
