//! The command line: arguments in, files and tables out, no display needed.

pub mod accuracy;
mod args;
mod builtin;
pub mod catalogue;
pub mod compact;
pub mod control;
pub mod convert;
mod dataset_file;
pub mod goniophotometer;
pub mod info;
pub mod lid;
mod luminaire_info;
mod output;
pub mod packages;
mod progress;
pub mod repair;
pub mod room;
pub mod sky;
pub mod validate;
mod weather_info;

pub use args::{Arguments, Command};

use crate::study::Library;
use std::path::Path;

/// Runs a subcommand.
///
/// # Errors
/// One line that names the file, the place in it, what is wrong and what would be right.
pub fn run(command: &Command, catalogue: Option<&Path>) -> anyhow::Result<()> {
    let library = Library::with_catalogue(catalogue);
    match command {
        Command::Room(args) => room::run(args, &library),
        Command::Accuracy(args) => accuracy::run(args, &library),
        Command::Lid(args) => lid::run(args, &library),
        Command::Sky(args) => sky::run(args),
        Command::Goniophotometer(args) => goniophotometer::run(args, &library),
        Command::Control(args) => control::run(args, &library),
        Command::Info(args) => info::run(args),
        Command::Convert(args) => convert::run(args),
        Command::Compact(args) => compact::run(args),
        Command::Repair(args) => repair::run(args),
        Command::Catalogue(args) => catalogue::run(args, catalogue),
    }
}
