//! Light at a scene's aperture: sun paths over the hemisphere, and the split of the transmitted flux.

use super::facing::incident;
use super::moment;
use super::scene_file::SceneFile;
use super::sun_position::{Place, sun_path};
use crate::compute::btdf::{Btdf, zone_shares};
use crate::compute::direction::{Incident, Surface};
use crate::drawing::flux_split::FluxSplit;
use glam::DVec3;

/// Elevations between the zones of the flux split, from top to bottom. \[°\]
const LIMITS: [f64; 3] = [10.0, -10.0, -45.0];

/// Hours of a day with the incident directions of the sun.
pub type SunPath = Vec<(f64, Incident)>;
/// Returns the sun on the 21st of each month while it is up, by hours; positions behind the façade divide a path in
/// two.
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

/// Returns the shares of the light from one direction that reach the zones; their sum is τ.
pub fn flux_split(btdf: &Btdf, incident: Incident, surface: Surface) -> FluxSplit {
    let up = surface.facade_from_room(DVec3::Z);
    let shares = zone_shares(btdf, incident, up, LIMITS.map(f64::to_radians));
    FluxSplit { ceiling: shares[0], eye_zone: shares[1], work_zone: shares[2], floor: shares[3] }
}
