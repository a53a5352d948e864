//! `[year]` of a scene as typed: which weather, which hours, which eyes, which lamps.

use super::weather_keys::{LightKey, OffsetKey};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// `[year]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct YearKeys {
    /// Weather file, relative to the scene, or a year that comes with the program.
    pub weather: PathBuf,
    /// Where illuminances come from.
    #[serde(default, skip_serializing_if = "LightKey::is_default")]
    pub light: LightKey,
    /// Minutes by which the weather's intervals lie later than the file says, or "auto".
    #[serde(default, skip_serializing_if = "OffsetKey::is_default")]
    pub sun_offset_minutes: OffsetKey,
    /// Steps an hour, 1, 2, 4 or 12: the sun moves inside an interval, its irradiances stay.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub steps_per_hour: u32,
    /// When somebody is there.
    #[serde(default)]
    pub hours: HoursKeys,
    /// Reflectances of the ground, month by month, instead of `site.ground_reflectance`; none or twelve.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ground: Vec<f64>,
    /// Where somebody looks, and whither.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub eyes: Vec<EyeKeys>,
    /// Is solar energy asked for, directly transmitted?
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub solar: bool,
    /// Is spatial daylight autonomy asked for with blinds by IES LM-83-12's own rule?
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub lm83: bool,
    /// Daylight glare probability at the eyes in every lit occupied step?
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub dgp: bool,
    /// The day of EN 17037's exposure to sunlight.
    #[serde(default, skip_serializing_if = "SunlightKeys::is_default")]
    pub sunlight: SunlightKeys,
    /// Lamps; without them there are no figures of lighting.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lighting: Option<LightingKeys>,
}

const fn one() -> u32 {
    1
}

/// Nothing that the file needs to say.
const fn is_one(steps: &u32) -> bool {
    *steps == 1
}

/// `year.hours`: occupied are steps whose middle lies in `from` to before `to` by the clock of `site.dst`; with `from` later
/// than `to` the hours run across midnight.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct HoursKeys {
    /// Hour of the day.
    pub from: f64,
    /// Hour of the day.
    pub to: f64,
    /// Which days.
    pub days: DaysKey,
}

impl Default for HoursKeys {
    fn default() -> Self {
        Self { from: 8.0, to: 18.0, days: DaysKey::All }
    }
}

impl HoursKeys {
    /// Whether `clock`, an hour of the day from 0 to before 24, is one of them.
    pub fn hold(&self, clock: f64) -> bool {
        if self.from < self.to { (self.from..self.to).contains(&clock) } else { clock >= self.from || clock < self.to }
    }
}

/// `year.sunlight`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SunlightKeys {
    /// Month and day, MM-DD, from 02-01 to 03-21.
    pub date: String,
    /// The sun counts from this altitude on; national annexes name it. \[°\]
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

/// `year.hours.days`
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum DaysKey {
    /// All days.
    #[default]
    All,
    /// Monday to Friday by the row's own date.
    Weekdays,
}

/// One of `year.eyes`
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EyeKeys {
    /// Room axes. \[m\]
    pub point: [f64; 3],
    /// Room axes.
    pub direction: [f64; 3],
}

/// `[year.lighting]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LightingKeys {
    /// Installed. \[W/m²\]
    pub power: f64,
    /// Illuminance to be reached. \[lx\]
    pub target: f64,
    /// How lamps follow daylight.
    #[serde(default)]
    pub control: LampControlKey,
    /// Of "stepped".
    #[serde(default = "usual_steps")]
    pub steps: u32,
    /// Of "dimming": least light, as a share.
    #[serde(default)]
    pub min_light: f64,
    /// Of "dimming": the power that least light takes, as a share.
    #[serde(default)]
    pub min_power: f64,
    /// Of "dimming": off when daylight suffices.
    #[serde(default = "yes")]
    pub off: bool,
    /// Taken while off, nights included. \[W/m²\]
    #[serde(default)]
    pub standby: f64,
    /// Lamps that follow the mean of some sensors; none: one zone of all sensors.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub zones: Vec<ZoneKeys>,
}

const fn usual_steps() -> u32 {
    3
}

const fn yes() -> bool {
    true
}

/// Nothing that the file needs to say.
const fn is_yes(asked: &bool) -> bool {
    *asked
}

/// `year.lighting.control`
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LampControlKey {
    /// Always on while somebody is there.
    None,
    /// On while daylight does not suffice.
    OnOff,
    /// In steps of power.
    Stepped,
    /// Dimmed.
    #[default]
    Dimming,
}

/// One of `year.lighting.zones`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ZoneKeys {
    /// Indices of sensors, from 0.
    pub sensors: Vec<usize>,
    /// Share of the installed power.
    pub share: f64,
}
