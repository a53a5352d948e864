//! The catalogue's file, its exchange, and the products built in.

// Layers by the names that the whole program gives them: `cfs::compute` and so on.
extern crate self as cfs;
use cfs_catalogue as catalogue;
use cfs_compute as compute;
use cfs_formats as formats;
use cfs_study as study;

mod assets;
mod builtin;
mod collections;
#[path = "../common/mod.rs"]
mod common;
mod datasets;
mod described;
mod families;
mod health;
mod history;
mod keeping;
mod packages;
mod search;
mod whole;
