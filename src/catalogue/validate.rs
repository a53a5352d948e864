//! Checks of every dataset before it is stored.

use crate::compute::btdf::{Dataset, Finding};
use crate::compute::doctor;

/// Returns the findings of the data check beyond the dataset's own findings.
pub fn check(dataset: &Dataset) -> Vec<Finding> {
    doctor::findings(dataset).into_iter().filter(|finding| !dataset.findings.contains(finding)).collect()
}
