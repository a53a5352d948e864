//! Files that commands write: not over what they were made from, nor over files of another kind without a word.

use crate::drawing::{Drawing, missing_characters};
use crate::formats::FileKind;
use crate::study::StudyError;
use crate::study::files::{self, Output, Replace};
use std::path::Path;

/// Options for overwriting existing files.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct Over {
    /// Overwrite an existing file even if it is of another type (input files are never overwritten)
    #[arg(long)]
    pub force: bool,
}

/// Names the characters that stand as boxes in the PNG or PDF file that was written.
pub(super) fn warn_of_missing_characters(drawings: &[Drawing]) {
    if let Some(warning) = missing_characters(drawings) {
        tell!("warning: {warning}");
    }
}

impl Over {
    const fn replace(self, kind: FileKind) -> Replace<'static> {
        Replace::Kind { kind, force: self.force }
    }

    /// Before the work: may this file be written? `from`: what the command is about to read.
    pub(super) fn check<'a>(
        self,
        from: impl IntoIterator<Item = &'a Path>,
        path: Option<&Path>,
        kind: FileKind,
    ) -> Result<(), StudyError> {
        from.into_iter().for_each(files::keep);
        path.map_or(Ok(()), |path| files::check(path, self.replace(kind)))
    }

    /// Writes a file whole, or not at all.
    pub(super) fn write(self, path: &Path, kind: FileKind, bytes: &[u8]) -> Result<(), StudyError> {
        files::write(path, bytes, self.replace(kind))
    }

    /// Writes files, all of them or none.
    pub(super) fn write_all(self, list: &[(&Path, FileKind, &[u8])]) -> Result<(), StudyError> {
        let output = |&(path, kind, bytes): &(_, _, _)| Output { path, bytes, replace: self.replace(kind) };
        files::write_all(&list.iter().map(output).collect::<Vec<_>>())
    }
}
