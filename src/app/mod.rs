//! The window: catalogue on the left, bench in the middle, scene on the right; everything linked, nothing modal.
//!
//! Drawing ([`panels`], [`tiles`], [`views`]) reads [`state::State`] and returns [`command::Command`]s; [`apply`] acts on
//! them; [`work`] asks for whatever a change affects, and [`outcomes`] takes in what comes back. Nothing here waits.

pub mod apply;
pub mod arrange;
mod asking;
pub mod at_work;
pub mod autosave;
pub mod backend;
pub mod changes;
pub mod clock;
pub mod command;
pub mod compare;
pub mod compare_columns;
pub mod comparing;
pub mod control;
pub mod dialogs;
pub mod disk;
mod docking;
mod due;
pub mod editing;
pub mod engine;
pub mod error;
pub mod examples;
pub mod export;
pub mod facing;
pub mod frame;
pub mod goniophotometer;
pub mod hand_on;
pub mod hand_on_files;
pub mod handing_on;
pub mod import;
pub mod import_arranging;
pub mod import_steps;
pub mod import_table;
pub mod importing;
pub mod incidence;
pub mod jobs;
pub mod keeping;
pub mod measuring;
pub mod messages;
pub mod moment;
pub mod naming;
pub mod offer;
pub mod outcomes;
pub mod paint;
pub mod panels;
pub mod reading;
pub mod restoring;
pub mod room_look;
pub mod safe_name;
pub mod scene;
pub mod session;
pub mod shelf;
pub mod shelf_library;
pub mod state;
pub mod theme;
pub mod tiles;
pub mod title;
pub mod typing;
pub mod views;
pub mod window;
pub mod work;
pub mod writing;

pub use frame::run;
pub use window::{App, Services};
