//! Pictures that need no window: lines, areas and text, written as SVG, as PNG or (by `cfs-report`) as PDF; and the
//! content of plots, for these drawings ([`chart`]) and for the window. Pure: numbers in, shapes, text and bytes out.
//!
//! Positions and lengths are in *drawing units*, x to the right and y down from the upper left corner of the paper. A
//! unit is one pixel by default; files for print state its size in mm. Text is set in DejaVu Sans ([`font`]), whose
//! widths are known here, so that SVG, PNG and PDF agree.

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
