//! Parts of the computation by themselves: skies, systems measured numerically, the compact form, ways between
//! incident directions, the report's figures.

// Layers by the names that the whole program gives them: `cfs::compute` and so on.
extern crate self as cfs;
use cfs_catalogue as catalogue;
use cfs_compute as compute;
use cfs_formats as formats;
use cfs_study as study;

mod beams;
#[path = "../common/mod.rs"]
mod common;
mod compact;
mod compact_tree;
mod figures;
mod goniophotometer_glass;
mod goniophotometer_slats;
mod incidence_schemes;
mod sky;
mod weather;
