//! What a reader or a check has to say about a dataset: structured, so that the window, `info` and tests share it.

/// How much a finding matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing; results are not affected.
    Info,
    /// Results may be affected; read the message.
    Warning,
    /// Not fit for use.
    Error,
}

impl Severity {
    /// The word used in files and JSON.
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
    /// How much it matters.
    pub severity: Severity,
    /// Stable identifier in kebab case, e.g. `energy-above-one`.
    pub code: &'static str,
    /// What was found, where, and what it means. One sentence, units included.
    pub message: String,
}

impl Finding {
    /// Worth knowing.
    pub fn info(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Info, code, message: message.into() }
    }

    /// May affect results.
    pub fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, code, message: message.into() }
    }

    /// Not fit for use.
    pub fn error(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Error, code, message: message.into() }
    }
}
