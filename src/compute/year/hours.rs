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

/// Values of the steps of a year: one row per step, one column per place. Rows of zeros, about half of a year, take no
/// memory. Values are kept in single precision, which rounds them by 6e-8: thousands of times less than the errors of
/// hourly illuminances.
#[derive(Debug, Clone)]
pub struct StepTable {
    width: usize,
    /// Index of the row of `values` for each step.
    rows: Vec<u32>,
    /// Rows one after the other; the first one consists of zeros.
    values: Vec<f32>,
}

impl StepTable {
    /// Creates a table of zeros for a number of steps and places. `filled`: expected number of rows with other values.
    pub fn zeros(steps: usize, places: usize, filled: usize) -> Self {
        let mut values = Vec::with_capacity((filled + 1) * places);
        values.resize(places, 0.0);
        Self { width: places, rows: vec![0; steps], values }
    }

    /// Creates a table of rows of `places` values, one after the other. `None` if the last row is incomplete or there are
    /// no places.
    pub fn of_rows(places: usize, values: &[f64]) -> Option<Self> {
        if places == 0 || !values.len().is_multiple_of(places) {
            return None;
        }
        let steps = values.len() / places;
        let mut table = Self::zeros(steps, places, steps);
        values.chunks_exact(places).enumerate().for_each(|(step, row)| table.set(step, row));
        Some(table)
    }

    /// Returns the number of steps.
    pub fn steps(&self) -> usize {
        self.rows.len()
    }

    /// Sets the values of a step, one per place.
    pub fn set<T: Copy + Into<f64>>(&mut self, step: usize, row: &[T]) {
        assert_eq!(row.len(), self.width, "a row has a value for each place");
        match self.rows[step] as usize {
            0 if row.iter().all(|value| (*value).into() == 0.0) => {}
            0 => {
                self.rows[step] = (self.values.len() / self.width) as u32;
                self.values.extend(row.iter().map(|value| (*value).into() as f32));
            }
            known => {
                let own = &mut self.values[known * self.width..][..self.width];
                own.iter_mut().zip(row).for_each(|(own, value)| *own = (*value).into() as f32);
            }
        }
    }

    /// Returns the values of a step, one per place.
    pub fn row(&self, step: usize) -> &[f32] {
        &self.values[self.rows[step] as usize * self.width..][..self.width]
    }

    /// Returns all values, step by step.
    pub fn values(&self) -> impl Iterator<Item = f64> {
        (0..self.steps()).flat_map(|step| self.row(step)).map(|value| f64::from(*value))
    }

    /// Returns the table of `of(a, b)` for the values a of this table and b of `other`, which has as many steps and
    /// places. `of(0, 0)` must be 0.
    pub fn with(&self, other: &Self, of: impl Fn(f64, f64) -> f64) -> Self {
        debug_assert!(of(0.0, 0.0) == 0.0 && (self.steps(), self.width) == (other.steps(), other.width));
        let filled = self.values.len().max(other.values.len()) / self.width.max(1);
        let mut table = Self::zeros(self.steps(), self.width, filled);
        let mut row = Vec::with_capacity(self.width);
        for step in (0..self.steps()).filter(|&step| self.rows[step].max(other.rows[step]) > 0) {
            row.clear();
            row.extend(self.row(step).iter().zip(other.row(step)).map(|(a, b)| of(f64::from(*a), f64::from(*b))));
            table.set(step, &row);
        }
        table
    }

    /// Returns the illuminances at the places of some columns; `None` if these are empty or reach beyond a row.
    pub fn columns(&self, places: Range<usize>) -> Option<Light<'_>> {
        let whole = !places.is_empty() && places.end <= self.width;
        whole.then(|| Light { table: self, first: places.start, places: places.len() })
    }
}

impl PartialEq for StepTable {
    fn eq(&self, other: &Self) -> bool {
        (self.steps(), self.width) == (other.steps(), other.width)
            && (0..self.steps()).all(|step| self.row(step) == other.row(step))
    }
}

/// Illuminances of a year at calculation points or observers' eyes ("places"): one row per step, one column per place.
/// \[lx\]
#[derive(Debug, Clone, Copy)]
pub struct Light<'a> {
    table: &'a StepTable,
    /// Column of the first place.
    first: usize,
    places: usize,
}

impl<'a> Light<'a> {
    /// Returns the number of places (calculation points or eyes) of the table.
    pub const fn places(&self) -> usize {
        self.places
    }

    /// Returns the illuminances of one step, one per place. \[lx\]
    pub fn row(&self, step: usize) -> &'a [f32] {
        &self.table.row(step)[self.first..][..self.places]
    }

    /// Returns the illuminance of one place in one step. \[lx\]
    pub fn at(&self, step: usize, place: usize) -> f64 {
        f64::from(self.row(step)[place])
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_zeros_take_no_memory_and_are_read_like_others() {
        let mut table = StepTable::zeros(4, 2, 1);
        table.set(2, &[1.0, 3.0]);
        table.set(1, &[0.0, 0.0]);
        assert_eq!(table.values().collect::<Vec<_>>(), [0.0, 0.0, 0.0, 0.0, 1.0, 3.0, 0.0, 0.0]);
        assert_eq!(table.values.len(), 4);
        let light = table.columns(1..2).unwrap();
        assert_eq!([0, 1, 2, 3].map(|step| light.at(step, 0)), [0.0, 0.0, 3.0, 0.0]);
        assert!(table.columns(1..3).is_none() && table.columns(1..1).is_none());
        let mut errors = StepTable::zeros(4, 2, 1);
        errors.set(3, &[0.5, 0.0]);
        let more = table.with(&errors, |value, error| value + error);
        assert_eq!([more.row(2), more.row(3)], [[1.0, 3.0], [0.5, 0.0]]);
        assert_eq!(table.with(&table, |a, b| a * b).row(2), [1.0, 9.0]);
        // Set again, and in another order.
        let mut other = StepTable::zeros(4, 2, 2);
        other.set(3, &[7.0, 7.0]);
        other.set(2, &[1.0, 3.0]);
        assert!(other != table);
        other.set(3, &[0.0, 0.0]);
        assert_eq!(other, table);
        assert_eq!(StepTable::of_rows(2, &[0.0, 0.0, 0.0, 0.0, 1.0, 3.0, 0.0, 0.0]), Some(table));
        assert_eq!(StepTable::of_rows(2, &[1.0, 2.0, 3.0]), None);
        let mut none = StepTable::zeros(3, 0, 0);
        none.set::<f64>(1, &[]);
        assert_eq!((none.row(1), none.values().count()), (&[][..], 0));
    }
}
