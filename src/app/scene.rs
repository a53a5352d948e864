//! The scene as the window starts it, fills it and reads it.

use crate::study::control::year::CONTROLLED;
use crate::study::scene_file::{
    ApertureKeys, ApertureReflectance, ComputeKeys, ControlKeys, PlaneKeys, ReflectanceKeys, RoomKeys, SceneFile,
    SensorKeys, SiteKeys, SkyKeys, SkyModelKey, SunKeys, SurfaceKey, SystemKeys, TimeKey,
};

/// Product and state: the window's one selection.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Selection {
    /// Product key.
    pub product: String,
    /// Key of the state; empty for the one that stands for the product; `controlled` when the scene's control picks it.
    pub state: String,
}

/// The scene of a first start: Stuttgart, south, an equinox noon under a clear sky.
pub fn first_scene() -> SceneFile {
    SceneFile {
        room: RoomKeys {
            width: 4.0,
            depth: 6.0,
            height: 3.0,
            reflectance: ReflectanceKeys { floor: 0.2, walls: 0.5, ceiling: 0.7 },
        },
        aperture: vec![ApertureKeys {
            surface: SurfaceKey::Facade,
            origin: [0.5, 0.9],
            size: [3.0, 1.8],
            system: SystemKeys::Catalogue { key: String::new(), state: None },
            reflectance: ApertureReflectance::default(),
            structure: None,
            control: None,
        }],
        site: SiteKeys {
            azimuth: 180.0,
            latitude: Some(48.78),
            longitude: Some(9.18),
            utc_offset: Some(1.0),
            ground_reflectance: 0.2,
        },
        sky: SkyKeys {
            model: SkyModelKey::Cie,
            cie_type: Some(12),
            diffuse_horizontal: Some(13_000.0),
            sun: SunKeys { altitude: None, azimuth: None, direct_normal: Some(90_000.0) },
            time: Some(TimeKey::Text("2026-03-21T12:00".to_owned())),
            direct_horizontal_irradiance: None,
            diffuse_horizontal_irradiance: None,
            file: None,
            obstruction: None,
        },
        sensors: SensorKeys {
            plane: Some(PlaneKeys { z: 0.85, nx: 16, ny: 24, normal: [0.0, 0.0, 1.0] }),
            points: Vec::new(),
            normal: None,
        },
        control: None,
        compute: ComputeKeys::default(),
    }
}

/// The product that a scene's first aperture from the catalogue holds.
pub fn selection_of(scene: &SceneFile) -> Option<Selection> {
    scene.aperture.iter().find_map(|aperture| match &aperture.system {
        SystemKeys::Catalogue { key, state } if !key.is_empty() => {
            Some(Selection { product: key.clone(), state: state.clone().unwrap_or_default() })
        }
        _ => None,
    })
}

/// Puts a product into every aperture that is filled from the catalogue; into the first one if none is.
pub fn fill(scene: &mut SceneFile, selection: &Selection) {
    let state = (!selection.state.is_empty()).then(|| selection.state.clone());
    if selection.state != CONTROLLED {
        scene.control = None;
        scene.aperture.iter_mut().for_each(|aperture| aperture.control = None);
    }
    let keys = SystemKeys::Catalogue { key: selection.product.clone(), state };
    let from_catalogue = |system: &SystemKeys| matches!(system, SystemKeys::Catalogue { .. });
    if !scene.aperture.iter().any(|aperture| from_catalogue(&aperture.system)) {
        if let Some(first) = scene.aperture.first_mut() {
            first.system = keys;
        }
        return;
    }
    for aperture in scene.aperture.iter_mut().filter(|aperture| from_catalogue(&aperture.system)) {
        aperture.system = keys.clone();
    }
}

/// Sets the rule of one aperture, or of the whole scene, which then has no other.
pub fn set_rule(scene: &mut SceneFile, aperture: Option<usize>, keys: Option<ControlKeys>) {
    match aperture.and_then(|index| scene.aperture.get_mut(index)) {
        Some(aperture) => aperture.control = keys,
        None => {
            scene.aperture.iter_mut().for_each(|aperture| aperture.control = None);
            scene.control = keys;
        }
    }
}

/// The rule of an aperture: its own, else the scene's.
pub fn rule(scene: &SceneFile, aperture: usize) -> Option<&ControlKeys> {
    scene.aperture.get(aperture).and_then(|aperture| aperture.control.as_ref()).or(scene.control.as_ref())
}
