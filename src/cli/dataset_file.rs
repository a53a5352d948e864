//! Dataset files as subcommands read them.

use crate::compute::btdf::Dataset;
use crate::formats::read_dataset;
use crate::study::files;
use anyhow::anyhow;
use std::path::Path;

/// Reads a file into its datasets, one for every state.
///
/// # Errors
/// One line: the file, the place in it, what is wrong, what would be right.
pub fn read(path: &Path) -> anyhow::Result<Vec<Dataset>> {
    read_dataset(&path.to_string_lossy(), &files::read(path)?).map_err(|error| anyhow!("{}: {error}", path.display()))
}
