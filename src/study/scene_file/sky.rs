//! Keys of the section `[sky]` in a scene file: sky model, sun, and the illuminances to which both are scaled.

use super::outside::SkylineKeys;
use crate::study::weather_keys::{LightKey, OffsetKey};
use crate::texts::words as texts;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Key `sky.model`: sky model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SkyModelKey {
    /// CIE general sky: types 1–15 of ISO 15469, and 16 for the traditional overcast sky.
    Cie,
    /// Uniform sky, with the same luminance in all directions.
    Uniform,
    /// Perez all-weather sky.
    Perez,
    /// Measured sky (scan) with 145 luminances.
    Scan,
    /// No model: sky of the hour in the weather file that `sky.weather` names.
    #[serde(skip)]
    Weather,
}

impl SkyModelKey {
    /// Models that a scene can name, in the order in which lists show them.
    pub const ALL: [Self; 4] = [Self::Cie, Self::Uniform, Self::Perez, Self::Scan];

    /// Returns three names of the model: for a list, for the title of a scene, and for the header of a luminaire file,
    /// which is in English.
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

    /// Whether the sky is scaled to given illuminances. The Perez sky and a measured sky have absolute values.
    pub const fn takes_illuminances(self) -> bool {
        !matches!(self, Self::Perez | Self::Scan | Self::Weather)
    }

    /// Returns the model of a sky without the key `model`, which is that of the weather hour.
    const fn of_weather() -> Self {
        Self::Weather
    }

    /// Whether the model is not written to the file, because `sky.weather` replaces it.
    const fn is_weather(&self) -> bool {
        matches!(self, Self::Weather)
    }
}

/// Key `sky.illuminance`: source of the illuminances to which a CIE or uniform sky and its sun are scaled. It has no
/// effect on a Perez sky and a measured sky.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum IlluminanceKey {
    /// Values of the keys `diffuse_horizontal` and `sun.direct_normal`.
    #[default]
    #[serde(rename = "stated")]
    Stated,
    /// Values by the sun's altitude: for CIE types 11–15 from `turbidity` and `site.elevation`, for other types from
    /// the cloud covers of IES RP-21.
    #[serde(rename = "clear-sky")]
    ClearSky,
    /// Values by the sun's altitude and the three cloud covers of IES RP-21.
    #[serde(rename = "rp-21")]
    Rp21,
}

impl IlluminanceKey {
    /// Sources in the order in which lists show them.
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
    /// Sky model; not written to the file if `weather` is given.
    #[serde(default = "SkyModelKey::of_weather", skip_serializing_if = "SkyModelKey::is_weather")]
    pub model: SkyModelKey,
    /// Weather file (.epw, .wea) or built-in year. Its hour at `time` replaces the model and all its values; month, day
    /// and time of day of `time` are used, the year is that of the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weather: Option<PathBuf>,
    /// Source of the illuminances in the weather file: irradiances, or illuminances of the file.
    #[serde(default, skip_serializing_if = "LightKey::is_default")]
    pub light: LightKey,
    /// Time by which the intervals of the weather file lie later than the file says, or "auto". \[min\]
    #[serde(default, skip_serializing_if = "OffsetKey::is_default")]
    pub sun_offset_minutes: OffsetKey,
    /// CIE sky type, 1 … 16.
    #[serde(rename = "type", default, skip_serializing_if = "Option::is_none")]
    pub cie_type: Option<u8>,
    /// Source of the illuminances to which sky and sun are scaled; always written, because scenes of earlier versions
    /// lack the key.
    #[serde(default)]
    pub illuminance: IlluminanceKey,
    /// Linke turbidity of the atmosphere, for `illuminance = "clear-sky"`.
    #[serde(default = "usual_turbidity", skip_serializing_if = "is_usual_turbidity")]
    pub turbidity: f64,
    /// Diffuse horizontal illuminance, used if `illuminance` says that values are given. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diffuse_horizontal: Option<f64>,
    /// Position of the sun by angles, and its direct normal illuminance.
    #[serde(default)]
    pub sun: SunKeys,
    /// Local time by the clock (`site.utc_offset`, `site.dst`), `YYYY-MM-DDTHH:MM[:SS]`, in place of sun angles; if
    /// angles are given, only its date is used.
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
    /// Uniform skyline, of the same altitude all round.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub obstruction: Option<ObstructionKeys>,
    /// Skyline whose altitude varies with the bearing, in place of `obstruction`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub skyline: Option<SkylineKeys>,
}

/// Direct and diffuse irradiance on the horizontal plane with which a Perez sky begins. \[W/m²\]
pub const USUAL_IRRADIANCES: [f64; 2] = [300.0, 120.0];

impl SkyKeys {
    /// Changes the sky model: removes the keys of the former one, and gives those that the new one needs usual values;
    /// only the file of a measured sky must still be set.
    pub fn choose(&mut self, model: SkyModelKey) {
        self.model = model;
        self.cie_type = (model == SkyModelKey::Cie).then_some(12);
        let [direct, diffuse] = USUAL_IRRADIANCES.map(|value| (model == SkyModelKey::Perez).then_some(value));
        (self.direct_horizontal_irradiance, self.diffuse_horizontal_irradiance) = (direct, diffuse);
        self.file = None;
        self.weather = None;
        self.light = LightKey::default();
        self.sun_offset_minutes = OffsetKey::default();
        match model {
            SkyModelKey::Perez => {
                self.diffuse_horizontal = None;
                self.sun.direct_normal = None;
            }
            SkyModelKey::Scan => self.diffuse_horizontal = None,
            // What follows the sun needs no figures.
            _ if self.illuminance == IlluminanceKey::Stated => {
                self.diffuse_horizontal.get_or_insert(10_000.0);
            }
            _ => {}
        }
    }
}

/// Default Linke turbidity of the atmosphere.
pub const DEFAULT_TURBIDITY: f64 = 3.0;

const fn usual_turbidity() -> f64 {
    DEFAULT_TURBIDITY
}

/// Whether the turbidity has the default value, which is not written to the file.
fn is_usual_turbidity(turbidity: &f64) -> bool {
    *turbidity == DEFAULT_TURBIDITY
}

/// Key `sky.time`: local time as a string, or as a TOML date-time without offset.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum TimeKey {
    /// Quoted text.
    Text(String),
    /// TOML date-time without quotes.
    Toml(toml::value::Datetime),
}

impl TimeKey {
    /// Returns the key for a moment, to the minute, or to the second if it is not a whole minute.
    pub fn of(time: jiff::civil::DateTime) -> Self {
        let format = if time.second() == 0 { "%Y-%m-%dT%H:%M" } else { "%Y-%m-%dT%H:%M:%S" };
        Self::Text(time.strftime(format).to_string())
    }

    /// Returns the text of the time, in whichever form it was written.
    pub fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Toml(time) => time.to_string(),
        }
    }
}

/// Key `sky.sun`: position and direct normal illuminance of the sun.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub struct SunKeys {
    /// True altitude of the sun, without refraction. \[°\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub altitude: Option<f64>,
    /// Compass bearing of the sun, clockwise from north. \[°\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub azimuth: Option<f64>,
    /// Direct normal illuminance by the sun; 0: no solar disc. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direct_normal: Option<f64>,
}

/// Key `sky.obstruction`: uniform skyline, of the same altitude all round.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObstructionKeys {
    /// Altitude of the skyline. \[°\]
    pub altitude: f64,
    /// Luminance of everything below the skyline. \[cd/m²\]
    #[serde(default)]
    pub luminance: f64,
}
