//! Stored light of the sky in the hours of a year: illuminances through the patches of an aperture \[lx\], or moments
//! of what sensors see by regular transmission.

use crate::compute::room::sunlit_part::SunlitPart;
use faer::Mat;
use std::sync::OnceLock;

/// Maximum number of values of a year that are stored: 12,000 in each of 8,784 hours. Half of these are dark, so that
/// they take 210 MB.
pub(super) const MOST_NUMBERS: usize = 12_000 * 8784;
/// Memory of the sunlit part of an aperture in an hour with sun: its outline, and its shares of 169 points and 9 nodes.
/// \[bytes\]
const SUNLIT: usize = 3000;

/// Sunlit part of an aperture in each hour of a year, computed at its first use.
pub(crate) type SunlitYear = Vec<OnceLock<SunlitPart>>;

/// Returns the memory of the sunlit parts of a year when all hours are computed, half of which are dark. \[bytes\]
pub(super) fn of_sunlit(hours: &SunlitYear) -> usize {
    size_of_val(&hours[..]) + hours.len() / 2 * SUNLIT
}

/// Values of a sky in each hour of a year, computed at their first use; in single precision, 6 · 10⁻⁸ of each value.
pub(crate) struct SkyYear {
    hours: Vec<OnceLock<Box<[f32]>>>,
    numbers: usize,
}

impl SkyYear {
    /// Creates an empty store for `hours` hours with `numbers` values each.
    pub fn nothing(hours: usize, numbers: usize) -> Self {
        Self { hours: (0..hours).map(|_| OnceLock::new()).collect(), numbers }
    }

    /// Returns the memory that the values take when all hours are computed, half of which are dark. \[bytes\]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.hours[..]) + self.hours.len() / 2 * self.numbers * size_of::<f32>()
    }

    /// Whether the values of an hour are stored.
    pub fn holds(&self, hour: usize) -> bool {
        self.hours[hour].get().is_some()
    }

    /// Returns the values of an hour, computed by `find` or stored.
    pub fn hour(&self, hour: usize, find: impl FnOnce() -> Vec<f64>) -> impl Iterator<Item = f64> {
        self.single(hour, || find().into_iter().map(|e| e as f32).collect()).iter().map(|&e| f64::from(e))
    }

    fn single(&self, hour: usize, find: impl FnOnce() -> Vec<f32>) -> &[f32] {
        self.hours[hour].get_or_init(|| find().into_boxed_slice())
    }
}

/// Returns the values of several moments, a column of `rows` values for each, from the store where they are hours of
/// its year (`hours`: index of each). The others are computed together: `find` gets their places in the list.
/// `columns`: number of columns; those without a moment are 0.
pub(crate) fn of_moments(
    year: Option<&SkyYear>,
    hours: &[Option<usize>],
    [rows, columns]: [usize; 2],
    find: impl FnOnce(&[usize]) -> Vec<Vec<f32>>,
) -> Mat<f32> {
    let kept = |moment: usize| year.zip(hours[moment]);
    let stored = |moment: usize| kept(moment).is_some_and(|(year, hour)| year.holds(hour));
    let missing: Vec<usize> = (0..hours.len()).filter(|moment| !stored(*moment)).collect();
    let mut found = find(&missing).into_iter();
    let mut missing = missing.into_iter().peekable();
    let mut values = Mat::zeros(rows, columns);
    for moment in 0..hours.len() {
        let own = missing.next_if_eq(&moment).and_then(|_| found.next()).unwrap_or_default();
        let to = values.col_as_slice_mut(moment);
        match kept(moment) {
            Some((year, hour)) => to.copy_from_slice(year.single(hour, || own)),
            None => to.copy_from_slice(&own),
        }
    }
    values
}
