//! `cfs`: without a subcommand the window, with one the command line.

use clap::Parser as _;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = cfs::cli::Arguments::parse();
    let result = match &arguments.command {
        Some(command) => arguments.no_files().and_then(|()| cfs::cli::run(command, arguments.catalogue.as_deref())),
        None => arguments.to_open().and_then(|files| cfs::app::run(arguments.catalogue.as_deref(), files)),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            cfs::cli::tell_error(&error);
            // 1: read and judged, but not fit for use, or different; 2: anything that could not be done.
            ExitCode::from(if cfs::cli::is_judgement(&error) { 1 } else { 2 })
        }
    }
}
