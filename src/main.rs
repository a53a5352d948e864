//! Program `cfs`: opens the window, or runs a subcommand of the command line.

use cfs::study::fault;
use clap::Parser as _;
use std::process::ExitCode;

#[cfg(unix)]
#[global_allocator]
static ALLOCATOR: tikv_jemallocator::Jemalloc = tikv_jemallocator::Jemalloc;

#[cfg(not(unix))]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    let arguments = cfs::cli::Arguments::parse();
    // A command reports its own panics, in one sentence.
    fault::watch(arguments.command.is_none());
    let result = cfs::cli::guarded(fault::folder().as_deref(), || match &arguments.command {
        Some(command) => arguments.no_files().and_then(|()| cfs::cli::run(command, arguments.catalogue.as_deref())),
        None => arguments.to_open().and_then(|files| cfs::app::run(arguments.catalogue.as_deref(), files)),
    });
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            cfs::cli::report_error(&error);
            ExitCode::from(cfs::cli::status(&error))
        }
    }
}
