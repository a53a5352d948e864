//! Findings of a reader or a check on a dataset: structured, so that the window, `info` and tests share them.

/// Severity of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Information; results are not affected.
    Info,
    /// Possible effect on results; read the message.
    Warning,
    /// Data not fit for use.
    Error,
}

impl Severity {
    /// Returns the key used in files and JSON.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Info => "info",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

/// One finding about a dataset.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Severity of the finding.
    pub severity: Severity,
    /// Stable identifier in kebab case, e.g. `energy-above-one`.
    pub code: &'static str,
    /// Message on the finding, its place and its meaning. One sentence, units included.
    pub message: String,
}

impl Finding {
    /// Creates a finding that is worth knowing and does not affect results.
    pub fn info(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Info, code, message: message.into() }
    }

    /// Creates a finding that may affect results.
    pub fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, code, message: message.into() }
    }

    /// Creates a finding that makes the data unfit for use.
    pub fn error(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Error, code, message: message.into() }
    }
}
