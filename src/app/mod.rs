//! The window: catalogue on the left, tile area in the middle, scene on the right; everything linked, nothing modal.
//!
//! Each feature is a folder ([`catalogue`], [`import`], [`compare`], [`year`], [`rank`], [`goniophotometer`], [`export`],
//! [`tour`], …) with its state, its commands and what they do; it works on the [`shell::Shell`], which holds what all
//! share. [`window::App`] composes them.
//!
//! Drawing ([`panels`], [`tiles`], [`views`]) reads [`state::State`] and returns [`command::Command`]s; [`apply`] hands
//! them to their features; [`results`] asks for whatever a change affects, and [`outcomes`] hands the results of jobs to
//! the features that asked. Nothing here waits.

pub mod apply;
pub mod catalogue;
pub mod command;
pub mod compare;
pub mod desktop;
pub mod display;
pub mod export;
pub mod frame;
pub mod goniophotometer;
pub mod import;
pub mod offer;
pub mod outcomes;
pub mod paint;
pub mod palette;
pub mod panels;
pub mod rank;
pub mod results;
pub mod scene;
pub mod session;
pub mod shell;
pub mod state;
pub mod tiles;
pub mod title;
pub mod tour;
pub mod views;
pub mod window;
pub mod year;

pub use desktop::run;
pub use shell::Services;
pub use window::App;
