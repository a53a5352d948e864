//! Command line of the program: subcommands that read and write files and tables, without a display.

/// Prints a message on standard error, with the arguments of `eprintln!`.
macro_rules! report {
    ($($text:tt)*) => { $crate::cli::output::to_stderr(format_args!($($text)*)) };
}

pub mod accuracy;
mod accuracy_rank;
mod accuracy_year;
mod args;
mod builtin;
pub mod catalogue;
pub mod check;
pub mod compact;
pub mod compare;
pub mod control;
pub mod convert;
mod dataset_file;
mod fault;
pub mod goniophotometer;
pub mod importing;
pub mod info;
pub mod keeping;
mod language;
pub mod lid;
mod lid_summary;
pub mod like;
mod limits;
pub mod listing;
mod luminaire_info;
mod output;
pub mod packages;
pub mod picture;
mod progress;
pub mod rank;
mod rank_csv;
mod rank_json;
mod rank_merge;
pub mod repair;
pub mod report;
pub mod room;
pub mod sky;
pub mod subscriptions;
mod system_info;
pub mod validate;
mod weather_info;
mod writing;
pub mod year;
mod year_json;

pub use args::{Arguments, Command};
pub use fault::{Stopped, guarded};
pub use output::report_error;
pub use writing::Over;

use crate::catalogue::default_path;
use crate::study::{Library, files};
use std::path::Path;

/// Runs a subcommand.
///
/// # Errors
/// Returns an error of one line: the file, the position in it, what is wrong, and what was expected.
pub fn run(command: &Command, catalogue: Option<&Path>) -> anyhow::Result<()> {
    // The catalogue is an input of the results, wherever it is opened.
    if let Some(path) = catalogue.map(Path::to_owned).or_else(|| default_path().ok()) {
        files::keep(&path);
    }
    let library = Library::with_catalogue(catalogue);
    match command {
        Command::Room(args) => room::run(args, &library),
        Command::Accuracy(args) => accuracy::run(args, &library),
        Command::Compare(args) => compare::run(args, &library),
        Command::Lid(args) => lid::run(args, &library),
        Command::Picture(args) => picture::run(args, &library),
        Command::Report(args) => report::run(args, &library),
        Command::Sky(args) => sky::run(args),
        Command::Goniophotometer(args) => goniophotometer::run(args, &library),
        Command::Control(args) => control::run(args, &library),
        Command::Year(args) => year::run(args, &library),
        Command::Rank(args) => rank::run(args, &library),
        Command::Info(args) => info::run(args, &library),
        Command::Convert(args) => convert::run(args),
        Command::Compact(args) => compact::run(args),
        Command::Repair(args) => repair::run(args),
        Command::Catalogue(args) => catalogue::run(args, catalogue),
        Command::Limits => limits::run(),
    }
}

/// Whether an error is a negative result about data that were read (exit status 1), not a failed operation.
fn is_judgement(error: &anyhow::Error) -> bool {
    error.is::<validate::NotFit>() || error.is::<packages::Differ>() || error.is::<check::Damaged>()
}

/// Returns the exit status of the program: 1 if data were read but are not fit for use, differ or are damaged; 2 if an
/// operation failed; 101 after an internal error (panic).
pub fn status(error: &anyhow::Error) -> u8 {
    if error.is::<Stopped>() {
        101
    } else if is_judgement(error) {
        1
    } else {
        2
    }
}
