//! The illuminances of a year, step by step.

use std::ops::Range;

/// One step of a year, as far as figures ask.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Month, 1 … 12.
    pub month: u8,
    /// Is somebody there? By the middle of the step.
    pub occupied: bool,
    /// Of the open sky on the horizontal plane. \[lx\]
    pub diffuse_horizontal: f64,
}

/// Illuminances at the same places in every step: rows of steps, columns of places. \[lx\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light<'a> {
    /// Numbers a step in `values`, those of the places from `first` on.
    width: usize,
    first: usize,
    places: usize,
    values: &'a [f64],
}

impl<'a> Light<'a> {
    /// Row after row. `None` where the rows are not whole, or of no places.
    pub fn new(places: usize, values: &'a [f64]) -> Option<Self> {
        Self::of_columns(places, 0..places, values)
    }

    /// Some columns of rows of so many. `None` as for [`Self::new`].
    pub fn of_columns(width: usize, places: Range<usize>, values: &'a [f64]) -> Option<Self> {
        let whole = !places.is_empty() && places.end <= width && values.len().is_multiple_of(width);
        whole.then_some(Self { width, first: places.start, places: places.len(), values })
    }

    /// Number of places.
    pub const fn places(&self) -> usize {
        self.places
    }

    /// The places of a step.
    pub fn row(&self, step: usize) -> &'a [f64] {
        &self.values[step * self.width + self.first..][..self.places]
    }

    /// One place in one step.
    pub fn at(&self, step: usize, place: usize) -> f64 {
        self.row(step)[place]
    }
}

/// Indices of the occupied steps.
pub(super) fn occupied(steps: &[Step]) -> Vec<usize> {
    (0..steps.len()).filter(|&k| steps[k].occupied).collect()
}

/// A part of a whole; 0 of nothing.
pub(super) fn share(part: usize, whole: usize) -> f64 {
    if whole == 0 { 0.0 } else { part as f64 / whole as f64 }
}
