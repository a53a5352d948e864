//! Storage of indicatrices on the same cells: as plain values, or compact and made again on request.

use crate::compute::wavelet::CompactRows;
use std::borrow::Cow;
use std::sync::Arc;

/// Indicatrices, one after the other.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Rows {
    /// Plain values, shared by those that hold the same. \[1/sr\]
    Plain(Arc<Vec<f64>>),
    /// Very many plain values that f32 holds without loss: half the memory. \[1/sr\]
    Single(Arc<Vec<f32>>),
    /// Compact form, few numbers per row.
    Compact(Arc<CompactRows>),
}

/// Number of values above which memory counts for more than the time that it takes to widen them: 64 MB. Chosen: cost
/// only, no effect on results.
const MANY: usize = 1 << 23;

impl Rows {
    /// Creates rows from values one after the other.
    pub fn of(values: Vec<f64>) -> Self {
        if values.len() > MANY && values.iter().all(|value| f64::from(*value as f32).to_bits() == value.to_bits()) {
            return Self::Single(Arc::new(values.into_iter().map(|value| value as f32).collect()));
        }
        Self::Plain(Arc::new(values))
    }

    /// Creates rows from values that were kept as f32.
    pub fn of_single(values: Vec<f32>) -> Self {
        if values.len() > MANY {
            return Self::Single(Arc::new(values));
        }
        Self::Plain(Arc::new(values.into_iter().map(f64::from).collect()))
    }

    /// Returns the sum of every row, with a weight for each of its values.
    pub fn sums(&self, rows: usize, weight: &[f64]) -> Vec<f64> {
        (0..rows).map(|k| self.row(k, weight.len()).iter().zip(weight).map(|(q, w)| q * w).sum()).collect()
    }

    /// Returns one row of `n` values.
    pub fn row(&self, row: usize, n: usize) -> Cow<'_, [f64]> {
        match self {
            Self::Plain(values) => Cow::Borrowed(&values[row * n..(row + 1) * n]),
            Self::Single(values) => {
                Cow::Owned(values[row * n..(row + 1) * n].iter().map(|value| f64::from(*value)).collect())
            }
            Self::Compact(rows) => Cow::Owned(rows.row(row)),
        }
    }

    /// Returns one value of a row of `n`.
    pub fn value(&self, row: usize, cell: usize, n: usize) -> f64 {
        match self {
            Self::Plain(values) => values[row * n + cell],
            Self::Single(values) => f64::from(values[row * n + cell]),
            Self::Compact(rows) => rows.value(row, cell),
        }
    }

    /// Returns all rows, one after the other.
    pub fn all(&self) -> Cow<'_, [f64]> {
        match self {
            Self::Plain(values) => Cow::Borrowed(values),
            Self::Single(values) => Cow::Owned(values.iter().map(|value| f64::from(*value)).collect()),
            Self::Compact(rows) => Cow::Owned((0..rows.len()).flat_map(|row| rows.row(row)).collect()),
        }
    }

    /// Returns the compact form, where it is one.
    pub fn compact(&self) -> Option<&Arc<CompactRows>> {
        match self {
            Self::Plain(_) | Self::Single(_) => None,
            Self::Compact(rows) => Some(rows),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn very_many_values_are_held_in_half_the_room_where_nothing_is_lost() {
        let exact: Vec<f64> = (0..MANY + 3).map(|k| f64::from((k % 977) as f32 / 977.0)).collect();
        let rows = Rows::of(exact.clone());
        assert!(matches!(rows, Rows::Single(_)));
        assert_eq!((&*rows.row(2, 5), rows.value(2, 3, 5)), (&exact[10..15], exact[13]));
        assert_eq!(*rows.all(), *exact);
        let mut finer = exact;
        finer[7] = 0.1;
        assert!(matches!(Rows::of(finer), Rows::Plain(_)));
        assert!(matches!(Rows::of(vec![0.5; 9]), Rows::Plain(_)));
    }
}
