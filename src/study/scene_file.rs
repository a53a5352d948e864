//! Scene file as typed: TOML keys, defaults, and ranges that can be checked independently of each other.
//!
//! Lengths in metres, angles in degrees, illuminances in lx, luminances in cd/m². Keys that depend on each other are
//! checked by [`super::scene`].

mod dst;
mod outside;
mod sky;
mod system;
pub(super) mod units;

pub use self::dst::{ANY_YEAR, DstKey};
pub use self::sky::{DEFAULT_TURBIDITY, IlluminanceKey, ObstructionKeys, SkyKeys, SkyModelKey, SunKeys, TimeKey};
pub use self::system::{FamilyState, IdealKind, RANKED, SystemKeys};
pub use super::control::keys::{ControlKeys, ControlMode};
use super::near_field::NearFieldKey;
pub use super::rank_keys::{BetterKey, ObjectiveKeys, RankControlKey, RankKeys};
pub use super::weather_keys::{LightKey, OffsetKey};
pub use super::year_keys::YearKeys;
use crate::compute::incidence::schemes::{DiffuseScheme, SunScheme};
pub use outside::{BoxKeys, BuildingKeys, OutsideKeys, SkylineKeys, USUAL_REFLECTANCE};
use serde::{Deserialize, Serialize};

/// Relative error target that is assumed for a scene without one.
pub(super) const ORDINARY_TARGET: f64 = 0.01;

/// A whole scene file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// Room, a box.
    pub room: RoomKeys,
    /// Apertures in façade and roof.
    pub aperture: Vec<ApertureKeys>,
    /// Boxes outside, in front of the façade and above the roof.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outside: Vec<OutsideKeys>,
    /// The building that the room belongs to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub building: Option<BuildingKeys>,
    /// Site and ground.
    #[serde(default)]
    pub site: SiteKeys,
    /// Sky and sun.
    pub sky: SkyKeys,
    /// Sensor points.
    pub sensors: SensorKeys,
    /// Control of moving systems; `None`: states are fixed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub control: Option<ControlKeys>,
    /// Settings of the computation.
    #[serde(default)]
    pub compute: ComputeKeys,
    /// Annual simulation; `None` without a year.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub year: Option<YearKeys>,
    /// Ranking of products; `None` without a ranking.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rank: Option<RankKeys>,
    /// Candidates of the comparison: the list in the window, the columns of `cfs compare`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub compare: Vec<CompareKeys>,
}

impl SceneFile {
    /// Whether there are boxes or a building outside.
    pub fn has_outside(&self) -> bool {
        !self.outside.is_empty() || self.building.is_some()
    }

    /// Returns the scene without boxes and building.
    pub fn without_outside(&self) -> Self {
        Self { outside: Vec::new(), building: None, ..self.clone() }
    }
}

/// `[[compare]]`: a candidate of the comparison. Keys that it does not set are as in the rest of the scene.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CompareKeys {
    /// Name of the candidate; empty: named by its system.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// System of the apertures that are filled from the catalogue, or of the first aperture if none is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub system: Option<SystemKeys>,
    /// Control of `system` or `aperture`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub control: Option<ControlKeys>,
    /// Sky and date of the candidate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sky: Option<SkyKeys>,
    /// Site of the candidate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub site: Option<SiteKeys>,
    /// Room of the candidate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub room: Option<RoomKeys>,
    /// Apertures of the candidate; empty: those of the scene.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub aperture: Vec<ApertureKeys>,
    /// Sensors of the candidate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensors: Option<SensorKeys>,
}

/// Keys of `[room]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RoomKeys {
    /// Width of the room, along the façade. \[m\]
    pub width: f64,
    /// Depth of the room, perpendicular to the façade. \[m\]
    pub depth: f64,
    /// Height of the room from floor to ceiling. \[m\]
    pub height: f64,
    /// Diffuse reflectances of the surfaces without the apertures.
    pub reflectance: ReflectanceKeys,
}

/// Keys of `room.reflectance`.
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

/// Values of `aperture.surface`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SurfaceKey {
    /// The wall y = 0.
    Facade,
    /// The ceiling.
    Roof,
}

