//! Reading of dataset files for subcommands.

use crate::compute::btdf::Dataset;
use crate::formats::read_dataset;
use crate::study::files;
use anyhow::anyhow;
use std::path::Path;

/// Reads a file into its datasets, one per state.
///
/// # Errors
/// Returns an error of one line: the file, the position in it, what is wrong, and what was expected.
pub fn read(path: &Path) -> anyhow::Result<Vec<Dataset>> {
    read_dataset(&path.to_string_lossy(), &files::read(path)?).map_err(|error| anyhow!("{}: {error}", path.display()))
}
