//! Why nothing can be handed on.

use crate::texts::{Text, hand_on as texts};

/// Why nothing can be handed on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReportError {
    /// A tile has nothing to show: which, and why.
    #[error("{0}: {1}")]
    Nothing(Text, String),
    /// A size that is none: as typed, and why.
    #[error("{}", texts::wrong_size(.0, .1))]
    Size(String, Text),
    /// A tender text that is no template: its line (from 1), and what is wrong.
    #[error("{}", texts::wrong_template(.0, .1))]
    Template(usize, String),
    /// The PDF could not be made.
    #[error("{}", texts::no_pdf(.0))]
    Pdf(String),
}
