//! Directions relative to the scene's façade or roof.

use super::moment;
use super::scene_file::{SceneFile, SurfaceKey};
use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, Facade, Incident, Orientation, Surface, World};
use std::path::Path;

/// Returns the surface of an aperture of the scene; the façade if there is no such aperture.
pub fn surface_of(scene: &SceneFile, aperture: usize) -> Surface {
    match scene.aperture.get(aperture).map(|aperture| aperture.surface) {
        Some(SurfaceKey::Roof) => Surface::Roof,
        _ => Surface::Facade,
    }
}

/// Returns the surface of the scene's first aperture.
pub fn surface(scene: &SceneFile) -> Surface {
    surface_of(scene, 0)
}

/// Returns a world direction relative to the façade.
pub fn incident(scene: &SceneFile, altitude: f64, bearing: Bearing) -> Dir<Facade> {
    let orientation = Orientation::new(Bearing::from_degrees(scene.site.azimuth));
    surface(scene).facade_dir(orientation.room_from_world(Dir::<World>::from_altitude_bearing(altitude, bearing)))
}

/// Returns the incident direction of the sun, if it is up and in front of the first aperture's surface.
pub fn sun_incident(scene: &SceneFile, base: &Path) -> Option<Incident> {
    let (altitude, bearing) = moment::sun(scene, base)?;
    let direction = incident(scene, altitude, Bearing::from_degrees(bearing));
    (altitude > 0.0 && direction.vector().z > 0.0).then_some(Incident(direction))
}
