//! Scene file as typed: its TOML keys with defaults, and ranges that can be checked independently of each other.
//!
//! Lengths in metres, angles in degrees, illuminances in lx, luminances in cd/m². Keys that depend on each other are
//! checked by [`super::scene`].

mod dst;
mod outside;
mod sky;
mod system;
pub(super) mod units;

pub use self::dst::{ANY_YEAR, DstKey};
pub use self::sky::{
    DEFAULT_TURBIDITY, IlluminanceKey, ObstructionKeys, SkyKeys, SkyModelKey, SunKeys, TimeKey, USUAL_IRRADIANCES,
};
pub use self::system::{FamilyState, IdealKind, RANKED, SystemKeys};
pub use super::control::keys::{ControlKeys, ControlMode};
use super::near_field::NearFieldKey;
pub use super::rank_keys::{BetterKey, ObjectiveKeys, RankControlKey, RankKeys};
pub use super::weather_keys::{LightKey, OffsetKey};
pub use super::year_keys::YearKeys;
use crate::compute::incidence::schemes::{DiffuseScheme, SunScheme};
pub use outside::{BoxKeys, BuildingKeys, OutsideKeys, SkylineKeys, USUAL_REFLECTANCE};
use serde::{Deserialize, Serialize};

/// Relative error target of the illuminances in a scene that does not give one.
pub(super) const ORDINARY_TARGET: f64 = 0.01;

/// Scene file with all its sections.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// Section `[room]`: the room as a box.
    pub room: RoomKeys,
    /// Entries `[[aperture]]`: apertures in façade and roof.
    pub aperture: Vec<ApertureKeys>,
    /// Entries `[[outside]]`: boxes in front of the façade and above the roof.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outside: Vec<OutsideKeys>,
    /// Section `[building]`: the building of which the room is a part.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub building: Option<BuildingKeys>,
    /// Section `[site]`: geographic location, orientation of the façade, and ground.
    #[serde(default)]
    pub site: SiteKeys,
    /// Section `[sky]`: sky and sun.
    pub sky: SkyKeys,
    /// Section `[sensors]`: sensor points.
    pub sensors: SensorKeys,
    /// Section `[control]`: control of moving systems; `None`: states are fixed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub control: Option<ControlKeys>,
    /// Section `[compute]`: settings of the computation.
    #[serde(default)]
    pub compute: ComputeKeys,
    /// Section `[year]`: annual simulation; `None` without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub year: Option<YearKeys>,
    /// Section `[rank]`: ranking of products; `None` without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rank: Option<RankKeys>,
    /// Entries `[[compare]]`: candidates of the comparison, listed in the window and in the columns of `cfs compare`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub compare: Vec<CompareKeys>,
}

impl SceneFile {
    /// Whether the scene has boxes or a building outside.
    pub fn has_outside(&self) -> bool {
        !self.outside.is_empty() || self.building.is_some()
    }

    /// Returns a copy of the scene without boxes and building.
    pub fn without_outside(&self) -> Self {
        Self { outside: Vec::new(), building: None, ..self.clone() }
    }
}

/// Entry `[[compare]]` of a scene file: candidate of the comparison. Keys that it does not set have the values of the
/// rest of the scene.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CompareKeys {
    /// Name of the candidate; if empty, that of its system.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// System in all apertures that are filled from the catalogue, or in the first aperture if none is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub system: Option<SystemKeys>,
    /// Control of the systems in `system` or `aperture`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub control: Option<ControlKeys>,
    /// Sky and date of the candidate; `None`: those of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sky: Option<SkyKeys>,
    /// Site of the candidate; `None`: that of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub site: Option<SiteKeys>,
    /// Room of the candidate; `None`: that of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub room: Option<RoomKeys>,
    /// Apertures of the candidate; empty: those of the scene.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub aperture: Vec<ApertureKeys>,
    /// Sensors of the candidate; `None`: those of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensors: Option<SensorKeys>,
}

/// Section `[room]` of a scene file.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RoomKeys {
    /// Width of the room, along the façade. \[m\]
    pub width: f64,
    /// Depth of the room, perpendicular to the façade. \[m\]
    pub depth: f64,
    /// Height of the room from floor to ceiling. \[m\]
    pub height: f64,
    /// Diffuse reflectances of the room's surfaces, without the apertures.
    pub reflectance: ReflectanceKeys,
}

