//! Illuminances of an aperture's patches in the hours of a year.

use std::sync::OnceLock;

/// By hour, each found when it is first asked for. \[lx\]
pub(in crate::study) struct SkyYear(Vec<OnceLock<Box<[f64]>>>);

impl SkyYear {
    /// Nothing known of so many hours.
    pub fn nothing(hours: usize) -> Self {
        Self((0..hours).map(|_| OnceLock::new()).collect())
    }

    /// Of an hour.
    pub fn hour(&self, hour: usize, find: impl FnOnce() -> Vec<f64>) -> &[f64] {
        self.0[hour].get_or_init(|| find().into_boxed_slice())
    }
}
