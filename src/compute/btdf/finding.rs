//! Findings of a file reader or a data check on a dataset, in structured form for the window, the command line and
//! tests.

/// Severity of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Information that does not affect results.
    Info,
    /// Warning: results may be affected.
    Warning,
    /// Error: the data are not fit for use.
    Error,
}

impl Severity {
    /// Returns the key of the severity in files and JSON.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Info => "info",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

/// Finding: remark of a file reader or a data check on a dataset.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Severity of the finding.
    pub severity: Severity,
    /// Stable identifier in kebab case, e.g. `energy-above-one`.
    pub code: &'static str,
    /// English sentence that names the finding, its place and its meaning, with units.
    pub message: String,
}

impl Finding {
    /// Creates an informative finding that does not affect results. `code`: stable identifier in kebab case.
    pub fn info(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Info, code, message: message.into() }
    }

    /// Creates a warning: a finding that may affect results. `code`: stable identifier in kebab case.
    pub fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, code, message: message.into() }
    }

    /// Creates an error: a finding that makes the data unfit for use. `code`: stable identifier in kebab case.
    pub fn error(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Error, code, message: message.into() }
    }
}