/// Keys of `[[aperture]]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ApertureKeys {
    /// Surface of the aperture: façade or roof.
    pub surface: SurfaceKey,
    /// Lower-left corner: (x, z) on the façade, (x, y) on the roof. \[m\]
    pub origin: [f64; 2],
    /// Size along x, and along z (façade) or y (roof). \[m\]
    pub size: [f64; 2],
    /// System of the aperture.
    pub system: SystemKeys,
    /// Room-side diffuse reflectance, or "dataset".
    #[serde(default)]
    pub reflectance: ApertureReflectance,
    /// Period of the visible structure (pitch of slats or cuts), if the dataset does not have it or has a wrong one.
    /// \[m\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub structure: Option<f64>,
    /// Share of the area that is opaque frame, uniformly distributed; 0 … 0.95.
    #[serde(default, skip_serializing_if = "outside::is_none")]
    pub frame: f64,
    /// Dirt factor of all transmitted light, 0 … 1.
    #[serde(default = "outside::clean", skip_serializing_if = "outside::is_clean")]
    pub dirt: f64,
    /// Control of this aperture, instead of the scene's `[control]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub control: Option<ControlKeys>,
}

/// `aperture.reflectance`: a number, or "dataset".
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

/// Keys of `[site]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SiteKeys {
    /// Bearing of the façade's outward normal. \[°\]
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
    /// Rule of summer time for `sky.time` and schedules.
    #[serde(skip_serializing_if = "DstKey::is_none")]
    pub dst: DstKey,
    /// Elevation above sea level, for clear-sky illuminances. \[m\]
    pub elevation: f64,
    /// Reflectance of the uniform ground, 0 … 1.
    pub ground_reflectance: f64,
    /// Height of the ground in room axes. \[m\]
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

/// Keys of `[sensors]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub struct SensorKeys {
    /// Grid of sensors over the floor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plane: Option<PlaneKeys>,
    /// Single sensor points (x, y, z). \[m\]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<[f64; 3]>,
    /// Normal of the single points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 3]>,
}

/// Keys of `sensors.plane`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlaneKeys {
    /// Height above the floor. \[m\]
    pub z: f64,
    /// Number of sensors along x.
    pub nx: usize,
    /// Number of sensors along y.
    pub ny: usize,
    /// Normal of the sensors.
    #[serde(default = "up")]
    pub normal: [f64; 3],
}

const fn up() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

/// Values of `compute.interpolation`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Interpolation {
    /// The program chooses.
    #[default]
    Auto,
    /// The data are constant on their patches; nothing is filtered, moved or refined.
    Patch,
}

/// Values of `compute.beam`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BeamMode {
    /// Sharp beams: by the optical model if there is one, else for peaks that stand out of the data.
    #[default]
    Auto,
    /// Patch-averaged data, used as given.
    Cells,
}

impl BeamMode {
    /// Whether the file can omit the key.
    fn is_auto(&self) -> bool {
        *self == Self::Auto
    }
}

/// Values of `compute.back_reflection`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BackReflectionMode {
    /// Directional by the dataset's back reflection if it is given by patches and no other aperture faces this one,
    /// else diffuse.
    #[default]
    Auto,
    /// Diffuse reflection.
    Diffuse,
    /// Directional by patches in any case; direct light from other apertures is then not reflected.
    Directional,
}

impl BackReflectionMode {
    /// Whether the file can omit the key.
    fn is_auto(&self) -> bool {
        *self == Self::Auto
    }
}

/// Keys of `[compute]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ComputeKeys {
    /// Whether interreflection is computed; `false`: the direct component alone.
    pub interreflection: bool,
    /// Relative error target, by which the program chooses its effort.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_target: Option<f64>,
    /// Interpolation between and inside the dataset's directions.
    pub interpolation: Interpolation,
    /// Interpolation between incident directions, for the sun.
    #[serde(with = "super::scheme_words::sun")]
    pub sun_interpolation: SunScheme,
    /// Interpolation between incident directions, for sky and ground.
    #[serde(with = "super::scheme_words::diffuse")]
    pub diffuse_interpolation: DiffuseScheme,
    /// Method of integrating an aperture's light at a sensor.
    pub near_field: NearFieldKey,
    /// Effort of the methods that have one: number of point luminaires, of random points per sensor, of cells along
    /// each angle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub near_field_samples: Option<usize>,
    /// Treatment of light that is transmitted unscattered.
    #[serde(skip_serializing_if = "BeamMode::is_auto")]
    pub beam: BeamMode,
    /// Reflection of the room's light by apertures with `reflectance = "dataset"`.
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
