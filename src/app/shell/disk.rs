//! Reading and writing of whole files by the study's functions, with errors of the window.

use crate::app::shell::error::AppError;
use crate::study::files::{self, Output, Replace};
use std::path::{Path, PathBuf};

/// Reads a file that is not larger than the program's size limit.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, AppError> {
    Ok(files::read(path)?)
}

/// Writes a file completely or not at all, and returns its path. An existing file is replaced (the caller has asked the
/// user), unless it is one of the input files `made_from`.
pub fn write_whole(path: &Path, bytes: &[u8], made_from: &[PathBuf]) -> Result<PathBuf, AppError> {
    files::write(path, bytes, Replace::But(made_from))?;
    Ok(path.to_owned())
}

/// Writes files like [`write_whole`]: all of them, or none after an error.
pub fn write_several(list: &[(PathBuf, Vec<u8>)], made_from: &[PathBuf]) -> Result<(), AppError> {
    let replace = Replace::But(made_from);
    let outputs: Vec<Output<'_>> = list.iter().map(|(path, bytes)| Output { path, bytes, replace }).collect();
    Ok(files::write_all(&outputs)?)
}

/// Creates a folder if it does not exist.
pub fn create_folder(path: &Path) -> Result<(), AppError> {
    std::fs::create_dir_all(path).map_err(|error| AppError::from(files::cannot_write(path, &error)))
}

/// Whether a path has the given extension, in any case.
pub fn ends_in(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(extension))
}
