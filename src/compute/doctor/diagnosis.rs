//! A finding with the repair that is offered for it.

use super::repair::{BandScope, Repair};
use crate::compute::btdf::{Finding, Severity};

/// How sure a suspicion is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Confidence {
    /// Other explanations are as good.
    Possible,
    /// The data speak for it.
    Likely,
    /// Nothing else explains the numbers.
    Certain,
}

impl Confidence {
    /// The word in messages.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Possible => "possibly",
            Self::Likely => "probably",
            Self::Certain => "almost certainly",
        }
    }

    /// What a fault of this confidence is worth: only what is beyond doubt makes a dataset unfit for use.
    pub const fn severity(self) -> Severity {
        match self {
            Self::Possible | Self::Likely => Severity::Warning,
            Self::Certain => Severity::Error,
        }
    }
}

/// A finding and the repair that is offered.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// What was found.
    pub finding: Finding,
    /// What would mend it, where that is safe to offer.
    pub repair: Option<Repair>,
    /// Is the repair beyond doubt? Only such repairs may be made without being asked for one by one.
    pub sure: bool,
}

impl From<Finding> for Diagnosis {
    fn from(finding: Finding) -> Self {
        Self { finding, repair: None, sure: false }
    }
}

impl Diagnosis {
    /// A suspicion of the given confidence.
    pub(super) fn suspicion(confidence: Confidence, code: &'static str, message: String) -> Self {
        Finding { severity: confidence.severity(), code, message }.into()
    }

    /// The same with a repair; beyond doubt where the finding is.
    pub(super) fn with(mut self, repair: Repair) -> Self {
        self.repair = Some(repair);
        self.sure = self.finding.severity == Severity::Error;
        self
    }

    /// The same with a repair that only somebody who knows the product can decide on, however sure the finding is.
    pub(super) fn asking(mut self, repair: Repair) -> Self {
        self.repair = Some(repair);
        self.sure = false;
        self
    }
}

/// Findings of both bands; what both show in the same way is said once and mended in both.
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
