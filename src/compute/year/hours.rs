//! Illuminances of a year, step by step.

use std::ops::Range;

/// Time step of a year: month, occupancy and sky illuminance, which the annual figures need besides the room's
/// illuminances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Month, 1 … 12.
    pub month: u8,
    /// Whether the room is occupied in the middle of the step.
    pub occupied: bool,
    /// Diffuse horizontal illuminance outside: by the unobstructed sky, without the sun. \[lx\]
    pub diffuse_horizontal: f64,
}

/// Illuminances of a year at calculation points or observers' eyes ("places"): one row per step, one column per place.
/// \[lx\]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light<'a> {
    /// Number of values per row of `values`; the places are the `places` columns from `first` on.
    width: usize,
    first: usize,
    places: usize,
    values: &'a [f64],
}

impl<'a> Light<'a> {
    /// Creates the table from `values` \[lx\] in rows of `places` values, one row per step. `None` if the last row is
    /// incomplete or there are no places.
    pub fn new(places: usize, values: &'a [f64]) -> Option<Self> {
        Self::of_columns(places, 0..places, values)
    }

    /// Creates the table from the columns `places` of `values` \[lx\] in rows of `width` values, one row per step.
    /// `None` if the last row is incomplete, or if the columns are empty or reach beyond a row.
    pub fn of_columns(width: usize, places: Range<usize>, values: &'a [f64]) -> Option<Self> {
        let whole = !places.is_empty() && places.end <= width && values.len().is_multiple_of(width);
        whole.then_some(Self { width, first: places.start, places: places.len(), values })
    }

    /// Returns the number of places (calculation points or eyes) of the table.
    pub const fn places(&self) -> usize {
        self.places
    }

    /// Returns the illuminances of one step, one per place. \[lx\]
    pub fn row(&self, step: usize) -> &'a [f64] {
        &self.values[step * self.width + self.first..][..self.places]
    }

    /// Returns the illuminance of one place in one step. \[lx\]
    pub fn at(&self, step: usize, place: usize) -> f64 {
        self.row(step)[place]
    }
}

/// Returns the indices of the occupied steps.
pub(super) fn occupied(steps: &[Step]) -> Vec<usize> {
    (0..steps.len()).filter(|&k| steps[k].occupied).collect()
}

/// Returns the ratio of two counts, `part` over `whole`; 0 if `whole` is 0.
pub(super) fn share(part: usize, whole: usize) -> f64 {
    if whole == 0 { 0.0 } else { part as f64 / whole as f64 }
}
