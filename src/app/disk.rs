//! Whole files, read and written as the study does, for results that carry the window's errors.

use super::error::AppError;
use crate::study::files;
use std::path::{Path, PathBuf};

/// Reads a file that is not larger than anything the program knows.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, AppError> {
    Ok(files::read(path)?)
}

/// Writes a file whole or not at all; its path comes back.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<PathBuf, AppError> {
    files::write(path, bytes)?;
    Ok(path.to_owned())
}

/// Does a path end so? Case does not matter.
pub fn ends_in(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(extension))
}
