//! Keys of the section `[control]`. The same table may stand in an `[[aperture]]` as `control = { … }` and rules there
//! alone.
//!
//! ```toml
//! [control]
//! mode = "cut-off"          # the most open state that blocks the whole disc of the sun
//!                           # "din-5034": closed while the façade gets direct sun
//!                           # "curve": a curve over the profile angle: the product's, or `curve`, or `curve_file`
//!                           # "retro-reflect": mirror slats across the beam, 90° − ψ
//!                           # "redirect": mirror slats that send the sun in at `elevation`, (elevation − ψ)/2
//!                           # "fixed": `state`, or the product's first;  "user": by `schedule`, else `state`
//!                           # "table": external states, `file`
//! state = "45"                                                    # fixed, user
//! schedule = [{ from = "08:00", to = "18:00", state = "45" }]     # user
//! curve = [[0.0, 64.0], [30.0, 25.0], [60.0, 0.0]]                # curve: (profile angle °, value of the state)
//! curve_file = "retro.csv"                                        # curve: columns profile_angle_deg, value_deg
//! file = "states.csv"                                             # table: columns time,state; held until the next row
//! rounding = "closed"       # or "nearest" (the default of redirect); not for cut-off
//! elevation = 30.0          # redirect \[°\]
//! slats = { width = 0.080, spacing = 0.072, rise = 0.0 }          # cut-off: where the product does not say
//! tolerance = 0.0           # cut-off: by how much a slat's angle may be missed \[°\]
//! threshold = 0.0           # direct sun on the façade that counts as sun \[lx\]
//! close_above = 70000.0     # total illuminance of the façade above which the device closes \[lx\]
//! open_below = 300.0        # indoor illuminance below which that closing, and DIN 5034's, is revoked \[lx\]
//! indoor = 250.0            # reading of the room's sensor now, or at all hours of a year \[lx\]
//! indoor_sensors = [0, 3]   # sensors from 0 whose mean a year reads, where `indoor` is not given; default: all
//! release = 1.0             # share of a threshold at which the state is released
//! hysteresis = 0.0          # by how much more open the rule must be before the device opens \[unit of the states\]
//! dwell = 0.0               # minimum time between a movement and the next opening \[min\]
//! open_state = "0"          # by day without direct sun (default: the most open)
//! closed_state = "75"       # state for DIN 5034 and close_above (default: the most closed)
//! night_state = "0"         # while the sun is down (default: the most open)
//! ```
//! Hysteresis and dwell time need a past: a single moment of a scene has none, a year has.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Key `control.mode`: rule by which the control chooses a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ControlMode {
    /// State that is most open among those that let no direct sun through.
    CutOff,
    /// Closed state while the façade gets direct sun, else the open state.
    #[serde(rename = "din-5034")]
    Din5034,
    /// State by a curve over the profile angle of the sun: that of the product or a given one.
    Curve,
    /// Tilt at which specular slats reflect direct sunlight back towards the sun.
    RetroReflect,
    /// Tilt at which specular slats redirect direct sunlight into the room at an elevation.
    Redirect,
    /// State that `control.state` names, or the first of the product.
    Fixed,
    /// States by periods of local time, set by the user.
    User,
    /// States from a file, row by row in time.
    Table,
}

impl ControlMode {
    /// Modes that can be chosen without a file, in the order of scene files.
    pub const ALL: [Self; 7] =
        [Self::CutOff, Self::Din5034, Self::Curve, Self::RetroReflect, Self::Redirect, Self::Fixed, Self::User];

    /// Returns the key of the mode in scene files.
    pub const fn word(self) -> &'static str {
        match self {
            Self::CutOff => "cut-off",
            Self::Din5034 => "din-5034",
            Self::Curve => "curve",
            Self::RetroReflect => "retro-reflect",
            Self::Redirect => "redirect",
            Self::Fixed => "fixed",
            Self::User => "user",
            Self::Table => "table",
        }
    }
}

