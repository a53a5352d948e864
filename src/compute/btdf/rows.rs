//! Storage of indicatrices on the same emergent cells: as plain values, or compressed by wavelets and restored on
//! request.

use crate::compute::wavelet::CompactRows;
use std::borrow::Cow;
use std::sync::Arc;

/// Luminance coefficients of indicatrices on the same emergent cells.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Rows {
    /// Plain values in double precision. \[1/sr\]
    Plain(Arc<Vec<f64>>),
    /// Plain values in single precision, for very many values that it holds without loss: half the memory. \[1/sr\]
    Single(Arc<Vec<f32>>),
    /// Indicatrices compressed by wavelets, few numbers per row.
    Compact(Arc<CompactRows>),
}

/// Number of values above which single precision is used to save memory: 64 MB in double precision. Chosen: cost only,
/// no effect on results.
const MANY: usize = 1 << 23;

impl Rows {
    /// Creates the storage from the values of all indicatrices, one after the other \[1/sr\].
    pub fn of(values: Vec<f64>) -> Self {
        if values.len() > MANY && values.iter().all(|value| f64::from(*value as f32).to_bits() == value.to_bits()) {
            return Self::Single(Arc::new(values.into_iter().map(|value| value as f32).collect()));
        }
        Self::Plain(Arc::new(values))
    }

    /// Creates the storage from the values of all indicatrices in single precision \[1/sr\].
    pub fn of_single(values: Vec<f32>) -> Self {
        if values.len() > MANY {
            return Self::Single(Arc::new(values));
        }
        Self::Plain(Arc::new(values.into_iter().map(f64::from).collect()))
    }

    /// Returns the weighted sum of every indicatrix; `weight`: weight of each cell.
    pub fn sums(&self, rows: usize, weight: &[f64]) -> Vec<f64> {
        (0..rows).map(|k| self.row(k, weight.len()).iter().zip(weight).map(|(q, w)| q * w).sum()).collect()
    }

    /// Returns the indicatrix with index `row`, of `n` values. \[1/sr\]
    pub fn row(&self, row: usize, n: usize) -> Cow<'_, [f64]> {
        match self {
            Self::Plain(values) => Cow::Borrowed(&values[row * n..(row + 1) * n]),
            Self::Single(values) => {
                Cow::Owned(values[row * n..(row + 1) * n].iter().map(|value| f64::from(*value)).collect())
            }
            Self::Compact(rows) => Cow::Owned(rows.row(row)),
        }
    }

    /// Returns the value of one cell of the indicatrix with index `row`, of `n` values. \[1/sr\]
    pub fn value(&self, row: usize, cell: usize, n: usize) -> f64 {
        match self {
            Self::Plain(values) => values[row * n + cell],
            Self::Single(values) => f64::from(values[row * n + cell]),
            Self::Compact(rows) => rows.value(row, cell),
        }
    }

    /// Returns the values of all indicatrices, one after the other. \[1/sr\]
    pub fn all(&self) -> Cow<'_, [f64]> {
        match self {
            Self::Plain(values) => Cow::Borrowed(values),
            Self::Single(values) => Cow::Owned(values.iter().map(|value| f64::from(*value)).collect()),
            Self::Compact(rows) => Cow::Owned((0..rows.len()).flat_map(|row| rows.row(row)).collect()),
        }
    }

    /// Returns the indicatrices compressed by wavelets; `None` for plain values.
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
