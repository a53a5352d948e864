//! Temporary file (part) with the content of a file that is being written, beside the target that it will replace.
//!
//! It is locked as long as its program runs; the operating system releases the lock however the program ends. A
//! remaining part without a lock has been abandoned, and is removed when something is written to the same folder.

use std::collections::BTreeSet;
use std::fs::{File, TryLockError};
use std::hash::{BuildHasher as _, Hasher as _, RandomState};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// End of the name of a temporary file, after its unique number.
const ENDING: &str = ".part";
/// Number of hexadecimal digits of the unique number in the name.
const DIGITS: usize = 16;
/// Maximum length of a target's name that is part of the temporary file's name; with a longer one the number does not
/// fit into the 255 bytes that systems allow.
const LONGEST_NAME: usize = 200;
/// Age without changes above which temporary files count as abandoned, where files cannot be locked.
const OLD: Duration = Duration::from_secs(3600);
/// Number of attempts with new names if another program removes the temporary file between its creation and its
/// locking.
const TRIES: usize = 8;

/// Folders from which this program has removed abandoned temporary files.
static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Returns the file to which a path leads: for a symbolic link its target.
pub(super) fn resolved(path: &Path) -> PathBuf {
    let link = std::fs::symlink_metadata(path).is_ok_and(|meta| meta.is_symlink());
    let led = link.then(|| std::fs::canonicalize(path).ok()).flatten();
    led.unwrap_or_else(|| path.to_owned())
}

/// Temporary file with the content of a file that is being written. It is removed if it is dropped before it has been
/// renamed.
pub(super) struct Part {
    /// Open file; `None` after it was closed by [`Self::rest`] or renamed.
    file: Option<File>,
    path: PathBuf,
    target: PathBuf,
    named: bool,
}

impl Part {
    /// Creates the temporary file for a file `target`, with the permissions of an existing one.
    pub(super) fn beside(target: &Path) -> std::io::Result<Self> {
        let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        sweep(folder);
        let name = target.file_name().unwrap_or_default();
        for _ in 0..TRIES {
            let number = RandomState::new().build_hasher().finish();
            let mut own = if name.len() > LONGEST_NAME { "cfs".into() } else { name.to_owned() };
            own.push(format!(".{number:0DIGITS$x}{ENDING}"));
            let path = folder.join(own);
            let file = File::options().write(true).create_new(true).open(&path)?;
            let part = Self { file: Some(file), path, target: target.to_owned(), named: false };
            match part.file().try_lock() {
                // Between its creation and its locking it had no owner.
                Ok(()) if !part.path.exists() => continue,
                Err(TryLockError::WouldBlock) => continue,
                // Where nothing can be locked, its age protects it.
                Ok(()) | Err(TryLockError::Error(_)) => {}
            }
            if let Ok(there) = std::fs::metadata(target) {
                std::fs::set_permissions(&part.path, there.permissions())?;
            }
            return Ok(part);
        }
        Err(std::io::Error::other("the file that is being written is removed again and again"))
    }

    /// Returns the open temporary file.
    ///
    /// # Panics
    /// Never: it is open until [`Self::rest`] or [`Self::take_name`].
    pub(super) fn file(&self) -> &File {
        self.file.as_ref().expect("a part is written before it rests or takes its name")
    }

    /// Appends bytes to the temporary file.
    pub(super) fn write(&mut self, bytes: &[u8]) -> std::io::Result<()> {
        self.file().write_all(bytes)
    }

    /// Closes the temporary file until it is renamed, and so releases the lock; only for seconds, not hours.
    pub(super) fn rest(&mut self) {
        self.file = None;
    }

    /// Renames the temporary file to its target, and returns the file unless it was closed.
    pub(super) fn take_name(mut self) -> std::io::Result<Option<File>> {
        std::fs::rename(&self.path, &self.target)?;
        self.named = true;
        let file = self.file.take();
        // Readers need not wait any more. Where nothing can be locked, nothing can be unlocked.
        drop(file.as_ref().map(File::unlock));
        Ok(file)
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        if !self.named {
            self.file = None;
            drop(std::fs::remove_file(&self.path));
        }
    }
}

/// Whether a file name is that of a temporary file.
fn is_part(name: &str) -> bool {
    let number = name.strip_suffix(ENDING).and_then(|rest| rest.rsplit_once('.'));
    number.is_some_and(|(stem, number)| {
        !stem.is_empty() && number.len() == DIGITS && number.bytes().all(|c| matches!(c, b'0'..=b'9' | b'a'..=b'f'))
    })
}

/// Removes the temporary files of programs that ended prematurely, once for every folder.
fn sweep(folder: &Path) {
    let whole = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
    if !SWEPT.lock().unwrap_or_else(PoisonError::into_inner).insert(whole) {
        return;
    }
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        if !entry.file_type().is_ok_and(|kind| kind.is_file()) || !is_part(&entry.file_name().to_string_lossy()) {
            continue;
        }
        let path = entry.path();
        let Ok(file) = File::options().write(true).open(&path) else { continue };
        let dead = match file.try_lock() {
            Ok(()) => true,
            Err(TryLockError::WouldBlock) => false,
            Err(TryLockError::Error(_)) => {
                let changed = entry.metadata().and_then(|meta| meta.modified()).ok();
                changed.and_then(|at| at.elapsed().ok()).is_some_and(|age| age > OLD)
            }
        };
        if dead {
            drop(std::fs::remove_file(&path));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_the_dead_go_and_those_of_the_living_stay() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let [dead, alive] = ["a.csv.0123456789abcdef.part", "b.csv.fedcba9876543210.part"];
        let others = ["film.mp4.part", "a.csv.0123.part", "0123456789abcdef.part", "a.csv"];
        for name in [dead, alive].into_iter().chain(others) {
            std::fs::write(path(name), "half").unwrap();
        }
        // Held by this process under another handle, as another program would hold it.
        let held = File::options().write(true).open(path(alive)).unwrap();
        held.lock().unwrap();
        let part = Part::beside(&path("c.csv")).unwrap();
        assert!(!path(dead).exists() && path(alive).exists());
        assert!(others.iter().all(|name| path(name).exists()));
        drop(part);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1 + others.len(), "a part goes with its value");
        drop(held);
    }

    #[test]
    fn a_part_goes_with_a_panic() {
        let folder = tempfile::tempdir().unwrap();
        let panic = std::panic::catch_unwind(|| {
            let mut part = Part::beside(&folder.path().join("a.csv")).unwrap();
            part.write(b"half").unwrap();
            panic!("in the middle of it");
        });
        assert!(panic.is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_long_name_has_a_short_part() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join(format!("{}.csv", "n".repeat(240)));
        let mut part = Part::beside(&target).unwrap();
        part.write(b"x").unwrap();
        part.take_name().unwrap();
        assert_eq!(std::fs::read(&target).unwrap(), b"x");
    }
}
