//! Table of a device's states over time, e.g. from a building simulation or a logger: CSV with the columns `time` and
//! `state`.
//!
//! ```text
//! time,state
//! 2005-01-01T00:30:00,0
//! 2005-01-01T10:30:00,45
//! ```
//!
//! Times are local standard time, rising; each state applies until the next row. The year is ignored, since typical
//! weather years are composed of several. Further columns are not read, nor are decimal seconds and time zones. Columns
//! may be separated by semicolons.

use super::decimal_comma::with_decimal_points;
use super::encoding::{NotText, TooLong, decode, not_too_long};
use super::location::excerpt;
use crate::compute::limits::WEATHER_RECORDS;
use jiff::civil::{Date, DateTime};

/// Row of a table of states: time from which a state applies.
#[derive(Debug, Clone, PartialEq)]
pub struct StateRow {
    /// Line number, from 1.
    pub line: usize,
    /// Time since the beginning of the year from which the state applies, see [`of_year`]. \[s\]
    pub of_year: f64,
    /// Key of the state; never empty.
    pub state: String,
}

/// Error in reading a table of states.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StateTableError {
    /// Bytes that are not text.
    #[error(transparent)]
    NotText(#[from] NotText),
    /// Text that is too long for a table of states.
    #[error(transparent)]
    TooLong(#[from] TooLong),
    /// Header that lacks the required columns.
    #[error("line 1: the header needs the columns time and state")]
    Header,
    /// Row of the table that is not valid.
    #[error("line {line}: {message}")]
    Row {
        /// Line number, from 1.
        line: usize,
        /// Description of the problem, and of what was expected.
        message: String,
    },
    /// Number of rows that is 0 or exceeds the maximum.
    #[error("{0} rows (expected 1 to {WEATHER_RECORDS})")]
    Count(usize),
}

/// Returns the time since the beginning of the year, in a calendar of 366 days, in which every date has the same
/// position in all years. \[s\]
pub fn of_year(time: DateTime) -> f64 {
    // A leap year has every day that any year has.
    let day = Date::new(2024, time.month(), time.day()).map_or(0, |date| date.day_of_year());
    let clock = 3600 * i32::from(time.hour()) + 60 * i32::from(time.minute()) + i32::from(time.second());
    86_400.0 * f64::from(day) + f64::from(clock)
}

/// Reads a table of states.
///
/// # Errors
/// Returns an error with the line if a row has no time or state, or times do not rise.
pub fn read_states(bytes: &[u8]) -> Result<Vec<StateRow>, StateTableError> {
    let text = decode(not_too_long(bytes)?)?;
    let text = with_decimal_points(&text);
    let mut reader = csv::ReaderBuilder::new().flexible(true).trim(csv::Trim::All).from_reader(text.as_bytes());
    let header = reader.headers().map_err(|_| StateTableError::Header)?;
    let column = |name: &str| header.iter().position(|field| field == name).ok_or(StateTableError::Header);
    let (time_at, state_at) = (column("time")?, column("state")?);
    let mut rows: Vec<StateRow> = Vec::new();
    let mut record = csv::StringRecord::new();
    loop {
        let line = usize::try_from(reader.position().line()).unwrap_or(usize::MAX);
        let more = reader.read_record(&mut record).map_err(|error| StateTableError::Row {
            line: error.position().map_or(line, |at| usize::try_from(at.line()).unwrap_or(usize::MAX)),
            message: "no row of CSV".to_owned(),
        })?;
        if !more {
            break;
        }
        let line = record.position().map_or(line, |at| usize::try_from(at.line()).unwrap_or(usize::MAX));
        let wrong = |message: String| StateTableError::Row { line, message };
        let field = record.get(time_at).unwrap_or_default();
        let time: DateTime = field.parse().map_err(|_| {
            wrong(format!("\"{}\" is not a time; expected YYYY-MM-DDTHH:MM, local standard time", excerpt(field)))
        })?;
        let time = of_year(time);
        if rows.last().is_some_and(|last| last.of_year >= time) {
            return Err(wrong(format!(
                "{field} does not come after the row before; expected rising times of one year"
            )));
        }
        let state = record.get(state_at).unwrap_or_default();
        if state.is_empty() {
            return Err(wrong("no state; expected the key of one".to_owned()));
        }
        rows.push(StateRow { line, of_year: time, state: state.to_owned() });
        // Within the loop, so that a file of another kind is not read to its end first.
        if rows.len() > WEATHER_RECORDS {
            return Err(StateTableError::Count(rows.len()));
        }
    }
    if rows.is_empty() { Err(StateTableError::Count(0)) } else { Ok(rows) }
}

#[cfg(test)]
mod tests {
    use super::super::decimal_comma::with_decimal_commas;
    use super::*;

    #[test]
    fn rows_are_read_with_their_lines() {
        let text = "\u{feff}sensor,time,state\r\nx,2005-01-01T00:30:00,0\r\nx,1998-01-01 10:30 ,\"a, b\"\r\n,2024-02-29T00:00,45\r\n";
        let rows = read_states(text.as_bytes()).unwrap();
        assert_eq!(read_states(&with_decimal_commas(text)).unwrap(), rows);
        let of = |row: &StateRow| (row.line, row.of_year - 86_400.0, row.state.clone());
        assert_eq!(of(&rows[0]), (2, 1800.0, "0".to_owned()));
        assert_eq!(of(&rows[1]), (3, 37_800.0, "a, b".to_owned()));
        assert_eq!(of(&rows[2]), (4, 59.0 * 86_400.0, "45".to_owned()));
        // The first of March has one place in all years.
        assert_eq!(of_year("2005-03-01T00:00".parse().unwrap()), of_year("2004-03-01T00:00".parse().unwrap()));
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (text, words) in [
            ("", "line 1"),
            ("time;value\n2005-01-01T00:30;0\n", "line 1"),
            ("time,state\n", "0 rows"),
            ("time,state\nnoon,0\n", "line 2: \"noon\" is not a time"),
            ("time,state\n2005-01-01T00:30,0\n2005-01-01T01:30,\n", "line 3: no state"),
            ("time,state\n2005-01-01T00:30,0\n2005-01-01T01:30\n", "line 3: no state"),
            ("time,state\n2005-01-02T00:30,0\n2006-01-01T01:30,0\n", "line 3: 2006-01-01T01:30 does not come after"),
        ] {
            let error = read_states(text.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(words), "{text:?}: {error}");
        }
    }
}
