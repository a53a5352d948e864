//! Files on disk: read completely up to a maximum size, written completely or not at all, and never over an input of
//! the same run.
//!
//! Every file that the program writes for the user goes through [`write_all`]: it refuses to replace an input or a file
//! of another kind, writes to a file beside the target, and renames it when all bytes are written. The name `-` means
//! standard input and output; standard input and pipes are read once and stored, since readers may need them twice.

use super::error::StudyError;
use super::part::{Part, resolved};
use crate::compute::limits;
use crate::formats::{FileKind, HEAD, extension_of};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{ErrorKind, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Maximum size of a file; larger ones are refused before they are read. Only datasets and packages come near it.
/// \[bytes\]
pub const LARGEST_FILE: u64 = limits::FILE_BYTES;

/// Maximum number of files written together that are open at the same time; systems allow a thousand.
const MOST_OPEN: usize = 200;

/// Paths of the files that this run of the program has read.
static INPUTS: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Contents of standard input and pipes that have been read.
static STREAMS: Mutex<BTreeMap<PathBuf, Vec<u8>>> = Mutex::new(BTreeMap::new());

fn wrong(path: &Path, message: String) -> StudyError {
    StudyError::File { path: path.to_owned(), message }
}

/// Reads all bytes of a file, and records it as an input.
///
/// # Errors
/// Returns an error that names the file.
pub fn read(path: &Path) -> Result<Vec<u8>, StudyError> {
    let cannot = |error: std::io::Error| wrong(path, format!("cannot be read ({error}); check path and rights"));
    if is_standard(path) {
        return read_once(path, || Ok(std::io::stdin().lock()));
    }
    let meta = std::fs::metadata(path).map_err(cannot)?;
    if is_pipe(&meta) {
        return read_once(path, || std::fs::File::open(path).map_err(cannot));
    }
    if !meta.is_file() {
        return Err(wrong(path, "not a file; expected one to read".to_owned()));
    }
    if meta.len() > LARGEST_FILE {
        let [size, most] = [meta.len(), LARGEST_FILE].map(|bytes| bytes >> 20);
        return Err(wrong(path, format!("{size} MB; expected at most {most} MB")));
    }
    keep(path);
    std::fs::read(path).map_err(cannot)
}

/// Whether a path (`-`) stands for standard input or output.
pub fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// Whether a path stands for standard input or output, or leads to a pipe or a device. Neither the name nor the folder
/// of such a stream says anything about its content.
pub fn is_stream(path: &Path) -> bool {
    is_standard(path)
        || ["/dev/stdin", "/dev/stdout", "/dev/fd"].iter().any(|start| path.starts_with(start))
        || std::fs::metadata(path).is_ok_and(|meta| !meta.is_file() && !meta.is_dir())
}

/// Returns the name by which the kind of a file is recognised: its own, or for a stream one with an extension derived
/// from its content.
///
/// # Errors
/// Returns an error if the stream cannot be read.
pub fn name_with_extension(path: &Path) -> Result<String, StudyError> {
    let name = path.to_string_lossy();
    Ok(if is_stream(path) { format!("{name}{}", extension_of(&read(path)?)) } else { name.into_owned() })
}

/// Returns the folder from which relative paths in a file start; for a stream the working directory.
pub fn folder(path: &Path) -> &Path {
    path.parent().filter(|_| !is_stream(path)).unwrap_or(Path::new("."))
}

/// Returns the absolute path of a file, by which messages name a written file; the path itself if it cannot be
/// determined.
pub fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// Whether a file is a pipe, which can be read only once.
#[cfg(unix)]
fn is_pipe(meta: &std::fs::Metadata) -> bool {
    std::os::unix::fs::FileTypeExt::is_fifo(&meta.file_type())
}

/// Whether a file is a pipe; always `false`, since other systems do not report it.
#[cfg(not(unix))]
const fn is_pipe(_: &std::fs::Metadata) -> bool {
    false
}

/// Reads a stream, or returns the bytes of an earlier reading.
fn read_once<T: std::io::Read>(
    path: &Path,
    open: impl FnOnce() -> Result<T, StudyError>,
) -> Result<Vec<u8>, StudyError> {
    let mut streams = STREAMS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(bytes) = streams.get(path) {
        return Ok(bytes.clone());
    }
    let bytes = read_stream(path, open()?)?;
    streams.insert(path.to_owned(), bytes.clone());
    Ok(bytes)
}

/// Reads all bytes of a stream, whose length is known only at its end.
fn read_stream(path: &Path, stream: impl std::io::Read) -> Result<Vec<u8>, StudyError> {
    let mut bytes = Vec::new();
    let read = stream.take(LARGEST_FILE + 1).read_to_end(&mut bytes);
    read.map_err(|error| wrong(path, format!("cannot be read ({error})")))?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(wrong(path, format!("more than {} MB", LARGEST_FILE >> 20)));
    }
    Ok(bytes)
}

