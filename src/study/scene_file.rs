//! The scene file as typed: TOML keys, defaults, and ranges that can be judged without knowing the rest.
//!
//! Lengths in metres, angles in degrees, illuminances in lx, luminances in cd/m². What the keys mean together is
//! [`super::scene`]'s business.

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

/// Relative error that a scene asks for which names none.
pub(super) const ORDINARY_TARGET: f64 = 0.01;

/// A whole scene file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// The box.
    pub room: RoomKeys,
    /// Windows and rooflights.
    pub aperture: Vec<ApertureKeys>,
    /// Boxes before the façade and above the roof.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outside: Vec<OutsideKeys>,
    /// The building that the room belongs to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub building: Option<BuildingKeys>,
    /// Place and ground.
    #[serde(default)]
    pub site: SiteKeys,
    /// Sky and sun.
    pub sky: SkyKeys,
    /// Where illuminance is asked for.
    pub sensors: SensorKeys,
    /// What chooses the state of moving systems.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub control: Option<ControlKeys>,
    /// How to compute.
    #[serde(default)]
    pub compute: ComputeKeys,
    /// A year of weather, and what is asked of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub year: Option<YearKeys>,
    /// What is ranked in it, and by what.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rank: Option<RankKeys>,
    /// What is set beside each other: the tray of the window, the columns of `cfs compare`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub compare: Vec<CompareKeys>,
}

impl SceneFile {
    /// Do boxes or a building stand outside?
    pub fn has_outside(&self) -> bool {
        !self.outside.is_empty() || self.building.is_some()
    }

    /// The scene without boxes and building.
    pub fn without_outside(&self) -> Self {
        Self { outside: Vec::new(), building: None, ..self.clone() }
    }
}

/// `[[compare]]`: one of the things that are compared. What it does not say is as in the rest of the scene.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CompareKeys {
    /// What it is called; empty: by its system.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// What fills the apertures that are filled from the catalogue, or the first aperture where none is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub system: Option<SystemKeys>,
    /// What chooses the state of `system` or `aperture`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub control: Option<ControlKeys>,
    /// Another sky or moment.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sky: Option<SkyKeys>,
    /// Another place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub site: Option<SiteKeys>,
    /// Another room.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub room: Option<RoomKeys>,
    /// Other apertures; empty: those of the scene.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub aperture: Vec<ApertureKeys>,
    /// Other sensors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensors: Option<SensorKeys>,
}

/// `[room]`
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RoomKeys {
    /// Along the façade. \[m\]
    pub width: f64,
    /// Away from the façade. \[m\]
    pub depth: f64,
    /// Floor to ceiling. \[m\]
    pub height: f64,
    /// Diffuse reflectances outside the apertures.
    pub reflectance: ReflectanceKeys,
}

/// `room.reflectance`
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReflectanceKeys {
    /// 0 … 1
    pub floor: f64,
    /// 0 … 1
    pub walls: f64,
    /// 0 … 1
    pub ceiling: f64,
}

/// `aperture.surface`
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SurfaceKey {
    /// The wall y = 0.
    Facade,
    /// The ceiling.
    Roof,
}

/// `[[aperture]]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ApertureKeys {
    /// Façade or roof.
    pub surface: SurfaceKey,
    /// Lower-left corner: (x, z) on the façade, (x, y) on the roof. \[m\]
    pub origin: [f64; 2],
    /// Along x, and along z (façade) or y (roof). \[m\]
    pub size: [f64; 2],
    /// What fills it.
    pub system: SystemKeys,
    /// Room-side diffuse reflectance, or "dataset".
    #[serde(default)]
    pub reflectance: ApertureReflectance,
    /// Period of the visible structure (pitch of slats or cuts) where the dataset does not say or says it wrong. \[m\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub structure: Option<f64>,
    /// Share of the area that is opaque frame, spread evenly; 0 … 0.95.
    #[serde(default, skip_serializing_if = "outside::is_none")]
    pub frame: f64,
    /// Factor on all light that comes in, 0 … 1.
    #[serde(default = "outside::clean", skip_serializing_if = "outside::is_clean")]
    pub dirt: f64,
    /// What chooses the state here, instead of the scene's `[control]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub control: Option<ControlKeys>,
}

