//! The catalogue's file, its exchange, and the products built in.

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
