//! Drawing that several tiles share: colour scales, hemispheres, polar axes, charts, iso-lines, ticks.
//! Nothing here knows photometry beyond the projections of a hemisphere.

pub mod chart;
pub mod colour_scale;
pub mod contour;
pub mod drawing;
pub mod hemisphere;
pub mod palette;
pub mod polar;
pub mod polygon;
pub mod ticks;
pub mod tile;
