//! Record of the computations that have to start as soon as their results are visible.

use crate::app::shell::jobs::Lane;
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
    /// Creates the geometry part of a scene.
    pub fn of(scene: &SceneFile) -> Self {
        let openings = scene.aperture.iter().map(|one| (one.surface, one.origin, one.size)).collect();
        let outside = scene.outside.iter().map(|one| one.solid).collect();
        Self { room: scene.room, openings, sensors: scene.sensors.clone(), outside }
    }
}

/// Record of the computations that are due, i.e. still to be started.
#[derive(Debug, Default)]
pub struct Due {
    /// Lanes whose computation is due.
    pub lanes: BTreeSet<Lane>,
    /// Geometry of the scene for which all sensor points were last computed.
    pub geometry: Option<Geometry>,
    /// Whether the illuminances that are shown or being computed are for fewer sensor points, a preliminary result.
    pub coarse: bool,
    /// Whether a preview of the illuminances has been shown, which precedes the accurate result if there are
    /// obstructions.
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
