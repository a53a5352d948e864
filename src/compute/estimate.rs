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
