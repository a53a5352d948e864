//! Errors of studies: one sentence each, naming the key or file and what is expected.

use crate::compute::estimate::Cancelled;
use crate::compute::room::mesh::TooManyPatches;
use crate::compute::room::radiosity::NothingAbsorbs;
use std::path::PathBuf;

/// Error of a study.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StudyError {
    /// A key of the scene is wrong.
    #[error("{key}: {message}")]
    Key {
        /// Full name of the key, e.g. `aperture[1].size`.
        key: String,
        /// Error, and what is expected.
        message: String,
    },
    /// The text is not a scene.
    #[error("line {line}, column {column}: {message}")]
    Syntax {
        /// Line number, from 1.
        line: usize,
        /// Column number, from 1.
        column: usize,
        /// Description of the error.
        message: String,
    },
    /// A file cannot be read or written.
    #[error("{}: {message}", path.display())]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Error, and what is expected.
        message: String,
    },
    /// The catalogue does not have the entry, or cannot be read.
    #[error("catalogue: {0}")]
    Catalogue(String),
    /// Interreflection in the room has no solution.
    #[error("room.reflectance: {0}")]
    Room(NothingAbsorbs),
    /// More apertures than interreflection can be computed with.
    #[error("aperture: {0}")]
    Patches(TooManyPatches),
    /// Lengths or values that are too far apart for the arithmetic.
    #[error(
        "the light at {0} is not a finite number: lengths or values of the scene differ by too many orders of magnitude"
    )]
    NoNumber(String),
    /// The computation was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

// Not as sources: the message is already part of the sentence, and a chain of causes would repeat it.
impl From<NothingAbsorbs> for StudyError {
    fn from(error: NothingAbsorbs) -> Self {
        Self::Room(error)
    }
}

impl From<TooManyPatches> for StudyError {
    fn from(error: TooManyPatches) -> Self {
        Self::Patches(error)
    }
}

impl StudyError {
    /// Returns the error about `system = "ranked"` where a system is needed.
    pub fn ranked(key: impl Into<String>) -> Self {
        Self::key(key, "\"ranked\" stands for every product in turn: use `cfs rank`, or name one product here")
    }

    /// Returns the error about a wrong key.
    pub fn key(key: impl Into<String>, message: impl Into<String>) -> Self {
        Self::Key { key: key.into(), message: message.into() }
    }
}
