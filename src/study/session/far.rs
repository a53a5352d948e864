//! Distant surroundings, a skyline of uniform altitude or one that varies with the bearing: its light is a constant,
//! and it hides the same directions from every point.

use crate::compute::sky::{Distribution, Outside};
use crate::compute::surroundings::Surroundings;
use crate::compute::surroundings::skyline::Skyline;
use std::f64::consts::PI;
use std::sync::Arc;

/// Outsides of luminance 1 by which light of ground and skyline is computed once for all skies.
pub(crate) struct Constants {
    /// Outside with a ground of luminance 1; sky and skyline are black.
    pub ground: Option<Outside>,
    /// Outside with a skyline of luminance 1; sky and ground are black. `None` without a skyline.
    pub skyline: Option<Outside>,
    /// Outside with a sky of luminance 1; all else is black. `None` without a skyline that varies with the bearing.
    pub even: Option<Outside>,
}

impl Constants {
    /// Creates these outsides with the skyline of `outside`.
    pub fn of(outside: &Outside) -> Self {
        let sky = |luminance: f64| Outside::new(Distribution::uniform(), PI * luminance).ok();
        let before = |luminance| with_luminance(outside, luminance);
        let hidden = |all: Outside| match before(0.0) {
            Some(before) => Some(all.behind(before)),
            None => Some(all),
        };
        let altitude = outside.skyline_altitude();
        Self {
            ground: sky(0.0).and_then(|all| all.with_ground(1.0, PI).ok()).and_then(hidden),
            skyline: match before(1.0) {
                Some(before) => sky(0.0).map(|all| all.behind(before)),
                None => sky(0.0).filter(|_| altitude > 0.0).and_then(|all| all.with_skyline(altitude, 1.0).ok()),
            },
            even: sky(1.0).filter(|_| before(0.0).is_some()).and_then(hidden),
        }
    }
}

/// Returns an outside without any light, with the skyline of `outside`.
pub(crate) fn dark(outside: &Outside) -> Option<Outside> {
    let black = Outside::new(Distribution::uniform(), 0.0).ok()?;
    match with_luminance(outside, 0.0) {
        Some(skyline) => Some(black.behind(skyline)),
        None => black.with_skyline(outside.skyline_altitude(), 0.0).ok(),
    }
}

/// Returns the skyline of an outside that varies with the bearing; `None` if there is none.
pub(crate) fn shape(outside: &Outside) -> Option<&Skyline> {
    outside.surroundings()?.skyline.as_ref()
}

fn with_luminance(outside: &Outside, luminance: f64) -> Option<Arc<Surroundings>> {
    let all = outside.surroundings()?;
    let skyline = all.skyline.clone()?.with_luminance(luminance);
    Some(Arc::new(Surroundings { skyline: Some(skyline), ..all.clone() }))
}

/// Returns the luminance of the skyline of an outside, uniform or not. \[cd/m²\]
pub(crate) fn luminance(outside: &Outside) -> f64 {
    shape(outside).map_or(outside.skyline_luminance(), |skyline| skyline.luminance)
}

/// Whether the skylines of two outsides hide the same part of the sky.
pub(crate) fn same(one: &Outside, other: &Outside) -> bool {
    one.skyline_altitude() == other.skyline_altitude()
        && match (shape(one), shape(other)) {
            (None, None) => true,
            (Some(a), Some(b)) => a.same_shape(b),
            _ => false,
        }
}
