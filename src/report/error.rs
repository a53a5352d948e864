//! Errors of exporting pictures and reports.

use crate::texts::{Text, export as texts};

/// Error of an export.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReportError {
    /// Tile that has nothing to show: its name, and the reason.
    #[error("{0}: {1}")]
    Nothing(Text, String),
    /// Size that is not valid: the typed text, and the reason.
    #[error("{}", texts::wrong_size(.0, .1))]
    Size(String, Text),
    /// Tender text that is not a valid template: its line (from 1), and what is wrong.
    #[error("{}", texts::wrong_template(.0, .1))]
    Template(usize, String),
    /// PDF that could not be made, with the reason.
    #[error("{}", texts::no_pdf(.0))]
    Pdf(String),
}
