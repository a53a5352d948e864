//! What sensors get by way of the room alone: apertures that reflect by direction are black to it.

use super::weights::{ByCells, Response};
use super::{Session, basis_key};
use crate::compute::basis::RingBasis;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::patch_weights::PatchWeights;
use crate::compute::room::radiosity::Radiosity;
use crate::study::cache::Key;
use rayon::prelude::*;
use std::sync::Arc;

/// Weights of all sensors, and the room that they belong to.
pub(super) struct ThroughRoom {
    /// The balance.
    pub radiosity: Arc<Radiosity>,
    /// In the order of the scene.
    pub sensors: Arc<Vec<Response>>,
    /// The room's key.
    pub key: Key,
    /// The apertures.
    pub geometry: Vec<Aperture>,
    /// The sensors' key.
    pub sensor_key: Key,
}

impl ThroughRoom {
    /// What the patches receive from an aperture by the cells of a basis.
    pub fn weights(&self, session: &Session, index: usize, basis: &Arc<RingBasis>) -> Arc<PatchWeights> {
        session.patch_weights(&self.key, &self.radiosity.nested.fine, index, &self.geometry, basis)
    }

    /// The sensors' weights of the luminance of an aperture's cells, by way of the room alone; without `doubts` values
    /// only.
    pub fn through_room(&self, session: &Session, index: usize, basis: &Arc<RingBasis>, doubts: bool) -> Arc<ByCells> {
        let mut key = [&self.key[..], &self.sensor_key].concat();
        key.extend([index as u64, u64::from(doubts)]);
        key.extend(basis_key(Some(basis)));
        let compute = || {
            let weights = self.weights(session, index, basis);
            let value = self.sensors.par_iter().map(|sensor| weights.gathered(&sensor.value)).collect();
            let walls = |sensor: &Response| sensor.walls.iter().map(|wall| weights.gathered(wall)).collect();
            let walls = if doubts { self.sensors.par_iter().map(walls).collect() } else { Vec::new() };
            Ok::<_, std::convert::Infallible>(ByCells { value, walls })
        };
        match session.by_cells.get(key, compute) {
            Ok(by_cells) => by_cells,
            Err(never) => match never {},
        }
    }
}
