//! Keys of the section `[sky]`: model, sun, and the illuminances that both are scaled to.

use super::outside::SkylineKeys;
use crate::study::weather_keys::{LightKey, OffsetKey};
use crate::texts::words as texts;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Key `sky.model`: model of the sky.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SkyModelKey {
    /// CIE general sky, ISO 15469 types 1–15; 16 = traditional overcast.
    Cie,
    /// Uniform sky, equal luminance in all directions.
    Uniform,
    /// Perez all-weather sky.
    Perez,
    /// Measured sky (scan) of 145 luminances.
    Scan,
    /// Weather hour instead of a model: the hour of the weather file that `sky.weather` names.
    #[serde(skip)]
    Weather,
}

impl SkyModelKey {
    /// Models that a scene can name, in the order of lists.
    pub const ALL: [Self; 4] = [Self::Cie, Self::Uniform, Self::Perez, Self::Scan];

    /// Returns the names of the model: in a list, for a scene's title, and in the header of a luminaire file, which is
    /// in English.
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

    /// Whether the sky is scaled to stated illuminances. Perez's sky and a measured one bring their own.
    pub const fn takes_illuminances(self) -> bool {
        !matches!(self, Self::Perez | Self::Scan | Self::Weather)
    }

    /// Returns the default model of a sky without `model`.
    const fn of_weather() -> Self {
        Self::Weather
    }

    /// Whether the model is not written, since `sky.weather` replaces it.
    const fn is_weather(&self) -> bool {
        matches!(self, Self::Weather)
    }
}

/// Key `sky.illuminance`: source of the illuminances to which a CIE or uniform sky and its sun are scaled. Perez's sky
/// and a measured one keep theirs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum IlluminanceKey {
    /// Values of `diffuse_horizontal` and `sun.direct_normal` as written.
    #[default]
    #[serde(rename = "stated")]
    Stated,
    /// Values by the sun's altitude: for CIE types 11–15 by `turbidity` and `site.elevation`, for others by RP-21's
    /// covers.
    #[serde(rename = "clear-sky")]
    ClearSky,
    /// Values by the sun's altitude and RP-21's three covers.
    #[serde(rename = "rp-21")]
    Rp21,
}

impl IlluminanceKey {
    /// Sources in the order of lists.
    pub const ALL: [Self; 3] = [Self::ClearSky, Self::Rp21, Self::Stated];

    /// Returns the value of the key in scene files.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Stated => "stated",
            Self::ClearSky => "clear-sky",
            Self::Rp21 => "rp-21",
        }
    }
}

/// Section `[sky]` of a scene file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SkyKeys {
    /// Sky model; not written with `weather`.
    #[serde(default = "SkyModelKey::of_weather", skip_serializing_if = "SkyModelKey::is_weather")]
    pub model: SkyModelKey,
    /// Weather file (.epw, .wea) or built-in year, whose hour at `time` replaces a model and its values: month, day
    /// and time of day count, the row's own year is used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weather: Option<PathBuf>,
    /// Source of the weather's illuminances.
    #[serde(default, skip_serializing_if = "LightKey::is_default")]
    pub light: LightKey,
    /// Time by which the weather's intervals lie later than the file says, or "auto". \[min\]
    #[serde(default, skip_serializing_if = "OffsetKey::is_default")]
    pub sun_offset_minutes: OffsetKey,
    /// CIE sky type, 1 … 16.
    #[serde(rename = "type", default, skip_serializing_if = "Option::is_none")]
    pub cie_type: Option<u8>,
    /// Source of the illuminances; always written, since scenes of versions without this key lack it.
    #[serde(default)]
    pub illuminance: IlluminanceKey,
    /// Linke turbidity of the air, for `illuminance = "clear-sky"`.
    #[serde(default = "usual_turbidity", skip_serializing_if = "is_usual_turbidity")]
    pub turbidity: f64,
    /// Diffuse horizontal illuminance; used where illuminances are stated. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diffuse_horizontal: Option<f64>,
    /// Position of the sun by angles, and its direct illuminance.
    #[serde(default)]
    pub sun: SunKeys,
    /// Local time by the clock (`site.utc_offset`, `site.dst`), `YYYY-MM-DDTHH:MM[:SS]`, instead of sun angles; beside
    /// them only its date counts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<TimeKey>,
    /// Direct irradiance on the horizontal plane, for the Perez sky. \[W/m²\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direct_horizontal_irradiance: Option<f64>,
    /// Diffuse irradiance on the horizontal plane, for the Perez sky. \[W/m²\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diffuse_horizontal_irradiance: Option<f64>,
    /// File with the 145 luminances of Tregenza patches, for a measured sky.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Uniform skyline over the whole azimuth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub obstruction: Option<ObstructionKeys>,
    /// Skyline that rises and falls with the bearing, instead of `obstruction`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub skyline: Option<SkylineKeys>,
}

/// Default Linke turbidity.
pub const DEFAULT_TURBIDITY: f64 = 3.0;

const fn usual_turbidity() -> f64 {
    DEFAULT_TURBIDITY
}

/// Whether the turbidity is the default, which is not written.
fn is_usual_turbidity(turbidity: &f64) -> bool {
    *turbidity == DEFAULT_TURBIDITY
}

/// Key `sky.time`: a string, or a TOML date-time without offset.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum TimeKey {
    /// Quoted text.
    Text(String),
    /// TOML date-time without quotes.
    Toml(toml::value::Datetime),
}

impl TimeKey {
    /// Returns the key of a moment to the minute, to the second where it is not a whole minute.
    pub fn of(time: jiff::civil::DateTime) -> Self {
        let format = if time.second() == 0 { "%Y-%m-%dT%H:%M" } else { "%Y-%m-%dT%H:%M:%S" };
        Self::Text(time.strftime(format).to_string())
    }

    /// Returns the text of the time, whichever way it was written.
    pub fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Toml(time) => time.to_string(),
        }
    }
}

/// Key `sky.sun`: position and direct illuminance of the sun.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub struct SunKeys {
    /// True altitude of the sun, without refraction. \[°\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub altitude: Option<f64>,
    /// Compass bearing of the sun. \[°\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub azimuth: Option<f64>,
    /// Direct illuminance on a plane facing the sun; 0 = no disc. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direct_normal: Option<f64>,
}

/// Key `sky.obstruction`: uniform skyline.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObstructionKeys {
    /// Altitude of the skyline. \[°\]
    pub altitude: f64,
    /// Luminance below the skyline. \[cd/m²\]
    #[serde(default)]
    pub luminance: f64,
}
