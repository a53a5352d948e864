//! `[control]` as typed. The same table may stand in an `[[aperture]]` as `control = { … }` and then rules there alone.
//!
//! ```toml
//! [control]
//! mode = "cut-off"          # the most open state that keeps the whole disc of the sun out
//!                           # "din-5034": closed while the façade gets direct sun
//!                           # "curve": a curve over the profile angle: the product's, or `curve`, or `curve_file`
//!                           # "retro-reflect": mirror slats across the beam, 90° − ψ
//!                           # "redirect": mirror slats that send the sun in at `elevation`, (elevation − ψ)/2
//!                           # "fixed": `state`, or the product's first;  "user": by `schedule`, else `state`
//!                           # "table": states given from elsewhere, `file`
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
//! close_above = 70000.0     # façade in all: above it the device closes \[lx\]
//! open_below = 300.0        # indoors: below it that closing, and DIN 5034's, is taken back \[lx\]
//! indoor = 250.0            # what the room's sensor reads now, or at all hours of a year \[lx\]
//! indoor_sensors = [0, 3]   # a year reads the mean of these sensors of the scene, from 0, where `indoor` is not given; default: all
//! release = 1.0             # share of a threshold at which it lets go
//! hysteresis = 0.0          # how much more open the rule must be before the device opens \[unit of the states\]
//! dwell = 0.0               # least time between a movement and the next opening \[min\]
//! open_state = "0"          # by day without direct sun (default: the most open)
//! closed_state = "75"       # what DIN 5034 and close_above take (default: the most closed)
//! night_state = "0"         # while the sun is down (default: the most open)
//! ```
//! Hysteresis and dwell time need a past: a single moment of a scene has none, a year has.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// `control.mode`
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ControlMode {
    /// The most open state that lets no direct sun through.
    CutOff,
    /// Closed while the façade gets direct sun.
    #[serde(rename = "din-5034")]
    Din5034,
    /// A curve over the solar profile angle: the product's own or one that is given.
    Curve,
    /// Mirror slats throw the sun back.
    RetroReflect,
    /// Mirror slats send the sun in at an elevation.
    Redirect,
    /// The state that is named, or the product's first.
    Fixed,
    /// By the clock.
    User,
    /// States given from elsewhere, row by row in time.
    Table,
}

impl ControlMode {
    /// All that can be chosen without a file, as scene files order them.
    pub const ALL: [Self; 7] =
        [Self::CutOff, Self::Din5034, Self::Curve, Self::RetroReflect, Self::Redirect, Self::Fixed, Self::User];

    /// The word in scene files.
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

/// `control.rounding`
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RoundingKey {
    /// The least closed state that reaches the curve.
    Closed,
    /// The nearest.
    Nearest,
}

/// `control.slats`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlatKeys {
    /// Chord, unless a profile is given. \[m\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    /// Vertical pitch. \[m\]
    pub spacing: f64,
    /// Crown of an arc, > 0 = convex side up. \[m\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rise: Option<f64>,
    /// Section at angle 0: (outward, upward). \[m\]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub profile: Vec<[f64; 2]>,
}

/// `control.schedule`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PeriodKeys {
    /// `HH:MM`
    pub from: String,
    /// `HH:MM`; before `from`: over midnight.
    pub to: String,
    /// Key of the state.
    pub state: String,
}

/// `[control]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ControlKeys {
    /// Which rule.
    pub mode: ControlMode,
    /// Fixed: the state; user: the state outside the periods.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub state: Option<String>,
    /// Redirect: elevation of the light in the room. \[°\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elevation: Option<f64>,
    /// How a demanded value becomes a state.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rounding: Option<RoundingKey>,
    /// Curve: (profile angle \[°\], value).
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub curve: Vec<[f64; 2]>,
    /// Curve: a file, relative to the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub curve_file: Option<PathBuf>,
    /// Table: times and states, relative to the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Cut-off: may be missed by. \[°\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Direct sun above it counts. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub threshold: Option<f64>,
    /// Façade in all, closes. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub close_above: Option<f64>,
    /// Indoors, takes closing back. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub open_below: Option<f64>,
    /// Reading of the room's sensor. \[lx\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub indoor: Option<f64>,
    /// Sensors of the scene, from 0, whose mean a year reads instead; none: all.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub indoor_sensors: Vec<usize>,
    /// Share of a threshold at which it lets go.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub release: Option<f64>,
    /// In the unit of the states' numbers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hysteresis: Option<f64>,
    /// \[min\]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dwell: Option<f64>,
    /// By day without direct sun.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub open_state: Option<String>,
    /// For DIN 5034 and `close_above`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub closed_state: Option<String>,
    /// While the sun is down.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub night_state: Option<String>,
    /// User: by the clock.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub schedule: Vec<PeriodKeys>,
    /// Cut-off: the section, where the product does not say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slats: Option<SlatKeys>,
}

impl ControlKeys {
    /// A rule alone.
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

    /// Another rule with the same thresholds, hysteresis and states; what belongs to the old rule alone is dropped.
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

    /// The first key that another mode would take, with that mode's word.
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

/// Modes that round a demanded value.
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
