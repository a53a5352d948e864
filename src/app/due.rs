//! What is to be computed as soon as it is in sight.

use super::jobs::Lane;
use crate::study::scene_file::{BoxKeys, RoomKeys, SceneFile, SensorKeys, SurfaceKey};
use std::collections::BTreeSet;

/// What the sensors' weights hang on: another sky, sun or system costs next to nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    room: RoomKeys,
    openings: Vec<(SurfaceKey, [f64; 2], [f64; 2])>,
    sensors: SensorKeys,
    outside: Vec<BoxKeys>,
}

impl Geometry {
    /// Of a scene.
    pub fn of(scene: &SceneFile) -> Self {
        let openings = scene.aperture.iter().map(|one| (one.surface, one.origin, one.size)).collect();
        let outside = scene.outside.iter().map(|one| one.solid).collect();
        Self { room: scene.room, openings, sensors: scene.sensors.clone(), outside }
    }
}

/// What is to be computed.
#[derive(Debug, Default)]
pub struct Due {
    /// By lane.
    pub lanes: BTreeSet<Lane>,
    /// Of what room the sensors were last computed in full.
    pub geometry: Option<Geometry>,
    /// Of fewer sensors, in a job or already shown: all of them follow.
    pub coarse: bool,
    /// Has a preview of the room been shown? Behind obstructions one comes first.
    pub previewed: bool,
}

impl Due {
    /// Something is to be computed anew.
    pub fn owe(&mut self, lane: Lane) {
        self.lanes.insert(lane);
    }

    /// Is it still to be asked for?
    pub fn owes(&self, lane: Lane) -> bool {
        self.lanes.contains(&lane)
    }
}
