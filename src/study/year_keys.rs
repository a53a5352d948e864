//! Keys of `[year]` in a scene, as typed: weather, hours, observers, electric lighting.

use super::weather_keys::{LightKey, OffsetKey};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Keys of `[year]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct YearKeys {
    /// Weather file, relative to the scene, or the name of a built-in year.
    pub weather: PathBuf,
    /// Source of the illuminances.
    #[serde(default, skip_serializing_if = "LightKey::is_default")]
    pub light: LightKey,
    /// Offset by which the weather's intervals lie later than the file says, or "auto". \[min\]
    #[serde(default, skip_serializing_if = "OffsetKey::is_default")]
    pub sun_offset_minutes: OffsetKey,
    /// Steps per hour, 1, 2, 4 or 12: the sun moves within an interval, its irradiances are constant.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub steps_per_hour: u32,
    /// Occupied hours.
    #[serde(default)]
    pub hours: HoursKeys,
    /// Reflectances of the ground, month by month, instead of `site.ground_reflectance`; none or twelve.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ground: Vec<f64>,
    /// Observers with their view directions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub eyes: Vec<EyeKeys>,
    /// Whether directly transmitted solar energy is computed.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub solar: bool,
    /// Whether spatial daylight autonomy is also computed with blinds operated by the rule of IES LM-83-12.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub lm83: bool,
    /// Whether daylight glare probability is computed for the observers in every lit occupied step.
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub dgp: bool,
    /// Day and minimum solar altitude of the exposure to sunlight by EN 17037.
    #[serde(default, skip_serializing_if = "SunlightKeys::is_default")]
    pub sunlight: SunlightKeys,
    /// Electric lighting; `None`: no figures of lighting.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lighting: Option<LightingKeys>,
}

const fn one() -> u32 {
    1
}

/// Whether the file can omit the key.
const fn is_one(steps: &u32) -> bool {
    *steps == 1
}

/// Keys of `year.hours`. Steps are occupied if their middle is in `from` to before `to` by the clock of `site.dst`;
/// with `from` later than `to` the hours extend across midnight.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct HoursKeys {
    /// Begin of the occupied hours, as hour of the day.
    pub from: f64,
    /// End of the occupied hours, as hour of the day.
    pub to: f64,
    /// Days with occupied hours.
    pub days: DaysKey,
}

impl Default for HoursKeys {
    fn default() -> Self {
        Self { from: 8.0, to: 18.0, days: DaysKey::All }
    }
}

impl HoursKeys {
    /// Whether `clock`, an hour of the day from 0 to before 24, is occupied.
    pub fn hold(&self, clock: f64) -> bool {
        if self.from < self.to { (self.from..self.to).contains(&clock) } else { clock >= self.from || clock < self.to }
    }
}

/// Keys of `year.sunlight`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SunlightKeys {
    /// Month and day, MM-DD, from 02-01 to 03-21.
    pub date: String,
    /// Minimum solar altitude that counts as sunlight, given by national annexes. \[°\]
    pub min_altitude: f64,
}

impl Default for SunlightKeys {
    fn default() -> Self {
        Self { date: "03-21".to_owned(), min_altitude: 10.0 }
    }
}

impl SunlightKeys {
    fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// Values of `year.hours.days`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum DaysKey {
    /// All days.
    #[default]
    All,
    /// Monday to Friday by the row's own date.
    Weekdays,
}

/// Keys of one observer in `year.eyes`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EyeKeys {
    /// Position of the eye in room axes. \[m\]
    pub point: [f64; 3],
    /// View direction in room axes.
    pub direction: [f64; 3],
}

/// Keys of `[year.lighting]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LightingKeys {
    /// Installed power. \[W/m²\]
    pub power: f64,
    /// Illuminance to be maintained. \[lx\]
    pub target: f64,
    /// Control of the electric lighting by daylight.
    #[serde(default)]
    pub control: LampControlKey,
    /// Number of power steps of "stepped".
    #[serde(default = "usual_steps")]
    pub steps: u32,
    /// Minimum light output of "dimming", as a share.
    #[serde(default)]
    pub min_light: f64,
    /// Power at the minimum light output of "dimming", as a share.
    #[serde(default)]
    pub min_power: f64,
    /// Whether lighting with "dimming" is switched off if daylight is sufficient.
    #[serde(default = "yes")]
    pub off: bool,
    /// Power while off, including nights. \[W/m²\]
    #[serde(default)]
    pub standby: f64,
    /// Lighting zones, each controlled by the mean of its sensors; empty: one zone of all sensors.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub zones: Vec<ZoneKeys>,
}

const fn usual_steps() -> u32 {
    3
}

const fn yes() -> bool {
    true
}

/// Whether the file can omit the key.
const fn is_yes(asked: &bool) -> bool {
    *asked
}

/// Values of `year.lighting.control`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LampControlKey {
    /// Always on in occupied hours.
    None,
    /// Switched on while daylight is not sufficient.
    OnOff,
    /// Switched in steps of power.
    Stepped,
    /// Continuously dimmed.
    #[default]
    Dimming,
}

/// Keys of one zone in `year.lighting.zones`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ZoneKeys {
    /// Indices of sensors, from 0.
    pub sensors: Vec<usize>,
    /// Share of the installed power.
    pub share: f64,
}
