//! Errors of sessions that cannot be stored or restored. They are converted to sentences where they are shown, because
//! the thread that stores sessions does not know the language of the window.

use crate::app::shell::error::AppError;
use crate::texts::shell;
use std::path::{Path, PathBuf};

fn set_aside(file: &Path, report: Option<&Path>) -> String {
    let report = report.map_or_else(|| shell::NO_REPORT.to_string(), |report| report.display().to_string());
    shell::set_aside(file.display(), report)
}

/// Error in storing or restoring a session.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    /// Content of a session file that is not a session, with the parser's error.
    #[error("{0}")]
    Text(serde_json::Error),
    /// Session written by a newer program: the version of its file layout, and the newest version that this program
    /// reads.
    #[error("{}", shell::newer_session(.0, .1))]
    Newer(u32, u32),
    /// Session file that cannot be read from disk.
    #[error("{0}")]
    File(AppError),
    /// Session that cannot be restored: the path of its file, and the reason.
    #[error("{}", shell::unreadable(.0.display(), .1))]
    Unreadable(PathBuf, Box<Self>),
    /// Session that was renamed instead of restored, because the program ended more than once soon after restoring it:
    /// its new path, and the path of the error report.
    #[error("{}", set_aside(.0, .1.as_deref()))]
    SetAside(PathBuf, Option<PathBuf>),
    /// Session that cannot be written, with the reason.
    #[error("{}", shell::not_kept(.0))]
    NotKept(String),
    /// Session that was written, but may be lost in a power failure, with the reason.
    #[error("{}", shell::not_safe(.0))]
    NotSafe(String),
}