/// Key `room.reflectance`: diffuse reflectances of the room's surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReflectanceKeys {
    /// Reflectance of the floor, 0 … 1.
    pub floor: f64,
    /// Reflectance of the walls, 0 … 1.
    pub walls: f64,
    /// Reflectance of the ceiling, 0 … 1.
    pub ceiling: f64,
}

/// Value of `aperture.surface`: surface of the room in which an aperture lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SurfaceKey {
    /// Façade: the wall y = 0.
    Facade,
    /// Roof: the ceiling of the room.
    Roof,
}

/// Entry `[[aperture]]` of a scene file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ApertureKeys {
    /// Surface of the aperture: façade or roof.
    pub surface: SurfaceKey,
    /// Lower left corner in room axes: (x, z) in the façade, (x, y) in the roof. \[m\]
    pub origin: [f64; 2],
    /// Size of the aperture along x, and along z (façade) or y (roof). \[m\]
    pub size: [f64; 2],
    /// System that fills the aperture.
    pub system: SystemKeys,
    /// Diffuse reflectance of the system's room side, or "dataset".
    #[serde(default)]
    pub reflectance: ApertureReflectance,
    /// Period of the structure that is visible to the eye (pitch of slats or cuts), if the dataset does not state it or
    /// states a wrong one. \[m\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub structure: Option<f64>,
    /// Frame fraction: share of the aperture's area that is opaque frame, uniformly distributed; 0 … 0.95.
    #[serde(default, skip_serializing_if = "outside::is_none")]
    pub frame: f64,
    /// Dirt factor k₂ by which all transmitted light is multiplied, 0 … 1; 1 is clean.
    #[serde(default = "outside::clean", skip_serializing_if = "outside::is_clean")]
    pub dirt: f64,
    /// Control of this aperture in place of the scene's `[control]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub control: Option<ControlKeys>,
}

/// Value of `aperture.reflectance`: reflectance of the room side as a number, or "dataset".
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum ApertureReflectance {
    /// Back reflection of the dataset if it has one; 0 for ideal systems.
    #[default]
    Dataset,
    /// Diffuse reflectance of the room side, 0 … 1.
    Value(f64),
}

impl Serialize for ApertureReflectance {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Dataset => serializer.serialize_str("dataset"),
            Self::Value(value) => serializer.serialize_f64(*value),
        }
    }
}

impl<'de> Deserialize<'de> for ApertureReflectance {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl serde::de::Visitor<'_> for Visitor {
            type Value = ApertureReflectance;
            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("a reflectance from 0 to 1 or the word \"dataset\"")
            }
            fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<Self::Value, E> {
                Ok(ApertureReflectance::Value(value))
            }
            fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<Self::Value, E> {
                Ok(ApertureReflectance::Value(value as f64))
            }
            fn visit_u64<E: serde::de::Error>(self, value: u64) -> Result<Self::Value, E> {
                Ok(ApertureReflectance::Value(value as f64))
            }
            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Self::Value, E> {
                if text == "dataset" {
                    Ok(ApertureReflectance::Dataset)
                } else {
                    Err(E::invalid_value(serde::de::Unexpected::Str(text), &self))
                }
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

/// Section `[site]` of a scene file.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SiteKeys {
    /// Bearing of the façade's outward normal, clockwise from north. \[°\]
    pub azimuth: f64,
    /// Latitude, north positive. \[°\]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub latitude: Option<f64>,
    /// Longitude, east positive. \[°\]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub longitude: Option<f64>,
    /// Offset of local standard time from UTC. \[h\]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub utc_offset: Option<f64>,
    /// Rule of summer time that applies to `sky.time` and schedules.
    #[serde(skip_serializing_if = "DstKey::is_none")]
    pub dst: DstKey,
    /// Elevation above sea level, for clear-sky illuminances. \[m\]
    pub elevation: f64,
    /// Reflectance of the uniform ground, 0 … 1.
    pub ground_reflectance: f64,
    /// Height of the ground outside in room axes; the floor is at 0. \[m\]
    pub ground_height: f64,
}

