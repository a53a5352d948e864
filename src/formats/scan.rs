//! Sky scans: 145 luminances on Tregenza's lattice, lowest row first, each row clockwise from north.
//!
//! Read: text with numbers separated by commas, semicolons, tabs or blanks. Either one or more bare numbers a line,
//! 145 in all; or a table with a header that has a column `L_mean_cdm2`, `luminance` or, failing these,
//! `L_centre_cdm2`, with 145 rows in order, between semicolons also with decimal commas. Lines that begin with `#` are
//! comments. Not read: other lattices, gaps.

use super::decimal_comma::with_decimal_points;
use super::encoding::{NotText, TooLong, decode, not_too_long};
use super::location::excerpt;
use crate::compute::limits;
use crate::compute::sky::Scan;

/// Error in reading a sky scan.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ScanError {
    /// Bytes that are not text.
    #[error(transparent)]
    NotText(#[from] NotText),
    /// Text that is too long for a sky scan.
    #[error(transparent)]
    TooLong(#[from] TooLong),
    /// Field that is not a luminance (a finite number of 0 or more).
    #[error("line {line}: \"{found}\" is not a luminance (expected a number from 0 to {most:e} cd/m²)", most = limits::LUMINANCE)]
    Number {
        /// Line number, from 1.
        line: usize,
        /// Text of the field.
        found: String,
    },
    /// Header of a table that lacks a known column of luminances.
    #[error("line {line}: no column L_mean_cdm2, luminance or L_centre_cdm2 in the header")]
    Header {
        /// Line number, from 1.
        line: usize,
    },
    /// Number of values that is not 145.
    #[error("{0} luminances (expected the 145 of Tregenza's lattice)")]
    Count(usize),
}

/// Reads a sky scan: the luminances of the 145 Tregenza patches. \[cd/m²\]
pub fn read_scan(bytes: &[u8]) -> Result<Scan, ScanError> {
    let text = decode(not_too_long(bytes)?)?;
    let text = with_decimal_points(&text);
    let mut values = Vec::with_capacity(145);
    let mut column = None;
    let mut first = true;
    for (index, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let number = index + 1;
        let fields: Vec<&str> = line.split([',', ';', '\t', ' ']).filter(|field| !field.is_empty()).collect();
        if std::mem::take(&mut first) && fields.iter().any(|field| field.parse::<f64>().is_err()) {
            column = Some(value_column(&fields).ok_or(ScanError::Header { line: number })?);
            continue;
        }
        let chosen = match column {
            Some(column) => fields.get(column..=column).unwrap_or(&["(missing)"]),
            None => &fields[..],
        };
        for field in chosen {
            let value = field.parse::<f64>().ok().filter(|value| (0.0..=limits::LUMINANCE).contains(value));
            values.push(value.ok_or_else(|| ScanError::Number { line: number, found: excerpt(field) })?);
        }
        if values.len() > 100_000 {
            break;
        }
    }
    Scan::new(&values).ok_or(ScanError::Count(values.len()))
}

fn value_column(header: &[&str]) -> Option<usize> {
    ["L_mean_cdm2", "luminance", "L_centre_cdm2"]
        .iter()
        .find_map(|name| header.iter().position(|field| field.eq_ignore_ascii_case(name)))
}
