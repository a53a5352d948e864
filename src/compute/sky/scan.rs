//! Measured skies: luminances of Tregenza's 145 patches of the sky dome, each constant over its patch.

use super::patches::{ROW_HEIGHT, ROWS};
use crate::compute::angle::wrap_two_pi;
use glam::DVec3;
use std::f64::consts::PI;

/// Measured sky: luminances of Tregenza's 145 patches of the sky dome, lowest row first, each row clockwise from north.
/// \[cd/m²\]
#[derive(Debug, Clone, PartialEq)]
pub struct Scan {
    values: [f64; 145],
}

impl Scan {
    /// Creates the sky from exactly 145 luminances \[cd/m²\]; `None` if their number differs, or if one is negative or
    /// not finite.
    pub fn new(values: &[f64]) -> Option<Self> {
        let values: [f64; 145] = values.try_into().ok()?;
        values.iter().all(|value| value.is_finite() && *value >= 0.0).then_some(Self { values })
    }

    /// Returns the luminances of the 145 patches, lowest row first, each row clockwise from north. \[cd/m²\]
    pub const fn values(&self) -> &[f64; 145] {
        &self.values
    }

    /// Returns the index of the patch that contains a direction above the horizon (world's axes, any length).
    pub fn index(v: DVec3) -> usize {
        let altitude = v.z.atan2(v.truncate().length()).max(0.0);
        let row = ((altitude / ROW_HEIGHT) as usize).min(ROWS.len() - 1);
        let first: usize = ROWS[..row].iter().sum();
        let count = ROWS[row];
        let turned = wrap_two_pi(v.x.atan2(v.y)) * count as f64 / (2.0 * PI) + 0.5;
        first + turned as usize % count
    }

    #[inline]
    pub(super) fn value(&self, v: DVec3) -> f64 {
        self.values[Self::index(v)]
    }
}
