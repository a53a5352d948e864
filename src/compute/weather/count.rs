//! Count of the rows of a weather file that have a finding in common, with the line of the first one.

use super::record::Record;

/// Count of the rows of a weather file that have a finding in common, with the line of the first one.
#[derive(Default)]
pub(super) struct Count {
    /// Number of rows.
    pub(super) number: usize,
    first: Option<u32>,
}

impl Count {
    /// Counts a row; remembers its line if it is the first.
    pub(super) fn add(&mut self, record: &Record) {
        self.number += 1;
        self.first.get_or_insert(record.line);
    }

    /// Returns the number of rows and the line of the first one in words: `12 rows, first in line 40`.
    pub(super) fn words(&self) -> String {
        let rows = if self.number == 1 { "row" } else { "rows" };
        format!("{} {rows}, first in line {}", self.number, self.first.unwrap_or(0))
    }
}
