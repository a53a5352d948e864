//! Context of the checks of one band: dataset, band, its name and its scope.

use super::repair::{BandScope, BlockScope, Repair, RepairKind};
use crate::compute::btdf::{Band, Dataset};

/// Spectral band under examination, with its dataset, its name in messages and its scope in repairs.
pub(super) struct At<'a> {
    /// Dataset that the band belongs to.
    pub(super) dataset: &'a Dataset,
    /// Functions of the band under examination.
    pub(super) band: &'a Band,
    /// Name of the band in messages, "visible" or "solar".
    pub(super) name: &'a str,
    /// Band that repairs of it cover.
    pub(super) scope: BandScope,
}

impl At<'_> {
    /// Returns the repair of the given kind for the functions `blocks` of this band.
    pub(super) fn repair(&self, kind: RepairKind, blocks: BlockScope) -> Repair {
        Repair { kind, bands: self.scope, blocks }
    }
}