/// Key `control.rounding`: choice of a state for the number that the rule demands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RoundingKey {
    /// State that is least closed among those not more open than demanded.
    Closed,
    /// State whose number is nearest to the demanded one.
    Nearest,
}

/// Key `control.slats`: cross-section of the slats.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlatKeys {
    /// Width of a slat (chord of its section), unless a profile is given. \[m\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    /// Vertical distance between slats. \[m\]
    pub spacing: f64,
    /// Rise of the arc of a slat above its chord, > 0 = convex side up. \[m\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rise: Option<f64>,
    /// Points of a slat's section at tilt 0: (outward, upward). \[m\]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub profile: Vec<[f64; 2]>,
}

/// Entry of the key `control.schedule`: a period of the day with a state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PeriodKeys {
    /// Start of the period in local time, `HH:MM`.
    pub from: String,
    /// End of the period in local time, `HH:MM`; if earlier than `from`, it is on the next day.
    pub to: String,
    /// Key of the state in the period.
    pub state: String,
}

/// Section `[control]` of a scene file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ControlKeys {
    /// Rule by which the control chooses a state.
    pub mode: ControlMode,
    /// Key of the state in mode "fixed"; in mode "user" that of the state outside the periods.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
    /// Elevation in which light is redirected into the room, for mode "redirect". \[°\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elevation: Option<f64>,
    /// Rule by which a demanded number becomes one of the states.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rounding: Option<RoundingKey>,
    /// Curve of mode "curve" as points: profile angle of the sun \[°\], and number of the state such as the slat angle
    /// \[°\].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub curve: Vec<[f64; 2]>,
    /// File with the curve of mode "curve", relative to the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub curve_file: Option<PathBuf>,
    /// File with times and states of mode "table", relative to the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Tolerance of a slat's tilt, for mode "cut-off". \[°\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Illuminance of the façade by direct sun above which it counts as sunlit. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub threshold: Option<f64>,
    /// Total illuminance of the façade above which the device closes. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub close_above: Option<f64>,
    /// Indoor illuminance below which closing by `close_above` and by DIN 5034 is revoked. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub open_below: Option<f64>,
    /// Reading of the room's illuminance sensor, at one moment or at all hours. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub indoor: Option<f64>,
    /// Indices (from 0) of the scene's sensors whose mean illuminance an annual simulation reads instead of `indoor`;
    /// none: all sensors.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub indoor_sensors: Vec<usize>,
    /// Fraction of a threshold at which the state that was set by exceeding the threshold is released.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub release: Option<f64>,
    /// Hysteresis: minimum difference by which the demanded state must be more open before the device opens, in the
    /// unit of the states' numbers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hysteresis: Option<f64>,
    /// Dwell time: minimum time between a movement and the next opening. \[min\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dwell: Option<f64>,
    /// Key of the state by day without direct sun; default: the most open one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub open_state: Option<String>,
    /// Key of the state for DIN 5034 and `close_above`; default: the most closed one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub closed_state: Option<String>,
    /// Key of the state while the sun is down; default: the most open one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub night_state: Option<String>,
    /// Periods of mode "user", in local time.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub schedule: Vec<PeriodKeys>,
    /// Cross-section of the slats for mode "cut-off", where the product does not specify one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slats: Option<SlatKeys>,
}

impl ControlKeys {
    /// Creates keys with a mode and no other setting.
    pub const fn of(mode: ControlMode) -> Self {
        Self {
            mode,
            state: None,
            elevation: None,
            rounding: None,
            curve: Vec::new(),
            curve_file: None,
            file: None,
            tolerance: None,
            threshold: None,
            close_above: None,
            open_below: None,
            indoor: None,
            indoor_sensors: Vec::new(),
            release: None,
            hysteresis: None,
            dwell: None,
            open_state: None,
            closed_state: None,
            night_state: None,
            schedule: Vec::new(),
            slats: None,
        }
    }

