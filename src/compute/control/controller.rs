//! A controller that follows a rule through time: thresholds, hysteresis, minimum dwell time, night.
//!
//! What keeps the sun out is never delayed: the controller closes at once, and waits only before it opens. A rule that
//! rounds to the nearest state (redirection) waits before every movement.

use super::curve::{curve_range, curve_value, redirecting_tilt, retro_tilt};
use super::cut_off::SlatRow;
use super::states::{by_openness, most_closed, most_open, nearest, towards_closed};

/// How a demanded value becomes a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rounding {
    /// The least closed state that reaches it.
    Closed,
    /// The nearest one.
    Nearest,
}

/// A state by the clock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Period {
    /// From this hour of the day …
    pub from: f64,
    /// … until this one; before `from`: over midnight.
    pub to: f64,
    /// Index of the state.
    pub state: usize,
}

/// What is demanded while the sun is on the façade, or at all times.
#[derive(Debug, Clone, PartialEq)]
pub enum Rule {
    /// The most open state that lets no direct light through.
    CutOff {
        /// The slats.
        section: SlatRow,
        /// By how much a tilt may be missed. \[rad\]
        tolerance: f64,
    },
    /// Closed while the façade gets direct sun (DIN 5034).
    Din5034,
    /// A table of (profile angle, value), profile angles rising.
    Curve(Vec<(f64, f64)>, Rounding),
    /// Mirror slats that throw the sun back.
    RetroReflect(Rounding),
    /// Mirror slats that send the sun into the room at this elevation. \[rad\]
    Redirect(f64, Rounding),
    /// Always one state.
    Fixed(usize),
    /// By the clock; between the periods the state that is given first.
    User(usize, Vec<Period>),
    /// Rows of a table: (seconds since the beginning of the year, index of the state), rising; each holds until the next,
    /// the last to the end of the year.
    Table(Vec<(f64, usize)>),
}

/// Everything that a controller is set to.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Values of the device's states, in their own unit; tilts in radians.
    pub values: Vec<f64>,
    /// What is followed.
    pub rule: Rule,
    /// State that DIN 5034 and `close_above` take.
    pub closed: usize,
    /// State by day without direct sun.
    pub open: usize,
    /// State while the sun is down.
    pub night: usize,
    /// Direct illuminance of the façade above which there is direct sun. \[lx\]
    pub threshold: f64,
    /// Illuminance of the façade in all above which the device closes, whatever the rule. \[lx\]
    pub close_above: Option<f64>,
    /// Illuminance indoors below which it is not closed further than the rule's slats: takes back what DIN 5034 and
    /// `close_above` closed. \[lx\]
    pub open_below: Option<f64>,
    /// Share of a threshold at which it lets go again, 0 … 1; of `open_below` its inverse.
    pub release: f64,
    /// How much more open than its state the rule must be before the device opens, in the unit of the values.
    pub hysteresis: f64,
    /// Least time between a movement and the next opening. \[s\]
    pub dwell: f64,
}

impl Settings {
    /// A rule without thresholds, hysteresis and dwell time. `None` without states.
    pub fn new(values: Vec<f64>, rule: Rule) -> Option<Self> {
        let (open, closed) = (most_open(&values)?, most_closed(&values)?);
        Some(Self {
            values,
            rule,
            closed,
            open,
            night: open,
            threshold: 0.0,
            close_above: None,
            open_below: None,
            release: 1.0,
            hysteresis: 0.0,
            dwell: 0.0,
        })
    }
}

impl Settings {
    /// What the rule asks for over profile angles from 0 to 90°, in steps of 1°, for a sun without extent, kept within the
    /// values of the device: what a picture shows. \[rad\] Tables as they are; empty for rules without a curve.
    pub fn curve(&self) -> Vec<(f64, f64)> {
        let range = self.range();
        let sampled = |value: &dyn Fn(f64) -> Option<f64>| {
            let angles = (0..=90).map(|k| f64::from(k).to_radians());
            angles.filter_map(|psi| Some((psi, value(psi)?.clamp(range[0], range[1])))).collect()
        };
        match &self.rule {
            Rule::CutOff { section, tolerance } => sampled(&|psi| section.cut_off(range, *tolerance, [psi, psi])),
            Rule::Curve(points, _) => points.clone(),
            Rule::RetroReflect(_) => sampled(&|psi| Some(retro_tilt(psi))),
            Rule::Redirect(elevation, _) => sampled(&|psi| Some(redirecting_tilt(psi, *elevation))),
            Rule::Din5034 | Rule::Fixed(_) | Rule::User(..) | Rule::Table(_) => Vec::new(),
        }
    }

    /// Least and greatest value of the states.
    fn range(&self) -> [f64; 2] {
        self.values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(*v), b.max(*v)])
    }
}

