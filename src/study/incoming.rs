//! What a scene's light does at its aperture: the sun's paths over the hemisphere, and where transmitted light goes.

use super::facing::incident;
use super::moment;
use super::scene_file::SceneFile;
use super::sun_position::{Place, sun_path};
use crate::compute::btdf::{Btdf, zone_shares};
use crate::compute::direction::{Incident, Surface};
use crate::drawing::flux_split::FluxSplit;
use glam::DVec3;

/// Elevations between the zones of the flux split from top to bottom. \[°\]
const LIMITS: [f64; 3] = [10.0, -10.0, -45.0];

/// Hours of a day and where the sun is.
pub type SunPath = Vec<(f64, Incident)>;
/// The sun on the 21st of each month while it is up, by hours; places behind the façade part a path in two.
pub fn sun_paths(scene: &SceneFile, place: Option<Place>) -> Vec<SunPath> {
    let Some(place) = place else { return Vec::new() };
    let year = moment::of(scene).map_or(2026, |time| time.year());
    (1..=12)
        .map(|month| {
            let points = sun_path(&place, year, month, 21, 0.25).unwrap_or_default();
            points
                .into_iter()
                .filter(|point| point.altitude > 0.0)
                .map(|point| (point.hour, Incident(incident(scene, point.altitude, point.bearing))))
                .collect()
        })
        .collect()
}

/// Shares of the light from one direction that go to the zones; their sum is τ.
pub fn flux_split(btdf: &Btdf, incident: Incident, surface: Surface) -> FluxSplit {
    let up = surface.facade_from_room(DVec3::Z);
    let shares = zone_shares(btdf, incident, up, LIMITS.map(f64::to_radians));
    FluxSplit { ceiling: shares[0], eye_zone: shares[1], work_zone: shares[2], floor: shares[3] }
}
