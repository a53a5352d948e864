//! Parts of the computation by themselves: skies, systems measured numerically, the compact form, ways between
//! incident directions, the report's figures.

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
