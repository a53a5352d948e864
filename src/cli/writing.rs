//! Output files of commands. Input files are never overwritten, files of another kind only with `--force`; the name `-`
//! means standard output. Each file written is reported with its full path.

use super::output;
use crate::drawing::{Drawing, missing_characters};
use crate::formats::FileKind;
use crate::formats::decimal_comma::with_decimal_commas;
use crate::study::StudyError;
use crate::study::files::{self, Output, Replace};
use crate::texts::visible;
use anyhow::bail;
use std::borrow::Cow;
use std::io::IsTerminal as _;
use std::path::{Path, PathBuf};

/// Maximum number of written files of one command that are reported one by one. Chosen: no effect on results.
const MAX_NAMED: usize = 4;

/// Options for overwriting existing files.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct Over {
    /// Overwrite an existing file even if it is of another type (input files are never overwritten)
    #[arg(long)]
    pub force: bool,
}

/// Prints a warning that names the characters shown as boxes in the PNG or PDF file that was written.
pub(super) fn warn_of_missing_characters(drawings: &[Drawing]) {
    if let Some(warning) = missing_characters(drawings) {
        report!("warning: {warning}");
    }
}

impl Over {
    const fn replace(self, kind: FileKind) -> Replace<'static> {
        Replace::Kind { kind, force: self.force }
    }

    /// Checks before a computation whether the output file may be written, and reserves standard output for it if its
    /// name is `-`. `from`: files that the command is about to read.
    pub(super) fn check<'a>(
        self,
        from: impl IntoIterator<Item = &'a Path>,
        path: Option<&Path>,
        kind: FileKind,
    ) -> anyhow::Result<()> {
        from.into_iter().for_each(files::keep);
        let Some(path) = path else { return Ok(()) };
        if files::is_standard(path) {
            if !kind.is_text() && std::io::stdout().is_terminal() {
                bail!("-: {} is not text for a terminal; expected a pipe or a file as standard output", kind.words());
            }
            output::give_to_file();
        }
        Ok(files::check(path, self.replace(kind))?)
    }

    /// Writes a file completely, or not at all, and reports it on standard error.
    pub(super) fn write(self, path: &Path, kind: FileKind, bytes: &[u8]) -> Result<(), StudyError> {
        self.write_all(&[(path, kind, bytes)])
    }

    /// Writes files (all of them, or none after an error) and reports them on standard error.
    pub(super) fn write_all(self, list: &[(&Path, FileKind, &[u8])]) -> Result<(), StudyError> {
        self.write_silently(list)?;
        report_written(list.iter().map(|(path, ..)| *path));
        Ok(())
    }

    /// Writes files (all of them, or none after an error) without a report, for which the caller uses
    /// [`report_written`].
    pub(super) fn write_silently(self, list: &[(&Path, FileKind, &[u8])]) -> Result<(), StudyError> {
        let output = |&(path, kind, bytes): &(_, _, _)| Output { path, bytes, replace: self.replace(kind) };
        files::write_all(&list.iter().map(output).collect::<Vec<_>>())
    }
}

/// Reports written files on standard error with their full paths, only the first ones of many; without standard output
/// and pipes.
pub(super) fn report_written<'a>(paths: impl Iterator<Item = &'a Path>) {
    let list: Vec<PathBuf> = paths.filter(|path| !files::is_stream(path)).map(files::absolute).collect();
    match list.as_slice() {
        [first, others @ ..] if list.len() > MAX_NAMED => {
            report!("written: {} and {} more files beside it", first.display(), others.len());
        }
        few => few.iter().for_each(|path| report!("written: {}", path.display())),
    }
}

/// Options for writing CSV tables.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct Tables {
    /// Options for overwriting existing files.
    #[command(flatten)]
    pub over: Over,
    /// Write the CSV table with decimal commas, and semicolons between columns, the notation of spreadsheets in German
    /// and other languages; such a table is read wherever a plain one is
    #[arg(long)]
    pub decimal_comma: bool,
}

impl Tables {
    /// Checks the output file before a computation like [`Over::check`], and also that `--decimal-comma` applies to it.
    /// `is_printed`: whether the table goes to standard output if there is no file.
    pub(super) fn check<'a>(
        self,
        from: impl IntoIterator<Item = &'a Path>,
        path: Option<&Path>,
        kind: FileKind,
        is_printed: bool,
    ) -> anyhow::Result<()> {
        if self.decimal_comma && kind != FileKind::Csv {
            bail!("--decimal-comma: {} is written; expected a CSV table", kind.words());
        }
        if self.decimal_comma && path.is_none() && !is_printed {
            bail!("--decimal-comma: no CSV table is written; expected a file for it");
        }
        self.over.check(from, path, kind)
    }

    /// Returns the text of a file as bytes, with decimal commas if it is a CSV table and they are requested.
    fn formed(self, kind: FileKind, text: &str) -> Cow<'_, [u8]> {
        if self.decimal_comma && kind == FileKind::Csv {
            Cow::Owned(with_decimal_commas(text))
        } else {
            Cow::Borrowed(text.as_bytes())
        }
    }

    /// Writes a text to a file, or to standard output if there is no file.
    pub(super) fn put(self, path: Option<&Path>, kind: FileKind, text: &str) -> anyhow::Result<()> {
        match path {
            Some(path) => Ok(self.over.write(path, kind, &self.formed(kind, text))?),
            None => output::print_bytes(&self.formed(kind, &visible(text))),
        }
    }

    /// Returns a CSV table as the bytes of its file, with decimal commas if they are requested.
    pub(super) fn bytes(self, table: &str) -> Vec<u8> {
        self.formed(FileKind::Csv, table).into_owned()
    }
}

/// Option for the format of a file without a name.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct StreamFormat {
    /// Format of a file that is written to standard output (-) or to a pipe, as the extension that it would have
    #[arg(long, value_name = "EXTENSION")]
    pub format: Option<String>,
}

impl StreamFormat {
    /// Returns the name by whose extension the format of the file is recognised: `path`, or for a stream one with the
    /// extension of `--format`.
    pub(super) fn name(&self, path: &Path) -> anyhow::Result<PathBuf> {
        match (&self.format, files::is_stream(path)) {
            (Some(extension), true) => Ok(PathBuf::from(format!("stream.{}", extension.trim_start_matches('.')))),
            (Some(_), false) => {
                bail!(
                    "{}: --format is for standard output and pipes; the name of a file sets its format",
                    path.display()
                )
            }
            (None, true) if path.extension().is_none() => {
                bail!("{}: no extension that sets the format; expected --format, as in --format xml", path.display())
            }
            (None, _) => Ok(path.to_owned()),
        }
    }
}

/// Returns an error if several files would be written to standard output or a pipe.
pub(super) fn refuse_stream(path: &Path) -> anyhow::Result<()> {
    if files::is_stream(path) {
        bail!("{}: several files would be written, a stream takes one; expected the name of a file", path.display());
    }
    Ok(())
}
