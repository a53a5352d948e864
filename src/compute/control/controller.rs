//! A controller that follows a rule through time: thresholds, hysteresis, minimum dwell time, night.
//!
//! Closing against direct sun is never delayed: the controller closes at once, but waits before it opens. A rule that
//! rounds to the nearest state (redirection) waits before every movement.

use super::curve::{curve_range, curve_value, redirecting_tilt, retro_tilt};
use super::cut_off::SlatRow;
use super::states::{by_openness, most_closed, most_open, nearest, towards_closed};

/// Method by which the value that a control rule demands (e.g. a tilt) is rounded to one of the device's states.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rounding {
    /// Rounding to the least closed state whose value is at least the demanded one.
    Closed,
    /// Rounding to the state with the value nearest to the demanded one.
    Nearest,
}

/// Daily period of a schedule during which the device stays in one state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Period {
    /// Local hour of the day at which the period begins. \[h\]
    pub from: f64,
    /// Local hour of the day at which the period ends. \[h\] A value before `from` means a period over midnight.
    pub to: f64,
    /// Index of the state of the device during the period.
    pub state: usize,
}

/// Control rule: the state demanded while the sun is on the façade, or at all times.
#[derive(Debug, Clone, PartialEq)]
pub enum Rule {
    /// Cut-off control: the most open state that lets no direct light through.
    CutOff {
        /// Vertical section of the row of slats.
        section: SlatRow,
        /// Deviation of the tilt from its set value within which the slats must still block direct light. \[rad\]
        tolerance: f64,
    },
    /// Closed state while the sun shines on the façade (DIN 5034).
    Din5034,
    /// Control curve: points (profile angle \[rad\], value in the unit of the states), profile angles rising, linear
    /// between them, and the rounding to a state.
    Curve(Vec<(f64, f64)>, Rounding),
    /// Tilt at which mirror slats reflect direct sunlight back towards the sun, and its rounding to a state.
    RetroReflect(Rounding),
    /// Tilt at which mirror slats redirect direct sunlight into the room at a given elevation above the horizontal
    /// \[rad\], and its rounding to a state.
    Redirect(f64, Rounding),
    /// Fixed state, by its index, at all times.
    Fixed(usize),
    /// Schedule of daily periods. The first field is the index of the state outside all periods.
    User(usize, Vec<Period>),
    /// Table of (seconds since the beginning of the year, index of the state), times rising. Each row applies until the
    /// next begins, the last until the end of the year.
    Table(Vec<(f64, usize)>),
}

/// Settings of a shading controller: states of the device, rule, thresholds, hysteresis and dwell time.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Value of each state of the device: tilts in radians, others in the unit of the product.
    pub values: Vec<f64>,
    /// Control rule that the controller follows.
    pub rule: Rule,
    /// Index of the state that [`Rule::Din5034`] and the limit `close_above` close to.
    pub closed: usize,
    /// Index of the state by day without direct sun.
    pub open: usize,
    /// Index of the state while the sun is below the horizon.
    pub night: usize,
    /// Illuminance of the façade by direct sun above which the rule for direct sun applies. \[lx\]
    pub threshold: f64,
    /// Illuminance of the façade by sun, sky and ground above which the device closes, whatever the rule; `None`: no
    /// such limit. \[lx\]
    pub close_above: Option<f64>,
    /// Indoor illuminance below which [`Rule::Din5034`] and `close_above` do not close the device; `None`: no such
    /// limit. \[lx\]
    pub open_below: Option<f64>,
    /// Ratio, 0 … 1, of the illuminance at which a threshold is released again to that at which it takes effect; for
    /// `open_below` its inverse.
    pub release: f64,
    /// Hysteresis: difference by which the demanded value must be more open than the current state before the device
    /// opens, in the unit of `values`.
    pub hysteresis: f64,
    /// Dwell time: minimum time between a change of state and the next opening. \[s\]
    pub dwell: f64,
}

impl Settings {
    /// Creates settings from the values of the states and a rule, without thresholds, hysteresis and dwell time. `None`
    /// without states.
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
    /// Returns the control curve for diagrams: points (profile angle \[rad\], demanded value in the unit of the states)
    /// from 0 to 90° in steps of 1°, for a point-like sun, limited to the range of the states' values. A curve that is
    /// given as a table is returned unchanged; the list is empty for rules without a curve.
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

    /// Returns the minimum and maximum value of the states.
    fn range(&self) -> [f64; 2] {
        self.values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(*v), b.max(*v)])
    }
}

