//! Input of the control tile, and evaluation of the control curve.

use crate::app::paint::tile::Status;

/// One state (e.g. slat tilt) of a product with adjustable states, as a horizontal line of the control diagram.
#[derive(Debug, Clone, PartialEq)]
pub struct StatePoint {
    /// Key of the state in the product.
    pub key: String,
    /// Value of the adjusted quantity in this state, e.g. a slat angle in degrees.
    pub value: f64,
}

/// Position of the sun and chosen state at one time of the scene's day.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TracePoint {
    /// Time of day. \[h\]
    pub hour: f64,
    /// Profile angle of the sun relative to the façade \[°\]; `None` if the sun is not in front of the façade.
    pub profile_angle: Option<f64>,
    /// Index in [`Input::states`] of the state that the control rule chooses at this time.
    pub state: usize,
}

/// Input of the control tile in one frame.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// States of the product in the order of rising value; with fewer than two there is nothing to control.
    pub states: &'a [StatePoint],
    /// Reason why there is nothing to control, shown if there are fewer than two states.
    pub still: &'a str,
    /// Quantity that the states adjust, with its unit, e.g. "slat angle / °".
    pub quantity: &'a str,
    /// Points of the control curve in the order of rising profile angle: profile angle of the sun \[°\], and value in
    /// the unit of the states.
    pub curve: &'a [[f64; 2]],
    /// Whether the user may edit the points of the control curve.
    pub editable: bool,
    /// Names of product and control mode as text.
    pub name: &'a str,
    /// Position of the sun and chosen state for every half hour of the scene's day; empty if unknown.
    pub today: &'a [TracePoint],
    /// Profile angle of the sun at the scene's date and time \[°\]; `None` if the sun is not in front of the façade.
    pub profile_angle: Option<f64>,
    /// Index in `states` of the current state.
    pub current: usize,
    /// Index in `states` of the state at every hour of the year (365 × 24, day by day), `None` at night; empty before
    /// it has been computed.
    pub year: &'a [Option<u16>],
    /// Remark on the states over the year, or the reason why they were not computed; empty without either.
    pub remark: &'a str,
    /// Date and time of the scene, which are marked on the map: day of the year, counted from 0, and time of day \[h\].
    pub moment: Option<(usize, f64)>,
    /// Revision number, which changes whenever `states`, `curve`, `today` or `year` do.
    pub revision: u64,
    /// Status of the results shown: preliminary, outdated or complete.
    pub status: Status<'a>,
}

/// Returns the range of the value axis: lowest and highest value of states and control curve, with a margin, in the
/// unit of the states.
pub fn extent(input: &Input<'_>) -> (f64, f64) {
    let values = input.states.iter().map(|s| s.value).chain(input.curve.iter().map(|p| p[1]));
    let (lo, hi) =
        values.filter(|v| v.is_finite()).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let margin = 0.08 * (hi - lo).max(1.0);
    (lo - margin, hi + margin)
}

/// Returns the value of a control curve at a profile angle `psi` \[°\]: linear between its points, constant beyond its
/// ends; `None` for a curve without points.
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
