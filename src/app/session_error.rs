//! Errors of sessions that cannot be kept or restored. They become sentences where they are shown, because the writer
//! of sessions has no language.

use super::error::AppError;
use crate::texts::shell;
use std::path::{Path, PathBuf};

fn set_aside(file: &Path, report: Option<&Path>) -> String {
    let report = report.map_or_else(|| shell::NO_REPORT.to_string(), |report| report.display().to_string());
    shell::set_aside(file.display(), report)
}

/// Error of a session.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    /// Text that is not a session.
    #[error("{0}")]
    Text(serde_json::Error),
    /// Session written by a newer program: the version of its layout, and the newest version that this program reads.
    #[error("{}", shell::newer_session(.0, .1))]
    Newer(u32, u32),
    /// Session file that cannot be read.
    #[error("{0}")]
    File(AppError),
    /// Session that cannot be restored: its file, and the reason.
    #[error("{}", shell::unreadable(.0.display(), .1))]
    Unreadable(PathBuf, Box<Self>),
    /// Session that was set aside because the program ended more than once soon after restoring it: its new path, and
    /// its report.
    #[error("{}", set_aside(.0, .1.as_deref()))]
    SetAside(PathBuf, Option<PathBuf>),
    /// Session that cannot be written.
    #[error("{}", shell::not_kept(.0))]
    NotKept(String),
    /// Session that may be lost in a power failure.
    #[error("{}", shell::not_safe(.0))]
    NotSafe(String),
}