/// Inputs of the controller at one time step: clock, position of the sun, and illuminances of its sensors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inputs {
    /// Local hour of the day, 0 … 24. \[h\]
    pub hour: f64,
    /// Time since the beginning of the year, in local standard time and a calendar of 366 days; `None` without a date.
    /// \[s\]
    pub of_year: Option<f64>,
    /// Whether any part of the sun is above the horizon.
    pub day: bool,
    /// Profile angles of the sun's centre and of its visible disc; `None` while no part of it is in front of the
    /// façade. \[rad\]
    pub sun: Option<SunAt>,
    /// Illuminance on the façade by direct sun. \[lx\]
    pub facade_direct: f64,
    /// Illuminance on the façade by sun, sky and ground together. \[lx\]
    pub facade_global: f64,
    /// Illuminance at the indoor sensor of the controller, if there is one. \[lx\]
    pub indoor: Option<f64>,
}

/// Profile angles of the sun in the section across the slats. \[rad\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SunAt {
    /// Profile angle of the sun's centre, limited to `span`. \[rad\]
    pub centre: f64,
    /// Minimum and maximum profile angle of the visible disc. \[rad\]
    pub span: [f64; 2],
}

/// Reason for the state that the controller demands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// Rule with one fixed state.
    Fixed,
    /// Rule that takes the state from a schedule or table.
    Schedule,
    /// Sun below the horizon.
    Night,
    /// Day without direct sun on the façade.
    NoSun,
    /// Direct sun on the façade: state by the control rule.
    Sun,
    /// Illuminance of the façade above [`Settings::close_above`].
    Bright,
    /// Indoor illuminance below [`Settings::open_below`].
    Dark,
}

impl Reason {
    /// Returns the key of the reason in CSV and JSON tables.
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

/// Result of one time step of the controller: state, demanded value and reason.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decision {
    /// Index of the state that the device takes.
    pub state: usize,
    /// Value that the rule demands before rounding to a state, in the unit of the states (tilts in radians); `None`
    /// where it demands none.
    pub demanded: Option<f64>,
    /// Reason for the state demanded, before hysteresis and dwell time.
    pub reason: Reason,
    /// Whether the state differs from that of the previous time step.
    pub moved: bool,
    /// Whether hysteresis or dwell time keeps the device from the demanded state.
    pub held: bool,
}

/// Controller of a shading device, stepped through time; it remembers the current state and the thresholds in effect.
#[derive(Debug, Clone)]
pub struct Controller {
    settings: Settings,
    state: Option<usize>,
    moved_at: f64,
    lit: bool,
    bright: bool,
    dark: bool,
}

/// State demanded at a step, before hysteresis and dwell time.
struct Wanted {
    state: usize,
    demanded: Option<f64>,
    reason: Reason,
}

impl Controller {
    /// Creates a controller without a current state: its first step takes the demanded state at once.
    pub const fn new(settings: Settings) -> Self {
        Self { settings, state: None, moved_at: f64::NEG_INFINITY, lit: false, bright: false, dark: false }
    }

    /// Returns the settings of the controller.
    pub const fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Computes the state of the device at `time` \[s\], which must not decrease from step to step.
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

    /// Updates the flags of thresholds in effect from the inputs, with the ratio at which they are released.
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

    /// Returns the state that settings and inputs demand; slats in direct sun are closed further by `margin`.
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

    /// Returns the value that the rule demands in direct sun and the index of its state; `margin`
    /// \[unit of the values\] closes it further.
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

    /// Returns the index of the state that hysteresis and dwell time allow, for the current state `now` and the
    /// demanded one `wanted`.
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

    /// Whether state `a` is more open than state `b` by the order of the rule: nearer to 0 for cut-off and DIN 5034, of
    /// smaller value for curves.
    fn more_open(&self, a: usize, b: usize) -> bool {
        let (a, b) = (self.settings.values[a], self.settings.values[b]);
        match self.settings.rule {
            Rule::CutOff { .. } | Rule::Din5034 => a.abs() < b.abs() || (a.abs() == b.abs() && a > b),
            _ => a < b,
        }
    }
}

/// Returns the index of the most open state that blocks direct light of all profile angles of `span`, even when the
/// tilt is off by `tolerance`. Where no state does, returns the one that lets least through, and of equal ones the most
/// closed.
///
/// # Panics
/// Panics if there are no states.
pub fn cut_off_state(section: &SlatRow, values: &[f64], tolerance: f64, span: [f64; 2]) -> usize {
    let order = by_openness(values);
    let keeps_out = order.iter().copied().find(|&state| section.blocks(values[state], tolerance, span));
    keeps_out.unwrap_or_else(|| {
        // Number of intervals across the disc's profile angles. Chosen: only ranks states of which none blocks the sun;
        // no effect where one does.
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
