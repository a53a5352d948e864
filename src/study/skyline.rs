//! Skyline of a scene whose altitude varies with the bearing, from the key `sky.skyline`.

use super::scene_file::SkylineKeys;
use crate::compute::limits;
use crate::compute::sky::Outside;
use crate::compute::surroundings::Surroundings;
use crate::compute::surroundings::skyline::Skyline;
use std::sync::Arc;

/// Full name of a wrong key, and a message on the error with what is expected.
pub type Wrong = (&'static str, String);

/// Checks the key `sky.skyline`, and creates the skyline.
pub fn skyline(keys: &SkylineKeys) -> Result<Skyline, Wrong> {
    let wrong = |key, message: String| Err((key, message));
    if !(0.0..=limits::LUMINANCE).contains(&keys.luminance) {
        let message = format!("{:e} cd/m² is out of range (allowed: 0 to {:e})", keys.luminance, limits::LUMINANCE);
        return wrong("sky.skyline.luminance", message);
    }
    for [bearing, altitude] in &keys.altitudes {
        if !(-360.0..=360.0).contains(bearing) {
            let message = format!("a compass bearing of {bearing}° (allowed: -360 to 360°)");
            return wrong("sky.skyline.altitudes", message);
        }
        if !(0.0..=89.999).contains(altitude) {
            let message = format!("{altitude}° at the bearing {bearing}° (allowed: 0 to 89.999°)");
            return wrong("sky.skyline.altitudes", message);
        }
    }
    let mut bearings: Vec<f64> = keys.altitudes.iter().map(|[bearing, _]| bearing.rem_euclid(360.0)).collect();
    bearings.sort_by(f64::total_cmp);
    if let Some(pair) = bearings.windows(2).find(|pair| pair[0] == pair[1]) {
        let message = format!("two altitudes at the bearing {}°: give one", pair[0]);
        return wrong("sky.skyline.altitudes", message);
    }
    let knots = keys.altitudes.iter().map(|knot| knot.map(f64::to_radians));
    match Skyline::new(knots, keys.luminance) {
        Some(skyline) => Ok(skyline),
        None => {
            let message = "empty: give at least one pair of compass bearing and altitude, e.g. [[0.0, 10.0]]";
            wrong("sky.skyline.altitudes", message.to_owned())
        }
    }
}

/// Returns an outside with a skyline added, and without boxes.
pub fn behind_skyline(outside: Outside, skyline: Skyline) -> Outside {
    outside.behind(Arc::new(Surroundings::dark(Vec::new(), Some(skyline))))
}