/// Records a file, which is read by other means, as an input of this run of the program.
pub fn keep(path: &Path) {
    // A pipe that is only looked at loses its writer.
    if is_standard(path) || std::fs::metadata(path).is_ok_and(|meta| !meta.is_file()) {
        return;
    }
    // Where the program runs is not where it may be later.
    INPUTS.lock().unwrap_or_else(PoisonError::into_inner).insert(absolute(path));
}

/// Returns the files that this run of the program has read, in the order of their paths.
pub fn inputs() -> Vec<PathBuf> {
    INPUTS.lock().unwrap_or_else(PoisonError::into_inner).iter().cloned().collect()
}

/// Rule by which a written file may replace an existing one.
#[derive(Debug, Clone, Copy)]
pub enum Replace<'a> {
    /// Replaces an empty file or one of the same kind – with `force` of any kind –, but none that this run of the
    /// program has read.
    Kind {
        /// Kind of the written file.
        kind: FileKind,
        /// Whether files of any kind may be replaced.
        force: bool,
    },
    /// Replaces any file, since the user was asked, except these.
    But(&'a [PathBuf]),
}

/// File to be written, with its content.
#[derive(Debug, Clone)]
pub struct Output<'a> {
    /// Path of the file.
    pub path: &'a Path,
    /// Content of the file.
    pub bytes: &'a [u8],
    /// Rule by which it may replace an existing file.
    pub replace: Replace<'a>,
}

/// Checks whether a file may be written to a path. Called before long work; [`write_all`] checks again.
///
/// # Errors
/// Returns an error that names the file, what exists there, and what is expected.
pub fn check(path: &Path, replace: Replace<'_>) -> Result<(), StudyError> {
    if is_standard(path) {
        return Ok(());
    }
    let there = match std::fs::metadata(path) {
        Ok(there) => there,
        Err(error) if error.kind() == ErrorKind::NotFound => {
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            return match folder.filter(|folder| !folder.is_dir()) {
                Some(folder) => {
                    Err(wrong(path, format!("cannot be written; its folder {} is not there", folder.display())))
                }
                None => Ok(()),
            };
        }
        Err(error) => return Err(cannot_write(path, &error)),
    };
    if there.is_dir() {
        return Err(wrong(path, "cannot be written; it is a folder; expected the name of a file".to_owned()));
    }
    if !there.is_file() {
        // A pipe or a device accepts everything and loses nothing.
        return Ok(());
    }
    if is_input(path, replace) {
        return Err(wrong(
            path,
            "is not written: it is what the result is made from; expected another file to write".to_owned(),
        ));
    }
    if there.permissions().readonly() {
        return Err(wrong(path, "cannot be written; it is write-protected; expected another file to write".to_owned()));
    }
    if let Replace::Kind { kind, force: false } = replace
        && there.len() > 0
        && !is_of(path, kind)?
    {
        return Err(wrong(
            path,
            format!(
                "is not written: what is there is not {}; choose another name, or replace it with --force",
                kind.words()
            ),
        ));
    }
    Ok(())
}

/// Whether a path leads to one of the inputs of this run, under any name.
fn is_input(path: &Path, replace: Replace<'_>) -> bool {
    let same = |other: &PathBuf| same_file::is_same_file(path, other).unwrap_or(false);
    match replace {
        Replace::But(inputs) => inputs.iter().any(same),
        Replace::Kind { .. } => INPUTS.lock().unwrap_or_else(PoisonError::into_inner).iter().any(same),
    }
}

