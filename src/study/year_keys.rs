//! Keys `[year]` of a scene file: weather, hours, observers, electric lighting.

use super::weather_keys::{LightKey, OffsetKey};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Section `[year]` of a scene file: annual simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct YearKeys {
    /// Weather file, relative to the scene, or the name of a built-in year.
    pub weather: PathBuf,
    /// Source of the illuminances in the weather file: irradiances, or illuminances of the file.
    #[serde(default, skip_serializing_if = "LightKey::is_default")]
    pub light: LightKey,
    /// Time by which the intervals of the weather file lie later than the file says, or "auto". \[min\]
    #[serde(default, skip_serializing_if = "OffsetKey::is_default")]
    pub sun_offset_minutes: OffsetKey,
    /// Number of steps per hour, 1, 2, 4 or 12: the sun moves within an interval of the weather file, its irradiances
    /// are constant.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub steps_per_hour: u32,
    /// Occupied hours of the room.
    #[serde(default)]
    pub hours: HoursKeys,
    /// Reflectances of the ground from January to December, in place of `site.ground_reflectance`; none or twelve.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ground: Vec<f64>,
    /// Observers with their view directions, for glare.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub eyes: Vec<EyeKeys>,
    /// Whether solar energy that is directly transmitted through the apertures is computed.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub solar: bool,
    /// Whether spatial daylight autonomy is also computed with blinds operated by the rule of IES LM-83-12.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub lm83: bool,
    /// Whether daylight glare probability (DGP) is computed for the observers, in every lit occupied step.
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub dgp: bool,
    /// Day and minimum solar altitude for the exposure to sunlight by EN 17037.
    #[serde(default, skip_serializing_if = "SunlightKeys::is_default")]
    pub sunlight: SunlightKeys,
    /// Electric lighting; `None`: no figures of lighting.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lighting: Option<LightingKeys>,
}

const fn one() -> u32 {
    1
}

/// Whether the number of steps per hour is the default, which is not written to the file.
const fn is_one(steps: &u32) -> bool {
    *steps == 1
}

/// Key `year.hours`: occupied hours. A step is occupied if its middle is not before `from` and before `to`, by the
/// clock with the rule `site.dst`; with `from` later than `to` the hours extend across midnight.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct HoursKeys {
    /// Begin of the occupied hours, in hours from midnight. \[h\]
    pub from: f64,
    /// End of the occupied hours, in hours from midnight. \[h\]
    pub to: f64,
    /// Days of the week with occupied hours.
    pub days: DaysKey,
}

impl Default for HoursKeys {
    fn default() -> Self {
        Self { from: 8.0, to: 18.0, days: DaysKey::All }
    }
}

impl HoursKeys {
    /// Whether a time by the clock is within the occupied hours. `clock`: hours from midnight, from 0 to before 24.
    /// \[h\]
    pub fn hold(&self, clock: f64) -> bool {
        if self.from < self.to { (self.from..self.to).contains(&clock) } else { clock >= self.from || clock < self.to }
    }
}

/// Key `year.sunlight`: day and minimum solar altitude for the exposure to sunlight by EN 17037.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SunlightKeys {
    /// Month and day of the evaluation, MM-DD, from 02-01 to 03-21.
    pub date: String,
    /// Minimum solar altitude at which the sun counts, given by national annexes. \[°\]
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

/// Value of `year.hours.days`: days of the week with occupied hours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum DaysKey {
    /// All days of the week.
    #[default]
    All,
    /// Monday to Friday, by the date of the weather record.
    Weekdays,
}

/// Entry of `year.eyes`: position and view direction of one observer.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EyeKeys {
    /// Position of the eye in room axes. \[m\]
    pub point: [f64; 3],
    /// View direction in room axes.
    pub direction: [f64; 3],
}

/// Section `[year.lighting]` of a scene file: electric lighting.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LightingKeys {
    /// Installed power per floor area. \[W/m²\]
    pub power: f64,
    /// Illuminance to be maintained by daylight and electric lighting together. \[lx\]
    pub target: f64,
    /// Control of the electric lighting by daylight.
    #[serde(default)]
    pub control: LampControlKey,
    /// Number of power steps, for the control "stepped".
    #[serde(default = "usual_steps")]
    pub steps: u32,
    /// Minimum light output for the control "dimming", as a share of the full output.
    #[serde(default)]
    pub min_light: f64,
    /// Power at the minimum light output for the control "dimming", as a share of the installed power.
    #[serde(default)]
    pub min_power: f64,
    /// Whether lighting with the control "dimming" is switched off if daylight is sufficient.
    #[serde(default = "yes")]
    pub off: bool,
    /// Power while the lighting is off, including nights. \[W/m²\]
    #[serde(default)]
    pub standby: f64,
    /// Lighting zones, each controlled by the mean illuminance of its sensors; empty: one zone with all sensors.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub zones: Vec<ZoneKeys>,
}

const fn usual_steps() -> u32 {
    3
}

const fn yes() -> bool {
    true
}

/// Whether a switch has the default value `true`, which is not written to the file.
const fn is_yes(asked: &bool) -> bool {
    *asked
}

/// Value of `year.lighting.control`: control of the electric lighting by daylight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LampControlKey {
    /// No control: lighting is always on in occupied hours.
    None,
    /// Lighting is switched on while daylight is not sufficient.
    OnOff,
    /// Lighting is switched in steps of power.
    Stepped,
    /// Lighting is dimmed continuously.
    #[default]
    Dimming,
}

/// Entry of `year.lighting.zones`: one lighting zone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ZoneKeys {
    /// Indices of the scene's sensors in the zone, from 0.
    pub sensors: Vec<usize>,
    /// Share of the installed power that the zone has.
    pub share: f64,
}
