//! Scene file for one step of a year: states fixed, sky and sun of the step.

use super::steps::Steps;
use crate::study::control::year::Moving;
use crate::study::scene_file::{IlluminanceKey, SceneFile, SkyKeys, SkyModelKey, SunKeys, SystemKeys, TimeKey};
use crate::study::year_keys::YearKeys;

/// Returns the scene with the states of its moving apertures fixed, and without a year. `states`: indices of the
/// states, in the order of `moving`.
pub fn with_states(file: &SceneFile, moving: &[Moving], states: &[usize]) -> SceneFile {
    let mut scene = SceneFile { year: None, rank: None, ..file.clone() };
    for (one, &state) in moving.iter().zip(states) {
        put_state(&mut scene.aperture[one.aperture - 1].system, &one.device.keys[state]);
    }
    scene
}

/// Sets the state of a system that has states, by its key.
pub fn put_state(system: &mut SystemKeys, key: &str) {
    match system {
        SystemKeys::Catalogue { state, .. } | SystemKeys::File { state, .. } | SystemKeys::Family { state, .. } => {
            *state = Some(key.to_owned());
        }
        SystemKeys::Ideal { .. } | SystemKeys::Luminaires { .. } | SystemKeys::Ranked => {}
    }
}

/// Sets a sky with light that stands for those of the year: scenes that are prepared with it are evaluated under the
/// sky of each step later.
pub fn put_ordinary(scene: &mut SceneFile) {
    scene.sky = SkyKeys { cie_type: Some(16), diffuse_horizontal: Some(1e4), ..bare(scene, SkyModelKey::Cie) };
}

/// Returns the keys of a sky with only skyline and obstruction of the scene; all others are reset.
fn bare(scene: &SceneFile, model: SkyModelKey) -> SkyKeys {
    SkyKeys {
        model,
        weather: None,
        light: Default::default(),
        sun_offset_minutes: Default::default(),
        cie_type: None,
        illuminance: IlluminanceKey::Stated,
        diffuse_horizontal: None,
        sun: SunKeys::default(),
        time: None,
        direct_horizontal_irradiance: None,
        diffuse_horizontal_irradiance: None,
        file: None,
        ..scene.sky.clone()
    }
}

/// Sets sky and ground of the step `at`: as an hour of the weather file if the step is a whole interval of it, else
/// like [`put_at`].
pub fn put_hour(scene: &mut SceneFile, steps: &Steps, at: usize, keys: &YearKeys) {
    let index = |k: usize| steps.list.get(k).map(|step| step.hour.index);
    let parted = index(at + 1) == index(at) || at > 0 && index(at - 1) == index(at);
    let ground = scene.site.ground_reflectance;
    if parted {
        put_at(scene, steps, at);
    } else {
        let clock = scene.site.dst.clock(steps.list[at].time, steps.station.utc_offset);
        scene.sky = SkyKeys {
            weather: Some(keys.weather.clone()),
            light: keys.light,
            sun_offset_minutes: keys.sun_offset_minutes,
            time: Some(TimeKey::of(clock)),
            ..bare(scene, SkyModelKey::Weather)
        };
        scene.site.ground_reflectance = steps.ground(at);
    }
    // Without monthly values the scene's reflectance holds: it may have been edited since.
    if keys.ground.is_empty() {
        scene.site.ground_reflectance = ground;
    }
}

/// Sets sky, sun and ground of the step `at` by keys that do not need the weather file: model, irradiances and the
/// illuminances to which they are scaled.
pub fn put_at(scene: &mut SceneFile, steps: &Steps, at: usize) {
    let step = &steps.list[at];
    let hour = &step.hour;
    let clock = scene.site.dst.clock(step.time, steps.station.utc_offset);
    let (altitude, azimuth) = (hour.sun.altitude(), hour.sun.bearing().degrees());
    let direct = hour.direct_normal_irradiance * altitude.sin().max(0.0);
    scene.sky = SkyKeys {
        time: Some(TimeKey::Text(clock.strftime("%Y-%m-%dT%H:%M:%S").to_string())),
        sun: SunKeys {
            altitude: Some(altitude.to_degrees()),
            azimuth: Some(azimuth),
            direct_normal: Some(hour.direct_normal),
        },
        diffuse_horizontal: Some(hour.diffuse_horizontal),
        direct_horizontal_irradiance: Some(direct),
        diffuse_horizontal_irradiance: Some(hour.diffuse_horizontal_irradiance),
        ..bare(scene, SkyModelKey::Perez)
    };
    scene.site.ground_reflectance = steps.ground(at);
}
