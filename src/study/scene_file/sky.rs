//! `[sky]` as typed: model, sun, and the illuminances that both are scaled to.

use super::outside::SkylineKeys;
use crate::study::weather_keys::{LightKey, OffsetKey};
use crate::texts::words as texts;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// `sky.model`
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SkyModelKey {
    /// ISO 15469 types 1–15, 16 = traditional overcast.
    Cie,
    /// The same luminance everywhere.
    Uniform,
    /// Perez all-weather.
    Perez,
    /// 145 measured luminances.
    Scan,
    /// None: the hour of a weather file, which `sky.weather` names.
    #[serde(skip)]
    Weather,
}

impl SkyModelKey {
    /// All, in the order that lists show.
    pub const ALL: [Self; 4] = [Self::Cie, Self::Uniform, Self::Perez, Self::Scan];

    /// Words: in a list, for a scene's title, and in the header of a luminaire file, which is English.
    pub fn words(self) -> [&'static str; 3] {
        let (list, title, header) = match self {
            Self::Cie => (texts::LIST_CIE, texts::CIE_SKY, "CIE"),
            Self::Uniform => (texts::LIST_UNIFORM, texts::UNIFORM_SKY, "uniform"),
            Self::Perez => (texts::LIST_PEREZ, texts::PEREZ_SKY, "Perez all-weather"),
            Self::Scan => (texts::LIST_SCAN, texts::MEASURED_SKY, "measured scan"),
            Self::Weather => (texts::LIST_WEATHER, texts::WEATHER_SKY, "Perez all-weather, hour of a weather file"),
        };
        [list.get(), title.get(), header]
    }

    /// Is it scaled to illuminances that are stated? Perez's sky and a measured one bring their own.
    pub const fn takes_illuminances(self) -> bool {
        !matches!(self, Self::Perez | Self::Scan | Self::Weather)
    }

    /// What stands for the model in a sky without one.
    const fn of_weather() -> Self {
        Self::Weather
    }

    /// Nothing to write: `sky.weather` says it.
    const fn is_weather(&self) -> bool {
        matches!(self, Self::Weather)
    }
}

/// `sky.illuminance`: what a CIE or uniform sky and its sun are scaled to. Perez's sky and a measured one keep theirs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum IlluminanceKey {
    /// To `diffuse_horizontal` and `sun.direct_normal` as written.
    #[default]
    #[serde(rename = "stated")]
    Stated,
    /// By the sun's altitude: CIE types 11–15 by `turbidity` and `site.elevation`, others by RP-21's covers.
    #[serde(rename = "clear-sky")]
    ClearSky,
    /// By the sun's altitude and RP-21's three covers.
    #[serde(rename = "rp-21")]
    Rp21,
}

impl IlluminanceKey {
    /// All, in the order that lists show.
    pub const ALL: [Self; 3] = [Self::ClearSky, Self::Rp21, Self::Stated];

    /// As the key is written.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Stated => "stated",
            Self::ClearSky => "clear-sky",
            Self::Rp21 => "rp-21",
        }
    }
}

/// `[sky]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SkyKeys {
    /// Which model; not written with `weather`.
    #[serde(default = "SkyModelKey::of_weather", skip_serializing_if = "SkyModelKey::is_weather")]
    pub model: SkyModelKey,
    /// A weather file (.epw, .wea) or a year that comes with the program, whose hour at `time` stands instead of a model
    /// and its values: month, day and time of day count, the row's own year is used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weather: Option<PathBuf>,
    /// Where the weather's illuminances come from.
    #[serde(default, skip_serializing_if = "LightKey::is_default")]
    pub light: LightKey,
    /// Minutes by which the weather's intervals lie later than the file says, or "auto".
    #[serde(default, skip_serializing_if = "OffsetKey::is_default")]
    pub sun_offset_minutes: OffsetKey,
    /// CIE type 1 … 16.
    #[serde(rename = "type", default, skip_serializing_if = "Option::is_none")]
    pub cie_type: Option<u8>,
    /// Where the illuminances come from; always written, since scenes kept by versions that did not know it lack it.
    #[serde(default)]
    pub illuminance: IlluminanceKey,
    /// Linke turbidity of the air, for `illuminance = "clear-sky"`.
    #[serde(default = "usual_turbidity", skip_serializing_if = "is_usual_turbidity")]
    pub turbidity: f64,
    /// Diffuse horizontal illuminance; read where illuminances are stated. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diffuse_horizontal: Option<f64>,
    /// The sun by angles, and its beam.
    #[serde(default)]
    pub sun: SunKeys,
    /// Local time by the clock (`site.utc_offset`, `site.dst`), `YYYY-MM-DDTHH:MM[:SS]`, instead of sun angles; beside
    /// them its date alone counts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<TimeKey>,
    /// Perez: direct irradiance on the horizontal plane. \[W/m²\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direct_horizontal_irradiance: Option<f64>,
    /// Perez: diffuse irradiance on the horizontal plane. \[W/m²\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diffuse_horizontal_irradiance: Option<f64>,
    /// Scan: 145 Tregenza luminances.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// A horizontal skyline over the whole azimuth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub obstruction: Option<ObstructionKeys>,
    /// A skyline that rises and falls with the bearing, instead of `obstruction`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub skyline: Option<SkylineKeys>,
}

/// Linke turbidity of usual air.
pub const DEFAULT_TURBIDITY: f64 = 3.0;

const fn usual_turbidity() -> f64 {
    DEFAULT_TURBIDITY
}

/// Nothing that the file needs to say.
fn is_usual_turbidity(turbidity: &f64) -> bool {
    *turbidity == DEFAULT_TURBIDITY
}

/// `sky.time`: a string, or a TOML date-time without offset.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum TimeKey {
    /// Quoted.
    Text(String),
    /// Bare TOML date-time.
    Toml(toml::value::Datetime),
}

impl TimeKey {
    /// Returns the key of a moment to the minute, to the second where it is not a whole minute.
    pub fn of(time: jiff::civil::DateTime) -> Self {
        let format = if time.second() == 0 { "%Y-%m-%dT%H:%M" } else { "%Y-%m-%dT%H:%M:%S" };
        Self::Text(time.strftime(format).to_string())
    }

    /// The text, whichever way it was written.
    pub fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Toml(time) => time.to_string(),
        }
    }
}

/// `sky.sun`
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub struct SunKeys {
    /// True altitude, no refraction. \[°\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub altitude: Option<f64>,
    /// Compass bearing. \[°\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub azimuth: Option<f64>,
    /// Illuminance on a plane facing the sun, 0 = no disc. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direct_normal: Option<f64>,
}

/// `sky.obstruction`
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObstructionKeys {
    /// Of the skyline. \[°\]
    pub altitude: f64,
    /// Of what stands below it. \[cd/m²\]
    #[serde(default)]
    pub luminance: f64,
}
