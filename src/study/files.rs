//! Files on disk: read whole up to a size, written whole or not at all.

use super::error::StudyError;
use crate::compute::limits;
use std::hash::{BuildHasher as _, Hasher as _, RandomState};
use std::io::Write as _;
use std::path::Path;

/// Larger files are refused before they are read: datasets and packages, next to which all others are small. \[bytes\]
pub const LARGEST_FILE: u64 = limits::FILE_BYTES;

fn wrong(path: &Path, message: String) -> StudyError {
    StudyError::File { path: path.to_owned(), message }
}

/// All bytes of a file.
///
/// # Errors
/// One sentence that names the file.
pub fn read(path: &Path) -> Result<Vec<u8>, StudyError> {
    let cannot = |error: std::io::Error| wrong(path, format!("cannot be read ({error}); check path and rights"));
    let meta = std::fs::metadata(path).map_err(cannot)?;
    if !meta.is_file() {
        return Err(wrong(path, "not a file; expected one to read".to_owned()));
    }
    if meta.len() > LARGEST_FILE {
        let [size, most] = [meta.len(), LARGEST_FILE].map(|bytes| bytes >> 20);
        return Err(wrong(path, format!("{size} MB; expected at most {most} MB")));
    }
    std::fs::read(path).map_err(cannot)
}

/// Writes a file in one step: into a neighbour first, then renamed, so that nothing half-written is left.
///
/// # Errors
/// One sentence that names the file.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), StudyError> {
    // On the disk before it takes the name: otherwise a power cut could leave the name with nothing in it.
    replace(path, bytes, std::fs::File::sync_all).map(drop)
}

/// The same without waiting for the disk, which under load takes seconds: a program that ends loses nothing, a power cut
/// before the returned file is synchronised may.
///
/// # Errors
/// One sentence that names the file.
pub fn write_at_once(path: &Path, bytes: &[u8]) -> Result<std::fs::File, StudyError> {
    replace(path, bytes, |_| Ok(()))
}

fn replace(
    path: &Path,
    bytes: &[u8],
    wait: impl Fn(&std::fs::File) -> std::io::Result<()>,
) -> Result<std::fs::File, StudyError> {
    let mut part = path.as_os_str().to_owned();
    // A name that no other has: another program may write the same file.
    part.push(format!(".{:016x}.part", RandomState::new().build_hasher().finish()));
    let whole = |part: &Path| {
        let mut file = std::fs::File::create(part)?;
        file.write_all(bytes)?;
        wait(&file)?;
        std::fs::rename(part, path)?;
        Ok(file)
    };
    whole(Path::new(&part)).map_err(|error: std::io::Error| {
        // What matters is the first error; the part may not even exist.
        drop(std::fs::remove_file(&part));
        wrong(path, format!("cannot be written ({error}); expected a writable place"))
    })
}
