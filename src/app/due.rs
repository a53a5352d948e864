//! Computations that are due as soon as their results are visible.

use super::jobs::Lane;
use crate::study::scene_file::{BoxKeys, RoomKeys, SceneFile, SensorKeys, SurfaceKey};
use std::collections::BTreeSet;

/// Part of the scene that the sensor weights depend on. A new sky, sun or system does not change them.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    room: RoomKeys,
    openings: Vec<(SurfaceKey, [f64; 2], [f64; 2])>,
    sensors: SensorKeys,
    outside: Vec<BoxKeys>,
}

impl Geometry {
    /// Creates the geometry of a scene.
    pub fn of(scene: &SceneFile) -> Self {
        let openings = scene.aperture.iter().map(|one| (one.surface, one.origin, one.size)).collect();
        let outside = scene.outside.iter().map(|one| one.solid).collect();
        Self { room: scene.room, openings, sensors: scene.sensors.clone(), outside }
    }
}

/// Computations that are due.
#[derive(Debug, Default)]
pub struct Due {
    /// Lanes that are due.
    pub lanes: BTreeSet<Lane>,
    /// Geometry for which all sensor points were last computed.
    pub geometry: Option<Geometry>,
    /// Whether the result that is shown or being computed has fewer sensor points; all of them follow.
    pub coarse: bool,
    /// Whether a preview of the room has been shown. Behind obstructions a preview comes first.
    pub previewed: bool,
}

impl Due {
    /// Marks a lane as due.
    pub fn owe(&mut self, lane: Lane) {
        self.lanes.insert(lane);
    }

    /// Whether a lane is still due.
    pub fn owes(&self, lane: Lane) -> bool {
        self.lanes.contains(&lane)
    }
}
