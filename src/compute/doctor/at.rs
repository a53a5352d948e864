//! The band under examination, and the names of its functions.

use super::repair::{BandScope, BlockScope, Repair, RepairKind};
use crate::compute::btdf::{Band, Component, Dataset};

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

/// The name of a function as files write it.
pub(super) const fn words(component: Component) -> &'static str {
    match component {
        Component::TransmissionFront => "Transmission Front",
        Component::TransmissionBack => "Transmission Back",
        Component::ReflectionFront => "Reflection Front",
        Component::ReflectionBack => "Reflection Back",
    }
}
