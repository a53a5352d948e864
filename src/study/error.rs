//! Errors of studies: one sentence each, naming the key or file and what is expected.

use crate::compute::estimate::Cancelled;
use crate::compute::room::mesh::TooManyPatches;
use crate::compute::room::radiosity::NothingAbsorbs;
use std::path::PathBuf;

/// Error of a study.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StudyError {
    /// Key of the scene with a wrong value.
    #[error("{key}: {message}")]
    Key {
        /// Full name of the key, such as `aperture[1].size`.
        key: String,
        /// Description of the error, and what is expected.
        message: String,
    },
    /// Text that is not a scene file.
    #[error("line {line}, column {column}: {message}")]
    Syntax {
        /// Line number, from 1.
        line: usize,
        /// Column number, from 1.
        column: usize,
        /// Description of the error, and what is expected.
        message: String,
    },
    /// File that cannot be read or written.
    #[error("{}: {message}", path.display())]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Description of the error, and what is expected.
        message: String,
    },
    /// Entry that the catalogue does not contain, or a catalogue that cannot be read.
    #[error("catalogue: {0}")]
    Catalogue(String),
    /// Room in which interreflection has no solution, because nothing absorbs light.
    #[error("room.reflectance: {0}")]
    Room(NothingAbsorbs),
    /// More apertures than interreflection can be computed for.
    #[error("aperture: {0}")]
    Patches(TooManyPatches),
    /// Lengths or values that differ too much for the arithmetic.
    #[error(
        "the light at {0} is not a finite number: lengths or values of the scene differ by too many orders of magnitude"
    )]
    NoNumber(String),
    /// Cancelled computation.
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
    /// Returns the error that `system = "ranked"` is given where a system is needed. `key`: name of the key.
    pub fn ranked(key: impl Into<String>) -> Self {
        Self::key(key, "\"ranked\" stands for every product in turn: use `cfs rank`, or name one product here")
    }

    /// Returns the error about a wrong key of the scene, by its full name.
    pub fn key(key: impl Into<String>, message: impl Into<String>) -> Self {
        Self::Key { key: key.into(), message: message.into() }
    }
}
