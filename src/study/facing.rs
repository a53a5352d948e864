//! Directions in the frame of a scene's façade or roof.

use super::moment;
use super::scene_file::{SceneFile, SurfaceKey};
use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, Facade, Incident, Orientation, Surface, World};
use std::path::Path;

/// Returns the surface (façade or roof) of an aperture of the scene, by its index; the façade if there is no such
/// aperture.
pub fn surface_of(scene: &SceneFile, aperture: usize) -> Surface {
    match scene.aperture.get(aperture).map(|aperture| aperture.surface) {
        Some(SurfaceKey::Roof) => Surface::Roof,
        _ => Surface::Facade,
    }
}

/// Returns the surface (façade or roof) of the scene's first aperture.
pub fn surface(scene: &SceneFile) -> Surface {
    surface_of(scene, 0)
}

/// Returns the direction of a position in the sky in the façade frame of the scene. `altitude`: \[rad\]; `bearing`:
/// clockwise from north.
pub fn incident(scene: &SceneFile, altitude: f64, bearing: Bearing) -> Dir<Facade> {
    let orientation = Orientation::new(Bearing::from_degrees(scene.site.azimuth));
    surface(scene).facade_dir(orientation.room_from_world(Dir::<World>::from_altitude_bearing(altitude, bearing)))
}

/// Returns the incident direction of the sun on the scene's first aperture; `None` if the sun is down or behind its
/// surface. `base`: folder of the scene.
pub fn sun_incident(scene: &SceneFile, base: &Path) -> Option<Incident> {
    let (altitude, bearing) = moment::sun(scene, base)?;
    let direction = incident(scene, altitude, Bearing::from_degrees(bearing));
    (altitude > 0.0 && direction.vector().z > 0.0).then_some(Incident(direction))
}
