//! Checks of every dataset before it is stored.

use crate::compute::btdf::{Dataset, Finding};
use crate::compute::doctor;

/// Checks the data of a dataset, and returns the findings that the dataset does not have already.
pub fn check(dataset: &Dataset) -> Vec<Finding> {
    doctor::findings(dataset).into_iter().filter(|finding| !dataset.findings.contains(finding)).collect()
}
