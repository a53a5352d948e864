//! Whole scenes: closed forms, reference cases, what the plan leaves out, extreme input, years of control.

// Layers by the names that the whole program gives them: `cfs::compute` and so on.
extern crate self as cfs;
use cfs_catalogue as catalogue;
use cfs_compute as compute;
use cfs_drawing as drawing;
use cfs_formats as formats;
use cfs_study as study;

mod accuracy;
mod beams_in_cells;
mod coefficients;
#[path = "../common/mod.rs"]
mod common;
mod control;
mod courts;
mod exactness;
mod exchange;
mod glare;
mod ground;
mod luminaire_daylight;
mod luminaire_tiles;
mod method;
mod near_field;
mod outside;
mod plan;
mod rank;
mod reference_kit;
mod rooms;
mod sharp_sun;
mod sky_in_cells;
mod stability;
mod stability_measured;
mod strange;
mod suns_between;
mod surfaces;
mod validation;
mod year_blinds;
mod year_moments;
