//! Control mode "table": states from a file, row by row in time.

use super::device::Device;
use crate::compute::control::controller::Rule;
use crate::formats::state_table::{of_year, read_states};
use crate::study::error::StudyError;
use crate::study::files;
use crate::study::scene_file::SceneFile;
use crate::study::sun_position::parse_local_time;
use std::path::Path;

/// Reads the file of mode "table". Returns the time of each row, in seconds since the beginning of the year, with the
/// index of its state.
///
/// # Errors
/// Returns an error if the file cannot be read, or if a row has no state or one that the device does not have, with
/// its line.
pub(super) fn read(name: Option<&Path>, device: &Device, base: &Path) -> Result<Vec<(f64, usize)>, StudyError> {
    let name = name.ok_or_else(|| {
        StudyError::key("control.file", "missing: mode = \"table\" needs a file with the columns time,state")
    })?;
    let wrong = |message: String| StudyError::key("control.file", format!("{}: {message}", name.display()));
    let bytes = files::read(&base.join(name)).map_err(|error| StudyError::key("control.file", error.to_string()))?;
    let rows = read_states(&bytes).map_err(|error| wrong(error.to_string()))?;
    rows.iter()
        .map(|row| {
            let state = device.keys.iter().position(|key| *key == row.state).ok_or_else(|| {
                let keys = device.keys.join(", ");
                wrong(format!("line {}: '{}' has no state '{}'; it has: {keys}", row.line, device.name, row.state))
            })?;
            Ok((row.of_year, state))
        })
        .collect()
}

/// Checks, for a rule of mode "table", that its first row is not later than a moment with light. `of_year`: the moment
/// in seconds since the beginning of the year.
///
/// # Errors
/// Returns an error if the table begins later or the moment has no date, with what was expected.
pub fn begun(rule: &Rule, of_year: Option<f64>) -> Result<(), StudyError> {
    let Rule::Table(rows) = rule else { return Ok(()) };
    let Some(at) = of_year else {
        return Err(StudyError::key("control.file", "needs sky.time: with sun angles alone no row is the one"));
    };
    match rows.first() {
        Some((first, _)) if *first > at => {
            let message = format!("begins on {}, after {}, when there is light", day(*first), day(at));
            Err(StudyError::key("control.file", format!("{message}; expected a row at or before it")))
        }
        _ => Ok(()),
    }
}

/// Returns a time, given in seconds since the beginning of the year, as text: day and time of day.
fn day(seconds: f64) -> String {
    let whole = seconds as i64;
    // The first of January is day 1.
    let time = jiff::civil::date(2023, 12, 31).at(0, 0, 0, 0).saturating_add(jiff::Span::new().seconds(whole));
    time.strftime("%m-%d %H:%M").to_string()
}

/// Returns the scene's moment in seconds since the beginning of the year, in local standard time; `None` for a scene
/// without a time.
pub fn of_scene(file: &SceneFile) -> Option<f64> {
    let time = parse_local_time(&file.sky.time.as_ref()?.text()).ok()?;
    Some(of_year(file.site.dst.standard(time, file.site.utc_offset.unwrap_or(0.0))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_of_the_year_are_said_as_they_were_read() {
        for text in ["01-01 00:30", "02-29 12:00", "12-31 23:30"] {
            let time = format!("2024-{}", text.replace(' ', "T")).parse().unwrap();
            assert_eq!(day(of_year(time)), text);
        }
    }

    #[test]
    fn a_table_says_nothing_before_it_begins() {
        let rule = Rule::Table(vec![(86_400.0, 0)]);
        assert!(begun(&rule, Some(86_400.0)).is_ok() && begun(&Rule::Fixed(0), None).is_ok());
        assert!(begun(&rule, Some(86_399.0)).unwrap_err().to_string().contains("begins on 01-01 00:00"));
        assert!(begun(&rule, None).is_err());
    }
}
