//! `cfs convert`: between the dataset formats that the program reads and writes.

use crate::cli::dataset_file;
use crate::formats::{format_to_write, write_dataset};
use anyhow::anyhow;
use std::path::PathBuf;

/// Arguments of `cfs convert`.
#[derive(Debug, Clone, clap::Args)]
pub struct ConvertArgs {
    /// File to read.
    pub input: PathBuf,
    /// File to write; the extension says in which format.
    pub output: PathBuf,
    /// Key of the state to write, for files of several states.
    #[arg(long)]
    pub state: Option<String>,
}

/// Reads, converts, writes.
///
/// # Errors
/// Input that cannot be read, a state that is not there, an output format that is unknown or cannot hold the data.
/// Nothing is left behind then.
pub fn run(args: &ConvertArgs) -> anyhow::Result<()> {
    let out_name = args.output.to_string_lossy();
    let format = format_to_write(&out_name).map_err(|error| anyhow!("{out_name}: {error}"))?;
    let mut datasets = dataset_file::read(&args.input)?;
    if let Some(state) = &args.state {
        let keys: Vec<String> = datasets.iter().map(|one| format!("'{}'", one.state)).collect();
        datasets.retain(|one| one.state == *state);
        if datasets.is_empty() {
            return Err(anyhow!("{}: no state '{state}'; expected one of {}", args.input.display(), keys.join(", ")));
        }
    }
    let written = write_dataset(format, &datasets).map_err(|error| anyhow!("{out_name}: {error}"))?;
    dataset_file::write(&args.output, &written.bytes)?;
    for finding in datasets.iter().flat_map(|one| &one.findings).chain(&written.findings) {
        eprintln!("{}: {}", finding.severity.word(), finding.message);
    }
    Ok(())
}
