//! Drawing shared by several tiles: colour scales, hemispheres, polar axes, plots, cameras. It contains no photometry
//! beyond the projections of a hemisphere.

pub mod body;
pub mod camera;
pub mod colour_scale;
pub mod frozen;
pub mod hemisphere;
pub mod hour_map;
pub mod palette;
pub mod plot;
pub mod polar;
pub mod polygon;
pub mod tile;

pub use crate::drawing::contour;
