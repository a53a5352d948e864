//! Illuminances of a year, step by step.

use std::ops::Range;

/// Step of a year, with the data that the figures need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Month, 1 … 12.
    pub month: u8,
    /// Whether the room is occupied in the middle of the step.
    pub occupied: bool,
    /// Illuminance by the open sky on the horizontal plane. \[lx\]
    pub diffuse_horizontal: f64,
}

/// Illuminances at the same places in every step: one row per step, one column per place. \[lx\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light<'a> {
    /// Number of values per step in `values`, those of the places from `first` on.
    width: usize,
    first: usize,
    places: usize,
    values: &'a [f64],
}

impl<'a> Light<'a> {
    /// Creates the view of rows of `places` values. `None` if the last row is incomplete or there are no places.
    pub fn new(places: usize, values: &'a [f64]) -> Option<Self> {
        Self::of_columns(places, 0..places, values)
    }

    /// Creates the view of the columns `places` of rows of `width` values. `None` if the last row is incomplete or the
    /// columns are none or beyond the rows.
    pub fn of_columns(width: usize, places: Range<usize>, values: &'a [f64]) -> Option<Self> {
        let whole = !places.is_empty() && places.end <= width && values.len().is_multiple_of(width);
        whole.then_some(Self { width, first: places.start, places: places.len(), values })
    }

    /// Returns the number of places.
    pub const fn places(&self) -> usize {
        self.places
    }

    /// Returns the illuminances of a step, one per place.
    pub fn row(&self, step: usize) -> &'a [f64] {
        &self.values[step * self.width + self.first..][..self.places]
    }

    /// Returns the illuminance of one place in one step.
    pub fn at(&self, step: usize, place: usize) -> f64 {
        self.row(step)[place]
    }
}

/// Returns the indices of the occupied steps.
pub(super) fn occupied(steps: &[Step]) -> Vec<usize> {
    (0..steps.len()).filter(|&k| steps[k].occupied).collect()
}

/// Returns the share of a part in a whole; 0 if the whole is 0.
pub(super) fn share(part: usize, whole: usize) -> f64 {
    if whole == 0 { 0.0 } else { part as f64 / whole as f64 }
}
