//! placeholder

pub mod compute;

pub mod study;
