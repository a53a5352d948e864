//! Values with their numerical error, and the interface by which long computations report progress and stop.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Mul};

/// Computed value with an estimate of its numerical error, both in the unit of the quantity.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Estimate {
    /// Computed value.
    pub value: f64,
    /// Estimated absolute error, never negative.
    pub error: f64,
}

impl Estimate {
    /// Creates a value that is exact to rounding.
    pub const fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// Creates a value with its error.
    pub const fn new(value: f64, error: f64) -> Self {
        Self { value, error }
    }
}

impl Add for Estimate {
    type Output = Self;
    /// Adds values and errors: nothing is known of the errors' independence.
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, error: self.error + other.error }
    }
}

impl AddAssign for Estimate {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul<f64> for Estimate {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self { value: self.value * factor, error: self.error * factor.abs() }
    }
}

impl Sum for Estimate {
    fn sum<I: Iterator<Item = Self>>(iter: I) -> Self {
        iter.fold(Self::default(), Add::add)
    }
}

/// Share of the mean below which a place counts as dark: relative errors there have no meaning. Chosen: affects
/// reporting only.
pub const DARK: f64 = 0.01;

/// Returns the largest relative error of a set of values, each relative to its own value, without those that are dark
/// (see [`DARK`]); 0 where all of them are. Window and command line state this one number of a room.
pub fn largest_relative_error(values: impl Iterator<Item = Estimate> + Clone) -> f64 {
    let (sum, count) = values.clone().fold((0.0, 0_usize), |(sum, count), one| (sum + one.value, count + 1));
    let mean = sum / count.max(1) as f64;
    values.filter(|one| one.value > DARK * mean && one.value > 0.0).map(|one| one.error / one.value).fold(0.0, f64::max)
}

/// Interface by which long computations report progress and learn of cancellation. Implemented by the window's jobs and
/// the command line.
pub trait Progress: Sync {
    /// Reports that `done` of `total` units of the named stage are finished.
    fn advance(&self, _stage: &'static str, _done: usize, _total: usize) {}
    /// Whether the result is no longer needed; the computation then returns [`Cancelled`] soon.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Progress that reports nothing and never cancels.
pub struct Silent;
impl Progress for Silent {}

/// Error of a computation that its caller cancelled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_error_is_relative_to_its_own_value_and_not_of_the_dark() {
        // The bright one has the larger error in lux, the dim one the larger in percent; the dark one does not count.
        let values = [(1000.0, 5.0), (100.0, 2.0), (1.0, 1.0)].map(|(value, error)| Estimate::new(value, error));
        assert!((largest_relative_error(values.iter().copied()) - 0.02).abs() < 1e-12);
        assert_eq!(largest_relative_error([Estimate::new(0.0, 1.0)].into_iter()), 0.0);
        assert_eq!(largest_relative_error(std::iter::empty()), 0.0);
    }
}
