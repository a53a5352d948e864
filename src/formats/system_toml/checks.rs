//! Checks of the values in system files; an error names the key and the allowed range.

use super::keys::Pair;
use crate::compute::limits;
use crate::formats::location::{FormatError, Location};

/// Maximum number of points of an outline in a system file.
const MOST_POINTS: usize = limits::OUTLINE_POINTS;

/// Returns the error that the value of a key is not as expected.
pub(super) fn wrong<T>(key: &str, found: impl Into<String>, expected: impl Into<String>) -> Result<T, FormatError> {
    Err(FormatError::new(Location::file().in_element(key), found, expected))
}

/// Returns the value of a key if it lies between two limits; the error states value and limits.
pub(super) fn within(key: &str, value: f64, (low, high): (f64, f64)) -> Result<f64, FormatError> {
    if (low..=high).contains(&value) { Ok(value) } else { wrong(key, format!("{value}"), format!("{low} to {high}")) }
}

/// Returns the value of a key if it is a length above 0 m and at most 1 km.
pub(super) fn length(key: &str, value: f64) -> Result<f64, FormatError> {
    if value > 0.0 && value <= 1000.0 {
        Ok(value)
    } else {
        wrong(key, format!("{value}"), "metres, above 0, at most 1000")
    }
}

/// Returns the value of a key if it is a length of 0 m or more.
pub(super) fn extent(key: &str, value: f64) -> Result<f64, FormatError> {
    if value == 0.0 { Ok(0.0) } else { length(key, value) }
}

/// Returns the value of a key if it is a share, 0 … 1.
pub(super) fn share(key: &str, value: f64) -> Result<f64, FormatError> {
    within(key, value, (0.0, 1.0))
}

/// Returns the value of a key if it is a refractive index in the allowed range.
pub(super) fn index(key: &str, value: f64) -> Result<f64, FormatError> {
    within(key, value, (1.0, 4.0))
}

/// Returns the value of a key if it is an absorption coefficient in the allowed range \[1/m\].
pub(super) fn absorption(key: &str, value: f64) -> Result<f64, FormatError> {
    within(key, value, (0.0, 1e6))
}

/// Returns the points of an outline \[m\] after a check of their coordinates and their number (at least `fewest`).
pub(super) fn outline(key: &str, points: &[Pair], fewest: usize) -> Result<Vec<[f64; 2]>, FormatError> {
    let points: Vec<[f64; 2]> = points.iter().map(|point| point.0).collect();
    if points.len() < fewest || points.len() > MOST_POINTS {
        return wrong(key, format!("{} points", points.len()), format!("{fewest} to {MOST_POINTS}"));
    }
    match points.iter().find(|point| !point.iter().all(|c| c.abs() <= 1000.0)) {
        Some(point) => wrong(key, format!("the point {point:?}"), "metres"),
        None => Ok(points),
    }
}