fn is_of(path: &Path, kind: FileKind) -> Result<bool, StudyError> {
    let mut head = Vec::new();
    let read = std::fs::File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    read.map_err(|error| cannot_write(path, &error))?;
    Ok(kind.may_be(&head))
}

/// Writes several files, all of them or none: each to a file beside its target first, renamed when all are complete, so
/// that nothing half-written remains. Pipes and devices are written to directly.
///
/// # Errors
/// Returns an error that names the file. Existing files are then unchanged.
pub fn write_all(list: &[Output<'_>]) -> Result<(), StudyError> {
    let mut parts: Vec<(&Path, Part)> = Vec::with_capacity(list.len());
    // Before the first byte: output to a stream cannot be undone.
    for (place, one) in list.iter().enumerate() {
        if list[..place].iter().any(|other| other.path == one.path) {
            return Err(wrong(one.path, "is named twice; expected a file for each output".to_owned()));
        }
        check(one.path, one.replace)?;
    }
    for one in list {
        let write_error = |error: std::io::Error| cannot_write(one.path, &error);
        if is_standard(one.path) {
            let mut output = std::io::stdout().lock();
            match output.write_all(one.bytes).and_then(|()| output.flush()) {
                // The reader may stop.
                Err(error) if error.kind() == ErrorKind::BrokenPipe => {}
                done => done.map_err(write_error)?,
            }
            continue;
        }
        let target = resolved(one.path);
        if target.exists() && !target.is_file() {
            let mut device = std::fs::OpenOptions::new().write(true).open(&target).map_err(write_error)?;
            device.write_all(one.bytes).map_err(write_error)?;
            continue;
        }
        let mut part = Part::beside(&target).map_err(write_error)?;
        part.write(one.bytes).map_err(write_error)?;
        // On the disk before it takes the name: otherwise a power cut could leave the name with nothing in it.
        part.file().sync_all().map_err(write_error)?;
        if parts.len() >= MOST_OPEN {
            part.rest();
        }
        parts.push((one.path, part));
    }
    for (path, part) in parts {
        part.take_name().map_err(|error| cannot_write(path, &error))?;
    }
    Ok(())
}

/// Writes one file completely or not at all, like [`write_all`].
///
/// # Errors
/// Returns an error that names the file.
pub fn write(path: &Path, bytes: &[u8], replace: Replace<'_>) -> Result<(), StudyError> {
    write_all(&[Output { path, bytes, replace }])
}

/// Writes a file of the program itself (such as its settings) in one step, without waiting for the disk, which under
/// load takes seconds. Nothing is lost if the program ends, but a power cut before the returned file is synchronised
/// may lose it.
///
/// # Errors
/// Returns an error that names the file.
pub fn write_at_once(path: &Path, bytes: &[u8]) -> Result<std::fs::File, StudyError> {
    let written = Part::beside(&resolved(path)).and_then(|mut part| {
        part.write(bytes)?;
        part.take_name()?.ok_or_else(|| std::io::Error::other("a part that did not rest has its file"))
    });
    written.map_err(|error| cannot_write(path, &error))
}

/// Returns the error that a file cannot be written, with its cause and the remedy.
pub fn cannot_write(path: &Path, error: &std::io::Error) -> StudyError {
    let expected = match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "nothing was written; make room, or choose another place",
        _ => "expected a writable place",
    };
    wrong(path, format!("cannot be written ({error}); {expected}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &[u8] = b"x,E_lx\n1,2\n";
    const FORCE: Replace<'static> = Replace::Kind { kind: FileKind::Csv, force: true };
    const PLAIN: Replace<'static> = Replace::Kind { kind: FileKind::Csv, force: false };

    fn said(result: Result<(), StudyError>) -> String {
        result.map_or_else(|error| error.to_string(), |()| String::new())
    }

    #[test]
    fn an_input_stays_under_whatever_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        std::fs::write(path("a.csv"), TABLE).unwrap();
        std::fs::hard_link(path("a.csv"), path("hard.csv")).unwrap();
        assert_eq!(said(write(&path("a.csv"), b"x,y\n", PLAIN)), "");
        std::fs::write(path("a.csv"), TABLE).unwrap();
        std::fs::remove_file(path("hard.csv")).unwrap();
        std::fs::hard_link(path("a.csv"), path("hard.csv")).unwrap();
        read(&path("a.csv")).unwrap();
        let around = folder.path().join("b").join("..").join("a.csv");
        std::fs::create_dir(path("b")).unwrap();
        for name in [path("a.csv"), path("hard.csv"), around] {
            assert!(said(write(&name, b"x,y\n", FORCE)).contains("made from"), "{}", name.display());
        }
        let asked = [path("a.csv")];
        assert!(said(write(&path("hard.csv"), b"x,y\n", Replace::But(&asked))).contains("made from"));
        assert_eq!(std::fs::read(path("a.csv")).unwrap(), TABLE);
        assert_eq!(said(write(&path("a.csv"), b"x,y\n", Replace::But(&[]))), "");
    }

    #[test]
    fn another_kind_needs_force_and_nothing_does_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("notes");
        std::fs::write(&path, "[site]\nlatitude = 48.0\n").unwrap();
        let told = said(write(&path, TABLE, PLAIN));
        assert!(told.contains("not a CSV table") && told.contains("--force"), "{told}");
        assert_eq!(said(write(&path, TABLE, FORCE)), "");
        assert_eq!(said(write(&path, b"x,y\n3,4\n", PLAIN)), "", "a table takes the place of a table");
        std::fs::write(&path, "").unwrap();
        assert_eq!(said(write(&path, TABLE, PLAIN)), "");
    }

    #[test]
    fn all_files_or_none() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        std::fs::write(path("there.csv"), TABLE).unwrap();
        std::fs::create_dir(path("folder")).unwrap();
        let (new, there, wrong) = (path("new.csv"), path("there.csv"), path("folder"));
        let output = |path| Output { path, bytes: b"x,y\n", replace: PLAIN };
        let told = said(write_all(&[output(&new), output(&there), output(&wrong)]));
        assert!(told.contains("it is a folder"), "{told}");
        assert_eq!(std::fs::read(&there).unwrap(), TABLE);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2, "neither a new file nor a part");
        let told = said(write(&path("no/such.csv"), TABLE, PLAIN));
        assert!(told.contains("its folder"), "{told}");
    }

    #[test]
    fn a_stream_is_read_to_its_end() {
        assert_eq!(read_stream(Path::new("-"), TABLE).unwrap(), TABLE);
        assert!(is_standard(Path::new("-")) && !is_standard(Path::new("./-")));
        assert_eq!(said(check(Path::new("-"), PLAIN)), "");
        assert_eq!((folder(Path::new("-")), folder(Path::new("a/b.toml"))), (Path::new("."), Path::new("a")));
    }

    #[cfg(unix)]
    #[test]
    fn links_stay_links_and_rights_stay_rights() {
        use std::os::unix::fs::{PermissionsExt as _, symlink};
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        std::fs::write(path("a.csv"), TABLE).unwrap();
        std::fs::set_permissions(path("a.csv"), std::fs::Permissions::from_mode(0o600)).unwrap();
        symlink(path("a.csv"), path("link.csv")).unwrap();
        assert_eq!(said(write(&path("link.csv"), b"x,y\n", PLAIN)), "");
        assert!(path("link.csv").is_symlink());
        assert_eq!(std::fs::read(path("a.csv")).unwrap(), b"x,y\n");
        assert_eq!(std::fs::metadata(path("a.csv")).unwrap().permissions().mode() & 0o777, 0o600);
        std::fs::set_permissions(path("a.csv"), std::fs::Permissions::from_mode(0o400)).unwrap();
        assert!(said(write(&path("a.csv"), TABLE, PLAIN)).contains("write-protected"));
        assert_eq!(said(write(Path::new("/dev/null"), TABLE, PLAIN)), "");
        assert!(!Path::new("/dev/null").is_file(), "a device stays one");
    }
}
