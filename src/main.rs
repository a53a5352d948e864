//! Starts the command line.

use cfs::cli::{convert, info};
use clap::Parser;
use std::process::ExitCode;

#[derive(Parser)]
#[command(name = "cfs")]
enum Command {
    /// What a dataset is.
    Info(info::InfoArgs),
    /// Between formats.
    Convert(convert::ConvertArgs),
}

fn main() -> ExitCode {
    let result = match Command::parse() {
        Command::Info(args) => info::run(&args),
        Command::Convert(args) => convert::run(&args),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("cfs: {error}");
            ExitCode::from(2)
        }
    }
}
