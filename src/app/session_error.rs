//! Why a session is not kept or cannot be taken up. It becomes a sentence where it is told: the keeper speaks no language.

use super::error::AppError;
use crate::texts::shell;
use std::path::{Path, PathBuf};

fn set_aside(file: &Path, report: Option<&Path>) -> String {
    let report = report.map_or_else(|| shell::NO_REPORT.to_string(), |report| report.display().to_string());
    shell::set_aside(file.display(), report)
}

/// What is wrong with a session.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    /// It is no text of a session.
    #[error("{0}")]
    Text(serde_json::Error),
    /// A newer program has written it: its layout, and the newest that this one reads.
    #[error("{}", shell::newer_session(.0, .1))]
    Newer(u32, u32),
    /// Its file cannot be read.
    #[error("{0}")]
    File(AppError),
    /// It cannot be taken up.
    #[error("{}", shell::unreadable(.0.display(), .1))]
    Unreadable(PathBuf, Box<Self>),
    /// The program ended more than once soon after it had taken it up: where it lies now, and what its report is.
    #[error("{}", set_aside(.0, .1.as_deref()))]
    SetAside(PathBuf, Option<PathBuf>),
    /// It cannot be written.
    #[error("{}", shell::not_kept(.0))]
    NotKept(String),
    /// It may be lost with the power.
    #[error("{}", shell::not_safe(.0))]
    NotSafe(String),
}
