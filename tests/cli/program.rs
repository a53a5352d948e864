//! The program as scripts start it: in a folder, with a catalogue of its own there.

use std::path::Path;
use std::process::{Command, Output};

/// Runs the program in a folder.
pub fn cfs(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_cfs"))
        .args(arguments)
        .current_dir(folder)
        .env("CFS_CATALOGUE", folder.join("catalogue.cfsdb"))
        .output()
        .unwrap()
}
