//! Reference data, and a note of every test that did not look for want of something.
//!
//! What a passing test prints is not shown. So it is written down, for all test programs of a run together, and
//! `tests/zz_not_looked_at.rs`, which comes last, says the sum.

#![allow(dead_code, reason = "every test program uses its own part")]

use std::io::Write as _;
use std::path::{Path, PathBuf};

/// The folder of the project, where the lock file is: tests of a layer are compiled for a package inside it, and run there.
pub fn root() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.ancestors().find(|folder| folder.join("Cargo.lock").is_file()).expect("a folder with a lock file")
}

/// File in a folder of `tests/reference` that has some cases of a kit only: says which.
pub const SELECTION: &str = "SELECTION.md";

/// Returns a file or folder of the reference data.
///
/// Kits made for this project are in `tests/reference`; files of makers, and kits too large for the repository, are in
/// `$CFS_TEST_DATA` or `../shared`. Where the repository has a [`SELECTION`], the whole kit comes first. What is absent,
/// or looked at by a selection only, is noted.
#[track_caller]
pub fn data(part: &str) -> Option<PathBuf> {
    let own = root().join("tests").join(part);
    let selected = own.join(SELECTION).exists();
    if own.exists() && !selected {
        return Some(own);
    }
    let folder = std::env::var_os("CFS_TEST_DATA").map_or_else(|| "../shared".into(), PathBuf::from);
    let path = root().join(folder).join(part);
    if path.exists() {
        return Some(path);
    }
    let absent = if selected { "only a selection of the reference data" } else { "reference data absent" };
    not_looked_at(&format!("{absent} (CFS_TEST_DATA)"));
    selected.then_some(own)
}

/// Whether a file of a kit is one that a [`SELECTION`] does without.
pub fn left_out(file: &Path) -> bool {
    !file.exists() && file.with_file_name(SELECTION).exists()
}

/// Are pictures compared? Only those of a software Vulkan driver (lavapipe): others draw other pixels.
#[track_caller]
pub fn compares_pictures() -> bool {
    let asked = std::env::var("WGPU_BACKEND").as_deref() == Ok("vulkan");
    if !asked {
        not_looked_at("no adapter that draws the same everywhere (WGPU_BACKEND=vulkan, with lavapipe)");
    }
    asked
}

/// Notes that the running test passes without having looked, or without having looked at all it was to.
#[track_caller]
pub fn not_looked_at(why: &str) {
    let place = std::panic::Location::caller();
    let thread = std::thread::current();
    // A test's thread has its name, unless all run on the first one.
    let test = match thread.name() {
        None | Some("main") => format!("{}:{}", place.file(), place.line()),
        Some(name) => name.to_owned(),
    };
    let notes = notes();
    std::fs::create_dir_all(notes.parent().unwrap()).unwrap();
    let mut file = std::fs::File::options().create(true).append(true).open(notes).unwrap();
    // In one piece, since tests run side by side.
    file.write_all(format!("{why}\t{}::{test}\n", env!("CARGO_CRATE_NAME")).as_bytes()).unwrap();
}

/// The file of this run's notes: its test programs are started by one process.
pub fn notes() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("not-looked-at").join(run())
}

/// The process that started this one. Its number comes again some day, so its start is part of the name.
#[cfg(unix)]
fn run() -> String {
    let parent = std::os::unix::process::parent_id();
    let status = std::fs::read_to_string(format!("/proc/{parent}/stat")).unwrap_or_default();
    // After the name in parentheses, which may hold blanks, the state is field 3 and the start 22.
    let start = status.rsplit(')').next().and_then(|rest| rest.split_whitespace().nth(19));
    format!("{parent}-{}", start.unwrap_or("0"))
}

#[cfg(not(unix))]
fn run() -> String {
    "last".to_owned()
}
