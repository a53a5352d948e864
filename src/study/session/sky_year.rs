//! Stored light of the sky in the hours of a year: illuminances through the patches of an aperture \[lx\], or moments
//! of what sensors see by regular transmission.

use crate::compute::room::sunlit_part::SunlitPart;
use std::sync::OnceLock;

/// Sunlit part of an aperture in each hour of a year, computed at its first use.
pub(crate) type SunlitYear = Vec<OnceLock<SunlitPart>>;

/// Values of a sky in each hour of a year, computed at their first use; in single precision, 6 · 10⁻⁸ of each value.
pub(crate) struct SkyYear(Vec<OnceLock<Box<[f32]>>>);

impl SkyYear {
    /// Creates an empty store for `hours` hours.
    pub fn nothing(hours: usize) -> Self {
        Self((0..hours).map(|_| OnceLock::new()).collect())
    }

    /// Whether the values of an hour are stored.
    pub fn holds(&self, hour: usize) -> bool {
        self.0[hour].get().is_some()
    }

    /// Returns the values of an hour, computed by `find` or stored.
    pub fn hour(&self, hour: usize, find: impl FnOnce() -> Vec<f64>) -> impl Iterator<Item = f64> {
        let kept = self.0[hour].get_or_init(|| find().into_iter().map(|e| e as f32).collect());
        kept.iter().map(|&e| f64::from(e))
    }
}
