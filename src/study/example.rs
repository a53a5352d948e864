//! Scenes for a first start: that of the window, and that for a single product.

use super::scene_file::{
    ApertureKeys, ApertureReflectance, ComputeKeys, DEFAULT_TURBIDITY, DstKey, IlluminanceKey, LightKey, OffsetKey,
    PlaneKeys, ReflectanceKeys, RoomKeys, SceneFile, SensorKeys, SiteKeys, SkyKeys, SkyModelKey, SunKeys, SurfaceKey,
    SystemKeys, TimeKey,
};

/// Returns the scene of the window's first start: a room in Stuttgart with a south façade, at noon of an equinox under
/// a clear sky.
pub fn first_scene() -> SceneFile {
    SceneFile {
        building: None,
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
            frame: 0.0,
            dirt: 1.0,
            control: None,
        }],
        outside: Vec::new(),
        site: SiteKeys {
            azimuth: 180.0,
            latitude: Some(48.78),
            longitude: Some(9.18),
            utc_offset: Some(1.0),
            dst: DstKey::Eu,
            elevation: 252.0,
            ground_reflectance: 0.2,
            ground_height: 0.0,
        },
        sky: SkyKeys {
            model: SkyModelKey::Cie,
            weather: None,
            light: LightKey::default(),
            sun_offset_minutes: OffsetKey::default(),
            cie_type: Some(12),
            illuminance: IlluminanceKey::ClearSky,
            turbidity: DEFAULT_TURBIDITY,
            diffuse_horizontal: None,
            sun: SunKeys::default(),
            time: Some(TimeKey::Text("2026-03-21T12:00".to_owned())),
            direct_horizontal_irradiance: None,
            diffuse_horizontal_irradiance: None,
            file: None,
            obstruction: None,
            skyline: None,
        },
        sensors: SensorKeys {
            plane: Some(PlaneKeys { z: 0.85, nx: 16, ny: 24, normal: [0.0, 0.0, 1.0] }),
            points: Vec::new(),
            normal: None,
        },
        control: None,
        compute: ComputeKeys::default(),
        year: None,
        rank: None,
        compare: Vec::new(),
    }
}

/// Returns the scene of the first start with a product of the catalogue in its aperture. `product`, `state`: their
/// keys.
pub fn scene_of(product: &str, state: Option<&str>) -> SceneFile {
    let mut scene = first_scene();
    scene.aperture[0].system = SystemKeys::Catalogue {
        key: product.to_owned(),
        state: state.filter(|state| !state.is_empty()).map(str::to_owned),
    };
    scene
}