/// `aperture.reflectance`: a number, or "dataset".
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum ApertureReflectance {
    /// The dataset's own back reflection where it has one, 0 for ideal systems.
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

/// `[site]`
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SiteKeys {
    /// Bearing of the façade's outward normal. \[°\]
    pub azimuth: f64,
    /// \[°\], north positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub latitude: Option<f64>,
    /// \[°\], east positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub longitude: Option<f64>,
    /// Hours ahead of UTC.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub utc_offset: Option<f64>,
    /// When `sky.time` and schedules are summer time.
    #[serde(skip_serializing_if = "DstKey::is_none")]
    pub dst: DstKey,
    /// Above the sea, for clear-sky illuminances. \[m\]
    pub elevation: f64,
    /// Uniform ground, 0 … 1.
    pub ground_reflectance: f64,
    /// Height of the ground, room axes. \[m\]
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

/// `[sensors]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub struct SensorKeys {
    /// A grid over the floor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plane: Option<PlaneKeys>,
    /// Listed points (x, y, z). \[m\]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<[f64; 3]>,
    /// Normal of the listed points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 3]>,
}

/// `sensors.plane`
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlaneKeys {
    /// Height above the floor. \[m\]
    pub z: f64,
    /// Cells along x.
    pub nx: usize,
    /// Cells along y.
    pub ny: usize,
    /// Direction the sensors face.
    #[serde(default = "up")]
    pub normal: [f64; 3],
}

const fn up() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

/// `compute.interpolation`
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Interpolation {
    /// The program chooses.
    #[default]
    Auto,
    /// The data are constant on their own cells; nothing is filtered, moved or refined.
    Patch,
}

/// `compute.beam`
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BeamMode {
    /// What comes through unscattered is kept sharp: by the description where there is one, else as far as data stand out.
    #[default]
    Auto,
    /// As stored.
    Cells,
}

impl BeamMode {
    /// Nothing that the file needs to say.
    fn is_auto(&self) -> bool {
        *self == Self::Auto
    }
}

/// `compute.back_reflection`
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BackReflectionMode {
    /// By the dataset's own back reflection wherever it is given on cells and no other aperture faces this one, else
    /// diffuse.
    #[default]
    Auto,
    /// Diffuse.
    Diffuse,
    /// By cells all the same; what comes straight from other apertures is not thrown back then.
    Directional,
}

impl BackReflectionMode {
    /// Nothing that the file needs to say.
    fn is_auto(&self) -> bool {
        *self == Self::Auto
    }
}

/// `[compute]`
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ComputeKeys {
    /// False: the direct component alone.
    pub interreflection: bool,
    /// Relative error asked for; the program chooses its effort.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_target: Option<f64>,
    /// Between and inside the dataset's directions.
    pub interpolation: Interpolation,
    /// Between incident directions, for the sun.
    #[serde(with = "super::scheme_words::sun")]
    pub sun_interpolation: SunScheme,
    /// Between incident directions, for sky and ground.
    #[serde(with = "super::scheme_words::diffuse")]
    pub diffuse_interpolation: DiffuseScheme,
    /// How an aperture's light is integrated at a sensor.
    pub near_field: NearFieldKey,
    /// Effort of the methods that have one: point luminaires in all, random points a sensor, cells along each angle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub near_field_samples: Option<usize>,
    /// What becomes of light that comes through unscattered.
    #[serde(skip_serializing_if = "BeamMode::is_auto")]
    pub beam: BeamMode,
    /// How apertures of `reflectance = "dataset"` reflect the room's light.
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
