//! Why nothing can be handed on.

use crate::texts::Text;

/// Why nothing can be handed on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReportError {
    /// A tile has nothing to show: which, and why.
    #[error("{0}: {1}")]
    Nothing(Text, String),
    /// A size that is none: as typed, and why.
    #[error("size \"{0}\": {1}; expected e.g. 1600x1200 (pixels) or 160x120mm")]
    Size(String, &'static str),
    /// A tender text that is no template: its line (from 1), and what is wrong.
    #[error("tender text, line {0}: {1}")]
    Template(usize, String),
    /// The PDF could not be made.
    #[error("the PDF could not be made: {0}")]
    Pdf(String),
}
