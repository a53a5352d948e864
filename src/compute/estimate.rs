//! Values that carry their numerical error, and the little that long work needs to report progress and stop.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Mul};

/// A computed value with an estimate of its numerical error, both in the unit of the quantity.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Estimated absolute error, never negative.
    pub error: f64,
}

impl Estimate {
    /// A value that is exact to rounding.
    pub const fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// A value with its error.
    pub const fn new(value: f64, error: f64) -> Self {
        Self { value, error }
    }
}

impl Add for Estimate {
    type Output = Self;
    /// Errors add: nothing is known of their independence.
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

/// A place darker than this share of the mean is in the dark: relative errors there tell nothing.
pub const DARK: f64 = 0.01;

/// How exact a set of values is as a whole: the largest of their errors, each relative to its own value, of all that
/// are not in the [`DARK`]; 0 where all of them are. Window and command line state this one number of a room.
pub fn largest_relative_error(values: impl Iterator<Item = Estimate> + Clone) -> f64 {
    let (sum, count) = values.clone().fold((0.0, 0_usize), |(sum, count), one| (sum + one.value, count + 1));
    let mean = sum / count.max(1) as f64;
    values.filter(|one| one.value > DARK * mean && one.value > 0.0).map(|one| one.error / one.value).fold(0.0, f64::max)
}

/// What long computations tell their caller, and ask of it. Implemented by the window's jobs and the command line.
pub trait Progress: Sync {
    /// `done` of `total` units of the named stage are finished.
    fn advance(&self, _stage: &'static str, _done: usize, _total: usize) {}
    /// True once the result is no longer wanted; the computation then returns [`Cancelled`] soon.
    fn cancelled(&self) -> bool {
        false
    }
}

/// No reports, never cancelled.
pub struct Silent;
impl Progress for Silent {}

/// The caller withdrew the question.
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
