//! Positions of errors in files, and the error that every reader returns.

use super::encoding::{Encoding, NotText, RAW_FILE, TooLong};
use crate::compute::limits;
use crate::texts::message;
use std::fmt;

/// Position in a file, as exactly as the reader knows it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Location {
    /// Line number, from 1; `None` if unknown.
    pub line: Option<usize>,
    /// Column in characters, from 1; `None` if unknown.
    pub column: Option<usize>,
    /// Offset in bytes, from 0; `None` if unknown.
    pub byte: Option<usize>,
    /// Name of the element, block or key, as written in the file; `None` if unknown.
    pub element: Option<String>,
}

impl Location {
    /// Returns a position that means the whole file.
    pub fn file() -> Self {
        Self::default()
    }

    /// Returns the position of a line, counted from 1.
    pub fn line(line: usize) -> Self {
        Self { line: Some(line), ..Self::default() }
    }

    /// Returns the position of a line and a column, both counted from 1.
    pub fn line_column(line: usize, column: usize) -> Self {
        Self { line: Some(line), column: Some(column), ..Self::default() }
    }

    /// Returns the position of a byte offset, counted from 0.
    pub fn byte(byte: usize) -> Self {
        Self { byte: Some(byte), ..Self::default() }
    }

    /// Returns the position with the name of the element, block or key added.
    #[must_use]
    pub fn in_element(mut self, element: impl Into<String>) -> Self {
        self.element = Some(element.into());
        self
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        if let Some(line) = self.line {
            parts.push(format!("line {line}"));
        }
        if let Some(column) = self.column {
            parts.push(format!("column {column}"));
        }
        if let Some(byte) = self.byte {
            parts.push(format!("byte {byte}"));
        }
        if let Some(element) = &self.element {
            parts.push(element.clone());
        }
        if parts.is_empty() { f.write_str("file") } else { f.write_str(&parts.join(", ")) }
    }
}

/// Error of a file's reader: position, what was found, what was expected. The caller adds the name of the file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{at}: {found}; expected {expected}")]
pub struct FormatError {
    /// Position of the error in the file.
    pub at: Location,
    /// Text of the message: what was found at the position.
    pub found: String,
    /// Text of the message: what was expected.
    pub expected: String,
}

impl FormatError {
    /// Creates the error from position, finding and expectation, as text that can be shown in a terminal: on one line,
    /// without control characters.
    pub fn new(at: Location, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { at, found: short(message(&found.into())), expected: short(message(&expected.into())) }
    }
}

impl From<TooLong> for FormatError {
    fn from(error: TooLong) -> Self {
        Self::new(
            Location::file(),
            format!("a text of {} bytes", error.0),
            format!("at most {} bytes", limits::TEXT_BYTES),
        )
    }
}

impl From<NotText> for FormatError {
    fn from(error: NotText) -> Self {
        let found = error.encoding.name();
        match error.encoding {
            Encoding::WebPage => Self::new(Location::file(), found, RAW_FILE),
            _ => Self::new(Location::line(error.line), found, "text saved as UTF-8"),
        }
    }
}

/// Shortens a message that quotes text of a file, which may have any length.
pub(crate) fn short(mut text: String) -> String {
    const MOST: usize = 900;
    if let Some((at, _)) = text.char_indices().nth(MOST) {
        text.truncate(at);
        text.push('…');
    }
    text
}

/// Returns up to 40 characters of a file's text without control characters, for quoting in messages.
pub(crate) fn excerpt(text: &str) -> String {
    let clean: String = text.trim().chars().filter(|c| !c.is_control()).take(41).collect();
    if clean.chars().count() > 40 { clean.chars().take(40).collect::<String>() + "…" } else { clean }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn says_everything_on_one_line() {
        let at = Location::line_column(12, 3).in_element("<ScatteringData>");
        let error = FormatError::new(at, "'a\nb'", "a number");
        assert_eq!(error.to_string(), "line 12, column 3, <ScatteringData>: 'a b'; expected a number");
        assert_eq!(FormatError::new(Location::file(), "nothing", "data").to_string(), "file: nothing; expected data");
    }
}
