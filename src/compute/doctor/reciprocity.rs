//! Check of reciprocity between the transmissions of both sides. The result is a grade, not pass or fail: measured data
//! of fabrics deviate by 20 to 60 %.

use super::at::At;
use super::diagnosis::Diagnosis;
use crate::compute::btdf::{Component, Finding, reciprocity_error};

/// Returns the reciprocity error of a band, the relative mean difference between the transmissions of both sides, one
/// of them with the light reversed; `None` unless the source has both.
pub(super) fn of(at: &At) -> Option<f64> {
    let derived = &at.dataset.derived;
    if derived.contains(&Component::TransmissionFront) || derived.contains(&Component::TransmissionBack) {
        return None;
    }
    reciprocity_error(at.band.transmission_front.as_ref()?, at.band.transmission_back.as_ref()?)
}

/// Returns a finding that states the reciprocity error of a band with its grade.
pub(super) fn check(at: &At) -> Option<Diagnosis> {
    let error = of(at)?;
    let (grade, remark) = match error {
        ..0.02 => ("excellent", ""),
        ..0.1 => ("good", ""),
        ..0.3 => ("fair", ", as measured fabrics have it"),
        _ => ("poor", ", as measured fabrics may have it"),
    };
    let message = format!(
        "Reciprocity of the {} transmission is {grade}: both sides differ by {:.1} % on average{remark}.",
        at.name,
        100.0 * error
    );
    let finding =
        if error > 0.3 { Finding::warning("reciprocity", message) } else { Finding::info("reciprocity", message) };
    Some(finding.into())
}