/// What the controller's sensors and clock say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inputs {
    /// Hour of the day, local. \[h\]
    pub hour: f64,
    /// Seconds since the beginning of the year, local standard time, in a calendar of 366 days; `None` without a date. \[s\]
    pub of_year: Option<f64>,
    /// Is any of the sun above the horizon?
    pub day: bool,
    /// Profile angle of the sun's centre, and of the least and greatest of its visible disc; `None` while nothing of it is
    /// before the façade. \[rad\]
    pub sun: Option<SunAt>,
    /// Illuminance of the façade by the sun. \[lx\]
    pub facade_direct: f64,
    /// The same by sun, sky and ground. \[lx\]
    pub facade_global: f64,
    /// What a sensor in the room reads, where there is one. \[lx\]
    pub indoor: Option<f64>,
}

/// The sun in the section. \[rad\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SunAt {
    /// Profile angle of the centre, kept within the span.
    pub centre: f64,
    /// Least and greatest profile angle of the visible disc.
    pub span: [f64; 2],
}

/// Why a state was chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// It always is.
    Fixed,
    /// The clock.
    Schedule,
    /// The sun is down.
    Night,
    /// It is day, but no direct sun on the façade.
    NoSun,
    /// The rule for direct sun.
    Sun,
    /// The façade is brighter than `close_above`.
    Bright,
    /// The room is darker than `open_below`.
    Dark,
}

impl Reason {
    /// The word in tables.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Schedule => "schedule",
            Self::Night => "night",
            Self::NoSun => "no-sun",
            Self::Sun => "sun",
            Self::Bright => "bright",
            Self::Dark => "dark",
        }
    }
}

/// What a step did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decision {
    /// Index of the state.
    pub state: usize,
    /// Value that the rule asks for without regard to states; `None` where it asks for none.
    pub demanded: Option<f64>,
    /// Why.
    pub reason: Reason,
    /// Another state than the step before.
    pub moved: bool,
    /// Hysteresis or dwell time keeps it from the state that is wanted.
    pub held: bool,
}

/// Steps through time.
#[derive(Debug, Clone)]
pub struct Controller {
    settings: Settings,
    state: Option<usize>,
    moved_at: f64,
    lit: bool,
    bright: bool,
    dark: bool,
}

/// What is wanted at a step, before it is weighed against what is.
struct Wanted {
    state: usize,
    demanded: Option<f64>,
    reason: Reason,
}

impl Controller {
    /// At no state yet: the first step takes what is wanted.
    pub const fn new(settings: Settings) -> Self {
        Self { settings, state: None, moved_at: f64::NEG_INFINITY, lit: false, bright: false, dark: false }
    }

    /// What it was set to.
    pub const fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The state at `time` \[s\], which does not go back.
    pub fn step(&mut self, time: f64, inputs: &Inputs) -> Decision {
        self.read(inputs);
        let wanted = self.wanted(inputs, 0.0);
        let Some(now) = self.state else {
            self.state = Some(wanted.state);
            return Decision {
                state: wanted.state,
                demanded: wanted.demanded,
                reason: wanted.reason,
                moved: false,
                held: false,
            };
        };
        let state = self.weighed(now, &wanted, time, inputs);
        let moved = state != now;
        if moved {
            self.state = Some(state);
            self.moved_at = time;
        }
        Decision { state, demanded: wanted.demanded, reason: wanted.reason, moved, held: state != wanted.state }
    }

    /// Thresholds with their release.
    fn read(&mut self, inputs: &Inputs) {
        let s = &self.settings;
        let above = |was: bool, limit: f64, value: f64| value > if was { limit * s.release } else { limit };
        self.lit = inputs.sun.is_some() && above(self.lit, s.threshold, inputs.facade_direct);
        self.bright = s.close_above.is_some_and(|limit| above(self.bright, limit, inputs.facade_global));
        // The other way round: dark until the room is brighter than the threshold by as much.
        self.dark = match (s.open_below, inputs.indoor) {
            (Some(limit), Some(indoor)) => indoor < if self.dark { limit / s.release.max(1e-3) } else { limit },
            _ => false,
        };
    }

    /// What settings and inputs ask for; slats in the sun closed further by `margin`.
    fn wanted(&self, inputs: &Inputs, margin: f64) -> Wanted {
        let s = &self.settings;
        let plain = |state, reason| Wanted { state, demanded: None, reason };
        match &s.rule {
            Rule::Fixed(state) => return plain(*state, Reason::Fixed),
            Rule::User(otherwise, periods) => {
                let holds = |p: &&Period| {
                    let (after, before) = (inputs.hour >= p.from, inputs.hour < p.to);
                    if p.from <= p.to { after && before } else { after || before }
                };
                return plain(periods.iter().find(holds).map_or(*otherwise, |p| p.state), Reason::Schedule);
            }
            Rule::Table(rows) => {
                let now = inputs.of_year.unwrap_or(f64::NEG_INFINITY);
                let begun = rows.partition_point(|(from, _)| *from <= now);
                // Before the table begins, and without a date, its first row is the nearest.
                let row = rows.get(begun.saturating_sub(1));
                return plain(row.map_or(0, |(_, state)| *state), Reason::Schedule);
            }
            _ => {}
        }
        if !inputs.day {
            return plain(s.night, Reason::Night);
        }
        let by_rule = match inputs.sun.filter(|_| self.lit) {
            None => plain(s.open, Reason::NoSun),
            Some(_) if s.rule == Rule::Din5034 && self.dark => plain(s.open, Reason::Dark),
            Some(sun) => {
                let (demanded, state) = self.in_sun(sun, margin);
                Wanted { state, demanded, reason: Reason::Sun }
            }
        };
        let more_closed = |a: usize, b: usize| s.values[a].abs() > s.values[b].abs();
        if self.bright && !self.dark && more_closed(s.closed, by_rule.state) {
            return Wanted { state: s.closed, demanded: by_rule.demanded, reason: Reason::Bright };
        }
        by_rule
    }

