//! Tables of texts and figures for reports, with line breaks within cells and page breaks between rows.

use crate::drawing::Align;
use crate::drawing::font::{width, wrapped};

/// Column of a table: head and alignment.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Text of the column's head, with unit.
    pub head: String,
    /// Alignment of the column's cells; figures are aligned at the right.
    pub align: Align,
}

/// Table of a report.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// Columns of the table.
    pub columns: Vec<Column>,
    /// Rows with one text per column; cells missing at the end of a row are empty.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// Creates a table without rows, with the given column heads. The first column is aligned at the left, for texts,
    /// the others at the right, for figures.
    pub fn of<const N: usize>(heads: [&str; N]) -> Self {
        let column = |(k, head): (usize, &str)| Column {
            head: head.to_owned(),
            align: if k == 0 { Align::Start } else { Align::End },
        };
        Self { columns: heads.into_iter().enumerate().map(column).collect(), rows: Vec::new() }
    }

    /// Adds a row with one text per column.
    pub fn row<const N: usize>(&mut self, cells: [String; N]) {
        self.rows.push(cells.into());
    }

    /// Returns the widths of the columns \[pt\] for the font size `size` and the gap `gap` within the width `whole`:
    /// those of their texts, the widest ones reduced until all fit, or the remaining width distributed.
    pub(super) fn widths(&self, size: f64, gap: f64, whole: f64) -> Vec<f64> {
        let count = self.columns.len();
        let room = (whole - gap * count.saturating_sub(1) as f64).max(1.0);
        let natural = |k: usize| {
            let cells = self.rows.iter().filter_map(|row| row.get(k));
            cells.chain([&self.columns[k].head]).map(|text| width(text, size)).fold(8.0, f64::max) + 0.5
        };
        let widths: Vec<f64> = (0..count).map(natural).collect();
        let sum: f64 = widths.iter().sum();
        if sum <= room {
            let more = (room - sum) / count.max(1) as f64;
            return widths.into_iter().map(|width| width + more).collect();
        }
        // No word is broken where all of them fit.
        let longest = |k: usize| {
            let cells = self.rows.iter().filter_map(|row| row.get(k)).chain([&self.columns[k].head]);
            cells.flat_map(|text| text.split_whitespace()).map(|word| width(word, size)).fold(8.0, f64::max) + 0.5
        };
        let mut least: Vec<f64> = (0..count).map(longest).collect();
        if least.iter().sum::<f64>() > room {
            least.fill(1.0);
        }
        // No column is wider than a limit, which is as large as fits.
        let limited = |limit: f64| widths.iter().zip(&least).map(move |(width, least)| width.min(limit).max(*least));
        let (mut low, mut high) = (0.0, room);
        for _ in 0..50 {
            let limit = 0.5 * (low + high);
            if limited(limit).sum::<f64>() <= room { low = limit } else { high = limit }
        }
        limited(low).collect()
    }

    /// Returns the texts of a row's cells, wrapped to the widths of their columns.
    pub(super) fn lines(&self, row: &[String], size: f64, widths: &[f64]) -> Vec<Vec<String>> {
        let empty = String::new();
        let cell = |k: usize| wrapped(row.get(k).unwrap_or(&empty), size, widths[k]);
        (0..self.columns.len()).map(cell).collect()
    }

    /// Returns the column heads, wrapped to the widths of their columns.
    pub(super) fn head(&self, size: f64, widths: &[f64]) -> Vec<Vec<String>> {
        self.columns.iter().zip(widths).map(|(column, width)| wrapped(&column.head, size, *width)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_fit_and_long_words_give_way() {
        let mut table = Table::of(["state", "τ normal", "remark"]);
        table.row(["45".to_owned(), "0.12".to_owned(), "a remark that goes on and on ".repeat(6)]);
        let widths = table.widths(9.0, 10.0, 300.0);
        assert!((widths.iter().sum::<f64>() + 20.0) <= 300.0 + 1e-6);
        assert!(widths[0] >= width("state", 9.0) && widths[1] >= width("τ normal", 9.0));
        assert!(table.lines(&table.rows[0], 9.0, &widths)[2].len() > 2);
        // A long word stays whole, whatever the others say.
        let mut long = Table::of(["figure", "1", "2"]);
        let cells = ["Beleuchtungsstärke / lx".to_owned(), "a b c d e f g ".repeat(9), "a b c d e f g ".repeat(9)];
        long.row(cells);
        let widths = long.widths(9.0, 10.0, 240.0);
        assert!(widths[0] >= width("Beleuchtungsstärke", 9.0) && widths.iter().sum::<f64>() + 20.0 <= 240.0 + 1e-6);
        // A narrow table fills the line.
        let small = Table::of(["a", "b"]);
        assert!((small.widths(9.0, 10.0, 300.0).iter().sum::<f64>() - 290.0).abs() < 1e-6);
    }
}
