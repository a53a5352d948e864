//! Result of writing a dataset file.

use crate::compute::btdf::Finding;

/// Content of a written dataset file, with findings on data that were lost or changed.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// Bytes of the file.
    pub bytes: Vec<u8>,
    /// Findings on changes that a reader of the file would not see, e.g. resampling and derived functions.
    pub findings: Vec<Finding>,
}
