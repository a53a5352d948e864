//! What every writer of a dataset format returns.

use crate::compute::btdf::Finding;

/// A written file, and what got lost or changed on the way.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// The file.
    pub bytes: Vec<u8>,
    /// Resampling, derived blocks: whatever a reader of the new file would not see.
    pub findings: Vec<Finding>,
}
