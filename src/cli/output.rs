//! Output of results on standard output and of messages on standard error, and the format of numbers.

pub(super) use crate::drawing::ticks::nine_digits as number;
use crate::texts::{message, short_numbers, visible};
use anyhow::Context as _;
use serde_json::Value;
use std::io::Write as _;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether standard output is the file that the command writes.
static IS_FILE: AtomicBool = AtomicBool::new(false);

/// Reserves standard output for the file that the command writes; everything else is then printed on standard error.
pub(super) fn give_to_file() {
    IS_FILE.store(true, Ordering::Relaxed);
}

/// Description of one file, as text or as JSON values (one per state of a dataset file).
pub(super) enum Content {
    /// Description as text.
    Text(String),
    /// Description as JSON values.
    Json(Vec<Value>),
}

impl Content {
    /// Creates the description: as JSON from `json` if `as_json`, else as text from `text`.
    pub(super) fn of(as_json: bool, json: impl FnOnce() -> Value, text: impl FnOnce() -> String) -> Self {
        if as_json { Self::Json(vec![json()]) } else { Self::Text(text()) }
    }
}

/// Prints data (CSV, JSON, templates) on standard output, with control characters made visible; a closed pipe is not an
/// error.
pub(super) fn print(text: &str) -> anyhow::Result<()> {
    print_bytes(visible(text).as_bytes())
}

/// Prints bytes on standard output, without making control characters visible.
pub(super) fn print_bytes(bytes: &[u8]) -> anyhow::Result<()> {
    if IS_FILE.load(Ordering::Relaxed) {
        // If standard error cannot be written, the failure cannot be reported, as in `to_stderr`.
        drop(std::io::stderr().lock().write_all(bytes));
        return Ok(());
    }
    match std::io::stdout().lock().write_all(bytes) {
        Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        other => other.context("standard output"),
    }
}

/// Prints a text for people on standard output, like [`print()`] but with long numbers shortened.
pub(super) fn print_text(text: &str) -> anyhow::Result<()> {
    print(&short_numbers(text))
}

/// Prints a message on standard error as one line, without control characters of quoted texts.
pub(super) fn to_stderr(text: std::fmt::Arguments<'_>) {
    // If standard error cannot be written, the failure cannot be reported.
    drop(writeln!(std::io::stderr().lock(), "{}", message(&text.to_string())));
}

/// Prints an error with its causes on standard error as one line, without control characters of quoted texts.
pub fn report_error(error: &anyhow::Error) {
    to_stderr(format_args!("cfs: {}", sentence(error)));
}

/// Returns an error with its causes as one sentence, without repetitions.
pub(super) fn sentence(error: &anyhow::Error) -> String {
    let mut text = String::new();
    for cause in error.chain().map(ToString::to_string) {
        if text.is_empty() {
            text = cause;
        } else if !text.contains(&cause) {
            text = format!("{text}: {cause}");
        }
    }
    message(&text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_says_nothing_twice_and_commands_nothing() {
        let error = anyhow::anyhow!("disk full").context("cannot write: disk full").context("\u{1b}[31mfile\nname");
        assert_eq!(sentence(&error), "\\u001b[31mfile name: cannot write: disk full");
    }

    #[test]
    fn numbers_keep_nine_digits() {
        assert_eq!(number(0.5), "0.5");
        assert_eq!(number(1_234.567_891_23), "1234.56789");
        assert_eq!(number(0.0), "0");
        assert_eq!(number(1.0e-5), "0.00001");
        assert_eq!((&*number(1e300), &*number(-1.25e20)), ("1e300", "-1.25000000e20"));
    }
}
