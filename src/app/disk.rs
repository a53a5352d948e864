//! Whole files, read and written as the study does, for results that carry the window's errors.

use super::error::AppError;
use crate::study::files::{self, Output, Replace};
use std::path::{Path, PathBuf};

/// Reads a file that is not larger than the program's size limit.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, AppError> {
    Ok(files::read(path)?)
}

/// Writes a file whole or not at all, over an existing one (the user has been asked) except one of `made_from`, and
/// returns its path.
pub fn write_whole(path: &Path, bytes: &[u8], made_from: &[PathBuf]) -> Result<PathBuf, AppError> {
    files::write(path, bytes, Replace::But(made_from))?;
    Ok(path.to_owned())
}

/// Writes files, all of them or none, as [`write_whole`] does.
pub fn write_several(list: &[(PathBuf, Vec<u8>)], made_from: &[PathBuf]) -> Result<(), AppError> {
    let replace = Replace::But(made_from);
    let outputs: Vec<Output<'_>> = list.iter().map(|(path, bytes)| Output { path, bytes, replace }).collect();
    Ok(files::write_all(&outputs)?)
}

/// Creates a folder if it does not exist.
pub fn create_folder(path: &Path) -> Result<(), AppError> {
    std::fs::create_dir_all(path).map_err(|error| AppError::from(files::cannot_write(path, &error)))
}

/// Whether a path has this extension, ignoring case.
pub fn ends_in(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(extension))
}
