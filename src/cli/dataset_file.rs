//! Dataset files on disk: the one place where subcommands open and write them.

use crate::compute::btdf::Dataset;
use crate::formats::read_dataset;
use anyhow::anyhow;
use std::fs;
use std::path::Path;

/// Larger files are refused before they are read.
const MAX_BYTES: u64 = 256 << 20;

/// Reads a file into its datasets, one for every state.
///
/// # Errors
/// One line: the file, the place in it, what is wrong, what would be right.
pub fn read(path: &Path) -> anyhow::Result<Vec<Dataset>> {
    read_dataset(&path.to_string_lossy(), &bytes(path)?).map_err(|error| anyhow!("{}: {error}", path.display()))
}

/// Reads a file that is not too large to be a dataset.
///
/// # Errors
/// One line that names the file.
pub fn bytes(path: &Path) -> anyhow::Result<Vec<u8>> {
    let name = path.display();
    let cannot = |error: std::io::Error| anyhow!("{name}: cannot be read ({error}); expected a dataset file");
    let meta = fs::metadata(path).map_err(cannot)?;
    if !meta.is_file() {
        return Err(anyhow!("{name}: not a file; expected a dataset file"));
    }
    if meta.len() > MAX_BYTES {
        return Err(anyhow!("{name}: {} MB; expected at most {} MB", meta.len() >> 20, MAX_BYTES >> 20));
    }
    fs::read(path).map_err(cannot)
}

/// Writes a file in one step: into a neighbour first, then renamed, so that nothing half-written is left.
///
/// # Errors
/// One line that names the file.
pub fn write(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    let mut part = path.as_os_str().to_owned();
    part.push(format!(".{}.part", std::process::id()));
    let done = fs::write(&part, bytes).and_then(|()| fs::rename(&part, path));
    if done.is_err() {
        // What matters is the first error; the part may not even exist.
        drop(fs::remove_file(&part));
    }
    done.map_err(|error| anyhow!("{}: cannot be written ({error}); expected a writable place", path.display()))
}
