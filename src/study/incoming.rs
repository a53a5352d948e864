//! Light at a scene's aperture: paths of the sun over the hemisphere of incident directions, and the split of the
//! transmitted flux by zones of the room.

use super::facing::incident;
use super::moment;
use super::scene_file::SceneFile;
use super::sun_position::{Place, sun_path};
use crate::compute::btdf::{Btdf, zone_shares};
use crate::compute::direction::{Incident, Surface};
use crate::drawing::flux_split::FluxSplit;
use glam::DVec3;

/// Elevations of emergent directions that divide the zones of the flux split: ceiling above the first, then eyes, work
/// plane, and floor below the last. \[°\]
const LIMITS: [f64; 3] = [10.0, -10.0, -45.0];

/// Path of the sun over a day: hours of local standard time, each with the incident direction of the sun.
pub type SunPath = Vec<(f64, Incident)>;
/// Returns the paths of the sun on the 21st of each month while it is up, in steps of a quarter of an hour. Incident
/// directions behind the façade are included.
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

/// Returns the shares of the light incident from one direction that leave towards the zones of the room: ceiling, eyes,
/// work plane and floor. Their sum is the transmittance τ. `surface`: whether the aperture is in the façade or the
/// roof.
pub fn flux_split(btdf: &Btdf, incident: Incident, surface: Surface) -> FluxSplit {
    let up = surface.facade_from_room(DVec3::Z);
    let shares = zone_shares(btdf, incident, up, LIMITS.map(f64::to_radians));
    FluxSplit { ceiling: shares[0], eye_zone: shares[1], work_zone: shares[2], floor: shares[3] }
}
