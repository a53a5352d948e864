//! Illuminances that follow the sun: as the clock moves, a typed 90 klx beam at sunrise would be untrue.

use super::moment;
use crate::compute::sky::availability::{Cover, typical_illuminances};
use crate::study::scene_file::{SceneFile, SkyModelKey};

/// Least diffuse illuminance that is set: below it (night) pictures would have nothing to scale by. \[lx\]
const LEAST_DIFFUSE: f64 = 1.0;

/// The cover that a CIE type stands for: 1–5 overcast, 6–10 partly cloudy, 11–15 clear, 16 overcast.
pub const fn cover(cie_type: u8) -> Cover {
    match cie_type {
        6..=10 => Cover::Partly,
        11..=15 => Cover::Clear,
        _ => Cover::Overcast,
    }
}

/// Sets diffuse and direct illuminance from the sun's altitude. Measured skies and Perez skies keep their numbers.
pub fn follow(scene: &mut SceneFile) {
    let kind = match scene.sky.model {
        SkyModelKey::Cie => cover(scene.sky.cie_type.unwrap_or(16)),
        model if model.takes_illuminances() => Cover::Overcast,
        _ => return,
    };
    let Some((altitude, _)) = moment::sun(scene) else { return };
    let (direct, diffuse) = typical_illuminances(kind, altitude);
    scene.sky.diffuse_horizontal = Some(diffuse.round().max(LEAST_DIFFUSE));
    scene.sky.sun.direct_normal = Some(direct.round());
}
