//! Findings of the data check with the repairs that are offered for them.

use super::repair::{BandScope, Repair};
use crate::compute::btdf::{Finding, Severity};

/// Confidence with which the data check suspects a fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Confidence {
    /// Suspicion whose numbers other explanations fit as well.
    Possible,
    /// Suspicion that the data support.
    Likely,
    /// Suspicion without any other explanation of the numbers.
    Certain,
}

impl Confidence {
    /// Returns the word for this confidence in messages, e.g. "probably".
    pub const fn word(self) -> &'static str {
        match self {
            Self::Possible => "possibly",
            Self::Likely => "probably",
            Self::Certain => "almost certainly",
        }
    }

    /// Returns the severity of a finding about a fault that is suspected with this confidence: only a certain fault
    /// makes a dataset unfit for use (an error).
    pub const fn severity(self) -> Severity {
        match self {
            Self::Possible | Self::Likely => Severity::Warning,
            Self::Certain => Severity::Error,
        }
    }
}

/// Finding about a dataset with the repair that is offered for it.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// Finding about the dataset.
    pub finding: Finding,
    /// Repair of the fault that the finding reports, where it is safe to offer one.
    pub repair: Option<Repair>,
    /// Whether the repair is certain to be right. Only certain repairs may be made without the user's consent to each.
    pub sure: bool,
}

impl From<Finding> for Diagnosis {
    fn from(finding: Finding) -> Self {
        Self { finding, repair: None, sure: false }
    }
}

impl Diagnosis {
    /// Creates a finding about a suspected fault, without a repair; its severity follows from the confidence.
    pub(super) fn suspicion(confidence: Confidence, code: &'static str, message: String) -> Self {
        Finding { severity: confidence.severity(), code, message }.into()
    }

    /// Returns a copy with a repair, which counts as certain if the finding is an error.
    pub(super) fn with(mut self, repair: Repair) -> Self {
        self.repair = Some(repair);
        self.sure = self.finding.severity == Severity::Error;
        self
    }

    /// Returns a copy with a repair that never counts as certain: only somebody who knows the product can decide on it,
    /// however certain the finding is.
    pub(super) fn asking(mut self, repair: Repair) -> Self {
        self.repair = Some(repair);
        self.sure = false;
        self
    }
}

/// Merges the findings of both bands: a finding with the same repair in both is stated once, and its repair covers both
/// bands.
pub(super) fn merged(mut visible: Vec<Diagnosis>, solar: Vec<Diagnosis>) -> Vec<Diagnosis> {
    for other in solar {
        let kind = |one: &Diagnosis| one.repair.map(|repair| (repair.kind, repair.blocks));
        let twin = visible.iter_mut().find(|one| {
            one.finding.code == other.finding.code
                && one.finding.severity == other.finding.severity
                && one.sure == other.sure
                && one.repair.is_some()
                && kind(one) == kind(&other)
        });
        match twin {
            Some(one) => {
                one.finding.message.push_str(" The solar band shows the same.");
                if let Some(repair) = &mut one.repair {
                    repair.bands = BandScope::Both;
                }
            }
            None => visible.push(other),
        }
    }
    visible
}