    /// Returns the keys for another mode, with the same thresholds, hysteresis and states; keys that only the old mode
    /// has are dropped.
    pub fn with_mode(&self, mode: ControlMode) -> Self {
        let keep = |modes: &[ControlMode]| modes.contains(&mode);
        let curve = keep(&[ControlMode::Curve]);
        Self {
            mode,
            state: self.state.clone().filter(|_| keep(&[ControlMode::Fixed, ControlMode::User])),
            elevation: self.elevation.filter(|_| keep(&[ControlMode::Redirect])),
            rounding: self.rounding.filter(|_| keep(&CURVES)),
            curve: if curve { self.curve.clone() } else { Vec::new() },
            curve_file: self.curve_file.clone().filter(|_| curve),
            file: self.file.clone().filter(|_| keep(&[ControlMode::Table])),
            tolerance: self.tolerance.filter(|_| keep(&[ControlMode::CutOff])),
            schedule: if keep(&[ControlMode::User]) { self.schedule.clone() } else { Vec::new() },
            ..self.clone()
        }
    }

    /// Returns the first key that is set but belongs to another mode, with the names of the modes to which it belongs;
    /// `None` if all keys suit the mode.
    pub fn misplaced(&self) -> Option<(&'static str, &'static str)> {
        use ControlMode::{Curve, CutOff, Fixed, Redirect, Table, User};
        let only = |key, given: bool, modes: &[ControlMode], word| {
            (given && !modes.contains(&self.mode)).then_some((key, word))
        };
        only("state", self.state.is_some(), &[Fixed, User], "\"fixed\" and \"user\"")
            .or_else(|| only("schedule", !self.schedule.is_empty(), &[User], "\"user\""))
            .or_else(|| only("curve", !self.curve.is_empty(), &[Curve], "\"curve\""))
            .or_else(|| only("curve_file", self.curve_file.is_some(), &[Curve], "\"curve\""))
            .or_else(|| only("file", self.file.is_some(), &[Table], "\"table\""))
            .or_else(|| only("elevation", self.elevation.is_some(), &[Redirect], "\"redirect\""))
            .or_else(|| only("tolerance", self.tolerance.is_some(), &[CutOff], "\"cut-off\""))
            .or_else(|| {
                only("rounding", self.rounding.is_some(), &CURVES, "\"curve\", \"retro-reflect\" and \"redirect\"")
            })
    }
}

/// Modes that demand a number and round it to a state.
const CURVES: [ControlMode; 3] = [ControlMode::Curve, ControlMode::RetroReflect, ControlMode::Redirect];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_those_of_the_file() {
        for mode in ControlMode::ALL.into_iter().chain([ControlMode::Table]) {
            let keys: ControlKeys = toml::from_str(&format!("mode = \"{}\"", mode.word())).unwrap();
            assert_eq!(keys, ControlKeys::of(mode));
            assert_eq!(toml::from_str::<ControlKeys>(&toml::to_string(&keys).unwrap()).unwrap(), keys);
        }
    }

    #[test]
    fn a_change_of_rule_leaves_no_key_behind_that_it_does_not_take() {
        let full = ControlKeys {
            state: Some("0".into()),
            elevation: Some(30.0),
            rounding: Some(RoundingKey::Closed),
            curve: vec![[0.0, 1.0]],
            curve_file: Some("a.csv".into()),
            tolerance: Some(1.0),
            dwell: Some(5.0),
            schedule: vec![PeriodKeys { from: "08:00".into(), to: "09:00".into(), state: "0".into() }],
            ..ControlKeys::of(ControlMode::CutOff)
        };
        assert!(full.misplaced().is_some());
        for mode in ControlMode::ALL.into_iter().chain([ControlMode::Table]) {
            let keys = full.with_mode(mode);
            assert_eq!((keys.misplaced(), keys.dwell), (None, Some(5.0)), "{mode:?}");
        }
    }
}
