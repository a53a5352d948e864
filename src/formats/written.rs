//! Result of every writer of a dataset format.

use crate::compute::btdf::Finding;

/// Written file, with findings on what was lost or changed.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// Bytes of the file.
    pub bytes: Vec<u8>,
    /// Findings on resampling, derived blocks: whatever a reader of the new file would not see.
    pub findings: Vec<Finding>,
}
