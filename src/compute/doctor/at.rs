//! The band under examination.

use super::repair::{BandScope, BlockScope, Repair, RepairKind};
use crate::compute::btdf::{Band, Dataset};

/// The band under examination.
pub(super) struct At<'a> {
    pub(super) dataset: &'a Dataset,
    pub(super) band: &'a Band,
    pub(super) name: &'a str,
    pub(super) scope: BandScope,
}

impl At<'_> {
    /// A repair of this band.
    pub(super) fn repair(&self, kind: RepairKind, blocks: BlockScope) -> Repair {
        Repair { kind, bands: self.scope, blocks }
    }
}
