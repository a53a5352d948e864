//! Why a study cannot be made: one sentence each, naming the key or the file and what would be right.

use crate::compute::estimate::Cancelled;
use crate::compute::room::mesh::TooManyPatches;
use crate::compute::room::radiosity::NothingAbsorbs;
use std::path::PathBuf;

/// Why a study cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StudyError {
    /// A key of the scene is wrong.
    #[error("{key}: {message}")]
    Key {
        /// Full name, e.g. `aperture[1].size`.
        key: String,
        /// What is wrong and what would be right.
        message: String,
    },
    /// The text is no scene.
    #[error("line {line}, column {column}: {message}")]
    Syntax {
        /// From 1.
        line: usize,
        /// From 1.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// A file cannot be read or written.
    #[error("{}: {message}", path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// What is wrong and what would be right.
        message: String,
    },
    /// The catalogue has no such thing, or cannot be read.
    #[error("catalogue: {0}")]
    Catalogue(String),
    /// The room has no solution.
    #[error("room.reflectance: {0}")]
    Room(NothingAbsorbs),
    /// More apertures than interreflection can be computed with.
    #[error("aperture: {0}")]
    Patches(TooManyPatches),
    /// Lengths or values that arithmetic cannot hold together.
    #[error(
        "the light at {0} comes out as no number: lengths or values of the scene lie too far apart to be computed with"
    )]
    NoNumber(String),
    /// Withdrawn.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

// Not as sources: the message is already part of the sentence, and a chain of causes would say it twice.
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
    /// Why a place for every product of a ranking is no system.
    pub fn ranked(key: impl Into<String>) -> Self {
        Self::key(key, "\"ranked\" stands for every product in turn: use `cfs rank`, or name one product here")
    }

    /// A wrong key.
    pub fn key(key: impl Into<String>, message: impl Into<String>) -> Self {
        Self::Key { key: key.into(), message: message.into() }
    }
}
