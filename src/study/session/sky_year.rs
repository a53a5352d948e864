//! What a sky is in the hours of a year: illuminances of an aperture's patches \[lx\], moments of what sensors see.

use crate::compute::room::sunlit_part::SunlitPart;
use std::sync::OnceLock;

/// Sunlit part of an aperture by hour, each found when it is first asked for.
pub(crate) type SunlitYear = Vec<OnceLock<SunlitPart>>;

/// By hour, each found when it is first asked for; in half the digits, 6 · 10⁻⁸ of each.
pub(crate) struct SkyYear(Vec<OnceLock<Box<[f32]>>>);

impl SkyYear {
    /// Nothing known of so many hours.
    pub fn nothing(hours: usize) -> Self {
        Self((0..hours).map(|_| OnceLock::new()).collect())
    }

    /// Is an hour known?
    pub fn holds(&self, hour: usize) -> bool {
        self.0[hour].get().is_some()
    }

    /// Of an hour.
    pub fn hour(&self, hour: usize, find: impl FnOnce() -> Vec<f64>) -> impl Iterator<Item = f64> {
        let kept = self.0[hour].get_or_init(|| find().into_iter().map(|e| e as f32).collect());
        kept.iter().map(|&e| f64::from(e))
    }
}
