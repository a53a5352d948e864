//! Whole files, read and written.

use super::error::AppError;
use std::path::{Path, PathBuf};

/// Files beyond this are refused before they are read. \[bytes\]
const LARGEST_FILE: u64 = 1 << 30;

/// Reads a file that is not larger than anything the window knows.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, AppError> {
    let told = |error| AppError::Read(path.to_owned(), error);
    let size = std::fs::metadata(path).map_err(told)?.len();
    if size > LARGEST_FILE {
        return Err(AppError::TooLarge(path.to_owned(), size));
    }
    std::fs::read(path).map_err(told)
}

/// Writes beside the target first, so that a failure leaves nothing half-written.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<PathBuf, AppError> {
    let name = path.file_name().ok_or_else(|| AppError::NoFileName(path.to_owned()))?;
    let mut name = name.to_os_string();
    name.push(".part");
    let part = path.with_file_name(name);
    let written = std::fs::write(&part, bytes).and_then(|()| std::fs::rename(&part, path));
    written.map_err(|error| {
        // Best effort: the part may never have come to be.
        drop(std::fs::remove_file(&part));
        AppError::Write(path.to_owned(), error)
    })?;
    Ok(path.to_owned())
}

/// Does a path end so? Case does not matter.
pub fn ends_in(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(extension))
}
