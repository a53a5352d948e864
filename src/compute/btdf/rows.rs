//! How indicatrices on the same cells are held: as plain values, or compact and made again when asked for.

use crate::compute::wavelet::CompactRows;
use std::borrow::Cow;
use std::sync::Arc;

/// One indicatrix after the other.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Rows {
    /// Every value. \[1/sr\]
    Plain(Vec<f64>),
    /// Few numbers a row.
    Compact(Arc<CompactRows>),
}

impl Rows {
    /// One row of `n` values.
    pub fn row(&self, row: usize, n: usize) -> Cow<'_, [f64]> {
        match self {
            Self::Plain(values) => Cow::Borrowed(&values[row * n..(row + 1) * n]),
            Self::Compact(rows) => Cow::Owned(rows.row(row)),
        }
    }

    /// One value of a row of `n`.
    pub fn value(&self, row: usize, cell: usize, n: usize) -> f64 {
        match self {
            Self::Plain(values) => values[row * n + cell],
            Self::Compact(rows) => rows.value(row, cell),
        }
    }

    /// All rows, one after the other.
    pub fn all(&self) -> Cow<'_, [f64]> {
        match self {
            Self::Plain(values) => Cow::Borrowed(values),
            Self::Compact(rows) => Cow::Owned((0..rows.len()).flat_map(|row| rows.row(row)).collect()),
        }
    }

    /// The compact form, where it is one.
    pub fn compact(&self) -> Option<&Arc<CompactRows>> {
        match self {
            Self::Plain(_) => None,
            Self::Compact(rows) => Some(rows),
        }
    }
}
