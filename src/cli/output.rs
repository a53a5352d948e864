//! Files that appear whole or not at all.

use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Writes beside the target and renames, so that a full disk or a break leaves no half file.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut partial = path.as_os_str().to_owned();
    partial.push(".part");
    let partial = PathBuf::from(partial);
    let result = std::fs::File::create(&partial)
        .and_then(|mut file| file.write_all(bytes))
        .and_then(|()| std::fs::rename(&partial, path));
    if result.is_err() {
        // The first error is the one to report; a part that cannot be removed was never made.
        std::fs::remove_file(&partial).ok();
    }
    result
}
