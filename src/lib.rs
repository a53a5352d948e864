//! placeholder

pub mod app;
pub mod catalogue;
pub mod cli;
pub mod compute;
pub mod formats;
pub mod study;