    /// Demanded value and state of the rule in direct sun.
    fn in_sun(&self, sun: SunAt, margin: f64) -> (Option<f64>, usize) {
        let s = &self.settings;
        let rounded = |value: f64, rounding: Rounding| match rounding {
            Rounding::Closed => towards_closed(&s.values, value + margin),
            Rounding::Nearest => nearest(&s.values, value),
        };
        let (demanded, state) = match &s.rule {
            Rule::CutOff { section, tolerance } => {
                let demanded = section.cut_off(s.range(), *tolerance, sun.span);
                (demanded, Some(cut_off_state(section, &s.values, tolerance + margin, sun.span)))
            }
            Rule::Curve(points, rounding) => {
                let value = match rounding {
                    Rounding::Closed => curve_range(points, sun.span).map(|range| range[1]),
                    Rounding::Nearest => curve_value(points, sun.centre),
                };
                (value, value.and_then(|value| rounded(value, *rounding)))
            }
            Rule::RetroReflect(rounding) => {
                let value = retro_tilt(sun.centre);
                (Some(value), rounded(value, *rounding))
            }
            Rule::Redirect(elevation, rounding) => {
                let value = redirecting_tilt(sun.centre, *elevation);
                (Some(value), rounded(value, *rounding))
            }
            Rule::Din5034 => (None, Some(s.closed)),
            Rule::Fixed(state) | Rule::User(state, _) => (None, Some(*state)),
            Rule::Table(_) => (None, None),
        };
        (demanded, state.unwrap_or(s.closed))
    }

    /// The state after hysteresis and dwell time.
    fn weighed(&self, now: usize, wanted: &Wanted, time: f64, inputs: &Inputs) -> usize {
        let s = &self.settings;
        if wanted.state == now || matches!(wanted.reason, Reason::Fixed | Reason::Schedule) {
            return wanted.state;
        }
        let rested = time - self.moved_at >= s.dwell;
        let rounding = match s.rule {
            Rule::Curve(_, rounding) | Rule::RetroReflect(rounding) | Rule::Redirect(_, rounding) => rounding,
            _ => Rounding::Closed,
        };
        if rounding == Rounding::Nearest {
            let settled = wanted.demanded.is_none_or(|value| {
                (value - s.values[now]).abs() > (value - s.values[wanted.state]).abs() + s.hysteresis
            });
            return if rested && settled { wanted.state } else { now };
        }
        let closes = |state: usize| !self.more_open(state, now);
        if closes(wanted.state) {
            return wanted.state;
        }
        if !rested {
            return now;
        }
        if wanted.reason != Reason::Sun {
            return wanted.state;
        }
        let careful = self.wanted(inputs, s.hysteresis).state;
        if closes(careful) { now } else { careful }
    }

    /// Is one state more open than another, in the order by which the rule rounds?
    fn more_open(&self, a: usize, b: usize) -> bool {
        let (a, b) = (self.settings.values[a], self.settings.values[b]);
        match self.settings.rule {
            Rule::CutOff { .. } | Rule::Din5034 => a.abs() < b.abs() || (a.abs() == b.abs() && a > b),
            _ => a < b,
        }
    }
}

/// Index of the most open state that lets no direct light of the span through, even when it is missed by the tolerance.
/// Where none does, the one that lets least through, and of equal ones the most closed.
///
/// # Panics
/// Without states.
pub fn cut_off_state(section: &SlatRow, values: &[f64], tolerance: f64, span: [f64; 2]) -> usize {
    let order = by_openness(values);
    let keeps_out = order.iter().copied().find(|&state| section.blocks(values[state], tolerance, span));
    keeps_out.unwrap_or_else(|| {
        const POINTS: usize = 8;
        let share = |state: usize| {
            (0..=POINTS)
                .map(|k| span[0] + (span[1] - span[0]) * k as f64 / POINTS as f64)
                .map(|psi| section.direct_share(values[state], psi))
                .fold(0.0, f64::max)
        };
        let least = order.iter().rev().copied().min_by(|&a, &b| share(a).total_cmp(&share(b)));
        least.expect("a device has at least one state")
    })
}

#[cfg(test)]
#[path = "controller/tests.rs"]
mod tests;
