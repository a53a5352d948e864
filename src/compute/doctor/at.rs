//! Context of the checks of one band: dataset, band, its name and its scope.

use super::repair::{BandScope, BlockScope, Repair, RepairKind};
use crate::compute::btdf::{Band, Dataset};

/// Band under examination, with its dataset, its name in messages and its scope in repairs.
pub(super) struct At<'a> {
    pub(super) dataset: &'a Dataset,
    pub(super) band: &'a Band,
    pub(super) name: &'a str,
    pub(super) scope: BandScope,
}

impl At<'_> {
    /// Returns a repair of this band.
    pub(super) fn repair(&self, kind: RepairKind, blocks: BlockScope) -> Repair {
        Repair { kind, bands: self.scope, blocks }
    }
}
