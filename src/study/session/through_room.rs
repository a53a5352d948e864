//! Interreflected light at the sensors by the surfaces of the room alone: apertures that reflect by direction count as
//! black.

use super::weights::{ByCells, Response, TOGETHER};
use super::{Session, basis_key};
use crate::compute::basis::RingBasis;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::nodes::Nodes;
use crate::compute::room::patch_weights::PatchWeights;
use crate::compute::room::radiosity::Radiosity;
use crate::study::cache::Key;
use half::bf16;
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;

/// Responses of all sensors to light on the patches of the room, by the room's surfaces alone.
pub(super) struct ThroughRoom {
    /// Room with its interreflection solved (factored).
    pub radiosity: Arc<Radiosity>,
    /// Responses of the sensors to the first illuminance of each patch, in the order of the scene.
    pub sensors: Arc<Vec<Response>>,
    /// Key of the room in caches.
    pub key: Key,
    /// Key of the room's patches in caches, without reflectances.
    pub mesh_key: Key,
    /// Positions and sizes of the apertures.
    pub geometry: Vec<Aperture>,
    /// Key of the sensors in caches.
    pub sensor_key: Key,
}

/// Returns the weights of a sensor's response: those of its value, and with `with_uncertainty` those of its walls.
fn lists(sensor: &Response, with_uncertainty: bool) -> impl Iterator<Item = Cow<'_, [f64]>> {
    let walls = sensor.walls.iter().filter(move |_| with_uncertainty);
    let wide = |wall: &Vec<bf16>| Cow::Owned(wall.iter().map(|&weight| f64::from(weight)).collect());
    std::iter::once(Cow::Borrowed(&sensor.value[..])).chain(walls.map(wide))
}

impl ThroughRoom {
    /// Returns the weights with which the patches of the room receive light from an aperture by the cells of a basis.
    pub fn weights(&self, session: &Session, index: usize, basis: &Arc<RingBasis>) -> Arc<PatchWeights> {
        session.patch_weights(&self.mesh_key, &self.radiosity.nested.fine, &self.geometry[index], basis)
    }

    /// Returns the interreflected illuminances at the sensors per luminance of an aperture's cells, by the room alone;
    /// computed or stored. `with_uncertainty`: whether the differences of the meshes are included.
    pub fn through_room(
        &self,
        session: &Session,
        index: usize,
        basis: &Arc<RingBasis>,
        with_uncertainty: bool,
    ) -> Arc<ByCells> {
        let find = || self.by_cells(&self.weights(session, index, basis), with_uncertainty);
        session.by_cells.find(self.cells_key(index, basis, with_uncertainty), find)
    }

    /// Returns the interreflected illuminances at the sensors per luminance of an aperture's cells for each node of the
    /// aperture, for light that is 1 at that node and 0 at the others; computed or stored.
    pub fn through_room_by_node(
        &self,
        session: &Session,
        index: usize,
        basis: &Arc<RingBasis>,
        with_uncertainty: bool,
        nodes: &Nodes,
    ) -> Arc<Vec<ByCells>> {
        let find = || {
            let all = PatchWeights::by_node(&self.radiosity.nested.fine, &self.geometry[index], basis, nodes);
            all.iter().map(|weights| self.by_cells(weights, with_uncertainty)).collect()
        };
        session.by_nodes.find(self.cells_key(index, basis, with_uncertainty), find)
    }

    fn cells_key(&self, index: usize, basis: &RingBasis, with_uncertainty: bool) -> Key {
        let mut key = [&self.key[..], &self.sensor_key].concat();
        key.extend([index as u64, u64::from(with_uncertainty)]);
        key.extend(basis_key(Some(basis)));
        key
    }

    /// Computes the illuminances at the sensors per luminance of an aperture's cells. `weights`: weights with which the
    /// patches receive its light.
    fn by_cells(&self, weights: &PatchWeights, with_uncertainty: bool) -> ByCells {
        let block = |sensors: &[Response]| {
            let all: Vec<Cow<'_, [f64]>> = sensors.iter().flat_map(|sensor| lists(sensor, with_uncertainty)).collect();
            let mut found = weights.gathered(&all.iter().map(|list| &list[..]).collect::<Vec<_>>()).into_iter();
            let narrow = |wall: Vec<f64>| wall.into_iter().map(bf16::from_f64).collect();
            let one = |sensor: &Response| {
                let value = found.next().expect("a list has its sums");
                let count = if with_uncertainty { sensor.walls.len() } else { 0 };
                (value, found.by_ref().take(count).map(narrow).collect::<Vec<_>>())
            };
            sensors.iter().map(one).collect::<Vec<_>>()
        };
        let (value, walls) = self.sensors.par_chunks(TOGETHER).flat_map_iter(block).unzip();
        ByCells { value, walls }
    }
}