impl Default for SiteKeys {
    fn default() -> Self {
        Self {
            azimuth: 180.0,
            latitude: None,
            longitude: None,
            utc_offset: None,
            dst: DstKey::None,
            elevation: 0.0,
            ground_reflectance: 0.0,
            ground_height: 0.0,
        }
    }
}

/// Section `[sensors]` of a scene file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub struct SensorKeys {
    /// Grid of sensor points over the floor (work plane).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plane: Option<PlaneKeys>,
    /// Single sensor points (x, y, z) in room axes. \[m\]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<[f64; 3]>,
    /// Normal of the single sensor points, in room axes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 3]>,
}

/// Key `sensors.plane`: grid of sensor points over the floor (work plane).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlaneKeys {
    /// Height of the sensor points above the floor. \[m\]
    pub z: f64,
    /// Number of sensor points along x, the width of the room.
    pub nx: usize,
    /// Number of sensor points along y, the depth of the room.
    pub ny: usize,
    /// Normal of the sensor points, in room axes; default: upwards.
    #[serde(default = "up")]
    pub normal: [f64; 3],
}

const fn up() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

/// Value of `compute.interpolation`: treatment of BSDF data between and within their directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Interpolation {
    /// Interpolation by schemes that the program chooses, unless other keys name them.
    #[default]
    Auto,
    /// Data taken as constant on their patches; nothing is interpolated, filtered or refined.
    Patch,
}

/// Value of `compute.beam`: treatment of direct sunlight behind systems.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BeamMode {
    /// Sharp beams: computed by the optical model if there is one, else extracted from patch-averaged data where peaks
    /// stand out.
    #[default]
    Auto,
    /// Patch-averaged data as given, without extraction of beams.
    Cells,
}

impl BeamMode {
    /// Whether the value is the default, which is not written to the file.
    fn is_auto(&self) -> bool {
        *self == Self::Auto
    }
}

/// Value of `compute.back_reflection`: reflection of light from the room by apertures with `reflectance = "dataset"`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BackReflectionMode {
    /// Reflection by direction if the dataset gives its back reflection by patches and no other aperture faces this
    /// one, else diffuse.
    #[default]
    Auto,
    /// Diffuse reflection in any case.
    Diffuse,
    /// Reflection by direction in any case; direct light from other apertures is then not reflected.
    Directional,
}

impl BackReflectionMode {
    /// Whether the value is the default, which is not written to the file.
    fn is_auto(&self) -> bool {
        *self == Self::Auto
    }
}

/// Section `[compute]` of a scene file.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ComputeKeys {
    /// Whether interreflection is computed; `false`: the direct component alone.
    pub interreflection: bool,
    /// Relative error target of the illuminances, by which the program chooses its effort; `None`: the default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_target: Option<f64>,
    /// Treatment of BSDF data between and within their directions: interpolated, or constant on their patches.
    pub interpolation: Interpolation,
    /// Scheme of interpolation between the incident directions of a dataset, for the sun.
    #[serde(with = "super::scheme_words::sun")]
    pub sun_interpolation: SunScheme,
    /// Scheme of interpolation between the incident directions of a dataset, for sky and ground.
    #[serde(with = "super::scheme_words::diffuse")]
    pub diffuse_interpolation: DiffuseScheme,
    /// Method of integrating the light of an aperture at a sensor.
    pub near_field: NearFieldKey,
    /// Effort of the methods that have one: number of point luminaires, of random points per sensor, or of cells along
    /// each profile angle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub near_field_samples: Option<usize>,
    /// Treatment of direct sunlight that a system does not scatter.
    #[serde(skip_serializing_if = "BeamMode::is_auto")]
    pub beam: BeamMode,
    /// Reflection of light from the room by apertures with `reflectance = "dataset"`.
    #[serde(skip_serializing_if = "BackReflectionMode::is_auto")]
    pub back_reflection: BackReflectionMode,
}

impl Default for ComputeKeys {
    fn default() -> Self {
        Self {
            interreflection: true,
            error_target: None,
            interpolation: Interpolation::Auto,
            sun_interpolation: SunScheme::Responses,
            diffuse_interpolation: DiffuseScheme::Auto,
            near_field: NearFieldKey::SolidAngle,
            near_field_samples: None,
            beam: BeamMode::Auto,
            back_reflection: BackReflectionMode::Auto,
        }
    }
}
