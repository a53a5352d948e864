//! The scene file as typed: TOML keys, defaults, and ranges that can be judged without knowing the rest.
//!
//! Lengths in metres, angles in degrees, illuminances in lx, luminances in cd/m². What the keys mean together is
//! [`super::scene`]'s business.

mod sky;

pub use self::sky::{DEFAULT_TURBIDITY, IlluminanceKey, ObstructionKeys, SkyKeys, SkyModelKey, SunKeys, TimeKey};
pub use super::control::keys::{ControlKeys, ControlMode};
use super::near_field::NearFieldKey;
pub use super::weather_keys::{LightKey, OffsetKey};
use crate::compute::incidence::schemes::{DiffuseScheme, SunScheme};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A whole scene file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// The box.
    pub room: RoomKeys,
    /// Windows and rooflights.
    pub aperture: Vec<ApertureKeys>,
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

/// `aperture.system`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "SystemAsTyped", into = "SystemAsTyped")]
pub enum SystemKeys {
    /// `{ ideal = "transparent", transmittance = 1.0 }`
    Ideal {
        /// Transparent or diffuse.
        kind: IdealKind,
        /// 0 … 1
        transmittance: f64,
    },
    /// `{ file = "system.xml" }`
    File {
        /// Relative to the scene file.
        path: PathBuf,
        /// Key of the state in a file of several.
        state: Option<String>,
    },
    /// `{ catalogue = "product-key", state = "45" }`
    Catalogue {
        /// Product key.
        key: String,
        /// Key of the state, or "controlled".
        state: Option<String>,
    },
}

/// All keys that `aperture.system` may have; which belong together is judged afterwards, so that the message can say.
#[derive(Debug, Clone, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct SystemAsTyped {
    #[serde(skip_serializing_if = "Option::is_none")]
    ideal: Option<IdealKind>,
    #[serde(skip_serializing_if = "Option::is_none")]
    transmittance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<PathBuf>,
    #[serde(skip_serializing_if = "Option::is_none")]
    catalogue: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    state: Option<String>,
}

impl TryFrom<SystemAsTyped> for SystemKeys {
    type Error = String;

    fn try_from(typed: SystemAsTyped) -> Result<Self, String> {
        match typed {
            SystemAsTyped {
                ideal: Some(kind),
                transmittance: Some(transmittance),
                file: None,
                catalogue: None,
                state: None,
            } => Ok(Self::Ideal { kind, transmittance }),
            SystemAsTyped { ideal: None, transmittance: None, file: Some(path), catalogue: None, state } => {
                Ok(Self::File { path, state })
            }
            SystemAsTyped { ideal: None, transmittance: None, file: None, catalogue: Some(key), state } => {
                Ok(Self::Catalogue { key, state })
            }
            _ => Err(
                "system needs exactly one of: ideal and transmittance; file; catalogue (state goes with the last two)"
                    .into(),
            ),
        }
    }
}

impl From<SystemKeys> for SystemAsTyped {
    fn from(keys: SystemKeys) -> Self {
        match keys {
            SystemKeys::Ideal { kind, transmittance } => {
                Self { ideal: Some(kind), transmittance: Some(transmittance), ..Self::default() }
            }
            SystemKeys::File { path, state } => Self { file: Some(path), state, ..Self::default() },
            SystemKeys::Catalogue { key, state } => Self { catalogue: Some(key), state, ..Self::default() },
        }
    }
}

/// `system.ideal`
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum IdealKind {
    /// Light goes straight on.
    Transparent,
    /// Lambertian emission, τ independent of incidence.
    Diffuse,
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
    /// Above the sea, for clear-sky illuminances. \[m\]
    pub elevation: f64,
    /// Uniform ground, 0 … 1.
    pub ground_reflectance: f64,
}

impl Default for SiteKeys {
    fn default() -> Self {
        Self {
            azimuth: 180.0,
            latitude: None,
            longitude: None,
            utc_offset: None,
            elevation: 0.0,
            ground_reflectance: 0.0,
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
