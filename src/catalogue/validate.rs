//! What every dataset is asked before it is stored.

use crate::compute::btdf::{Dataset, Finding};
use crate::compute::doctor;

/// What the data doctor finds beyond the dataset's own findings.
pub fn check(dataset: &Dataset) -> Vec<Finding> {
    doctor::findings(dataset).into_iter().filter(|finding| !dataset.findings.contains(finding)).collect()
}
