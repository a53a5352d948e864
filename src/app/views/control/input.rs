//! Input of the control tile, and the control curve as numbers.

use crate::app::paint::tile::Status;

/// State of a moving product.
#[derive(Debug, Clone, PartialEq)]
pub struct StatePoint {
    /// Key in the dataset.
    pub key: String,
    /// Value that the state sets, e.g. a slat angle in degrees.
    pub value: f64,
}

/// Sun and control at one time of today.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TracePoint {
    /// Hour of the day.
    pub hour: f64,
    /// Profile angle on the façade \[°\]; `None` while the sun is not in front of it.
    pub profile_angle: Option<f64>,
    /// Index of the state that the control chose.
    pub state: usize,
}

/// Input of the tile.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// The product's states, by rising value; with fewer than two nothing moves.
    pub states: &'a [StatePoint],
    /// Reason why nothing moves, shown with fewer than two states.
    pub still: &'a str,
    /// Quantity that a state sets, with unit, e.g. "slat angle / °".
    pub quantity: &'a str,
    /// Control curve: value [unit of the states] over profile angle \[°\], rising angle.
    pub curve: &'a [[f64; 2]],
    /// Whether the curve's points may be moved.
    pub editable: bool,
    /// Product and control mode as text.
    pub name: &'a str,
    /// Sun and control at the times of today.
    pub today: &'a [TracePoint],
    /// Profile angle of the sun now. \[°\]
    pub profile_angle: Option<f64>,
    /// Current state, index into `states`.
    pub current: usize,
    /// State of every hour of the year (365 × 24, day by day), `None` at night; empty while not computed.
    pub year: &'a [Option<u16>],
    /// Remark on the year, or the reason why there is none; empty without either.
    pub remark: &'a str,
    /// Day of the year now, from 0, and hour, for the mark on the map.
    pub moment: Option<(usize, f64)>,
    /// Number that changes with states, curve, trace and year.
    pub revision: u64,
    /// Status of the content: preliminary, outdated or complete.
    pub status: Status<'a>,
}

/// Returns the lowest and highest value of the states and the curve, with a margin.
pub fn extent(input: &Input<'_>) -> (f64, f64) {
    let values = input.states.iter().map(|s| s.value).chain(input.curve.iter().map(|p| p[1]));
    let (lo, hi) =
        values.filter(|v| v.is_finite()).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let margin = 0.08 * (hi - lo).max(1.0);
    (lo - margin, hi + margin)
}

/// Returns the value of the curve at a profile angle \[°\]: piecewise linear, constant beyond its ends.
pub fn curve_at(curve: &[[f64; 2]], psi: f64) -> Option<f64> {
    let (first, last) = (curve.first()?, curve.last()?);
    if psi <= first[0] {
        return Some(first[1]);
    }
    let next = curve.iter().position(|p| p[0] >= psi);
    Some(next.map_or(last[1], |k| {
        let (a, b) = (curve[k - 1], curve[k]);
        if b[0] > a[0] { a[1] + (b[1] - a[1]) * (psi - a[0]) / (b[0] - a[0]) } else { b[1] }
    }))
}
