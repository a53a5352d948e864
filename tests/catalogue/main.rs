//! The catalogue's file, its exchange, and the products built in.

mod assets;
mod catalogue;
mod datasets;
mod described;
mod packages;
mod search;
