//! Errors in the export of pictures and reports.

use crate::texts::{Text, export as texts};

/// Error in the export of a picture or report.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReportError {
    /// Tile that has nothing to show for the scene: its name, and the reason.
    #[error("{0}: {1}")]
    Nothing(Text, String),
    /// Size of a picture that is not valid: the typed text, and the reason.
    #[error("{}", texts::wrong_size(.0, .1))]
    Size(String, Text),
    /// Template of a tender text that is not valid: line number (from 1), and description of the problem.
    #[error("{}", texts::wrong_template(.0, .1))]
    Template(usize, String),
    /// PDF that could not be created: the reason.
    #[error("{}", texts::no_pdf(.0))]
    Pdf(String),
}
