//! Time intervals that the hours and minutes of EPW rows mean.
//!
//! The EPW dictionary defines the minute as that at which the interval ends, and programs write the one at which it
//! begins as well: 10 to 60 or 0 to 50. The rows decide which, since they follow each other without gaps; where both
//! are possible, the sun's position decides. The number of records per hour in the header is checked against the
//! minutes. Hours count from 1 to 24; where they count from 0 to 23, the sun's position also decides whether the
//! intervals begin or end there.

use crate::compute::btdf::Finding;
use crate::compute::weather::{Record, Weather};
use crate::formats::{FormatError, Location};

/// Hour and minute of an EPW row, from which its interval is determined.
#[derive(Debug, Clone, Copy)]
pub struct Label {
    /// Hour of the row, 1 … 24, or 0 … 23.
    pub hour: u8,
    /// Minute of the row, 0 … 60; `None` if the field is not such a number.
    pub minute: Option<u8>,
    /// Column of the minute in the line, in characters from 1.
    pub column: u16,
}

/// Length of the intervals that the header of an EPW file states.
#[derive(Debug, Clone, Copy)]
pub struct Stated {
    /// Length of the intervals, a divisor of an hour. \[min\]
    pub interval: u16,
    /// Number of the line DATA PERIODS, from 1.
    pub line: usize,
}

/// Difference in the rms residual of global − diffuse − direct · sin h from which the sun's position decides whether
/// minutes mark the begin or the end of intervals. \[W/m²\]
const CLEARLY: f64 = 5.0;
/// Name of the hour in messages.
const HOUR: &str = "field 4 (hour)";
/// Name of the minute in messages.
const MINUTE: &str = "field 5 (minute)";

/// Sets the length of a weather file's intervals and the begin of each record's interval, from the hours and minutes of
/// the rows.
///
/// # Errors
/// Returns an error if a minute is not that of an interval, if the distance of rows does not divide an hour, or if an
/// hour 0 is not the first of a day.
pub fn place_intervals(weather: &mut Weather, labels: &mut [Label], stated: Stated) -> Result<(), FormatError> {
    let is_from_zero = count_from_one(&weather.records, labels)?;
    place_in_hours(weather, labels, stated)?;
    if !is_from_zero {
        return Ok(());
    }
    // Both follow each other as well as their rows do, so that only the sun tells.
    let length = 60 * i32::from(weather.interval);
    let at_begins = rms(weather);
    shift(weather, -length);
    let is_end = at_begins.zip(rms(weather)).is_some_and(|(at_begins, at_ends)| at_ends + CLEARLY < at_begins);
    if !is_end {
        shift(weather, length);
    }
    let read = if is_end { "end, 0 the last one of the day before" } else { "begin" };
    let message =
        format!("hours count from 0 to 23, not from 1 to 24: they were read as those at which the intervals {read}");
    weather.findings.push(Finding::info("hour-zero", message));
    Ok(())
}

/// Converts hours that count from 0 to 23 to 1 … 24; returns whether the file's hours count from 0.
fn count_from_one(records: &[Record], labels: &mut [Label]) -> Result<bool, FormatError> {
    if labels.iter().all(|label| label.hour > 0) {
        return Ok(false);
    }
    for (k, (record, label)) in records.iter().zip(&*labels).enumerate() {
        let is_late = k > 0 && label.hour == 0 && records[k - 1].day == record.day && labels[k - 1].hour > 0;
        if label.hour == 24 || is_late {
            let at = Location::line(record.line as usize).in_element(HOUR);
            let found = if is_late { "hour 0 after other hours of its day" } else { "hour 24 in a file with hour 0" };
            return Err(FormatError::new(at, found, "hours from 1 to 24, or from 0 to 23"));
        }
    }
    labels.iter_mut().for_each(|label| label.hour += 1);
    Ok(true)
}

/// Shifts the intervals of all records by `seconds`.
fn shift(weather: &mut Weather, seconds: i32) {
    weather.records.iter_mut().for_each(|record| record.start += seconds);
}

/// Sets the length of the intervals and the begin of each, for hours that count from 1.
fn place_in_hours(weather: &mut Weather, labels: &[Label], stated: Stated) -> Result<(), FormatError> {
    let interval = interval(weather, labels, stated)?;
    weather.interval = interval;
    if interval != stated.interval {
        let message = format!(
            "line {} (DATA PERIODS) states records of {} min, while rows are {interval} min apart: the rows are believed",
            stated.line, stated.interval
        );
        weather.findings.push(Finding::warning("records-per-hour", message));
    }
    let length = 60 * i32::from(interval);
    if interval == 60 {
        for (record, label) in weather.records.iter_mut().zip(labels) {
            record.start = length * (i32::from(label.hour) - 1);
        }
        return Ok(());
    }
    for (record, label) in weather.records.iter().zip(labels) {
        if !label.minute.is_some_and(|minute| u16::from(minute).is_multiple_of(interval)) {
            let at = Location::line_column(record.line as usize, usize::from(label.column)).in_element(MINUTE);
            let found = label.minute.map_or("not a minute".to_owned(), |minute| format!("\"{minute}\""));
            let expected = format!("a multiple of {interval} min, the begin or end of the interval");
            return Err(FormatError::new(at, found, expected));
        }
    }
    let ends = |label: &Label| match label.minute {
        // The hour ends with minute 60 or 0.
        Some(0) | None => 3600 - length,
        Some(minute) => 60 * i32::from(minute) - length,
    };
    let begins = |label: &Label| 60 * i32::from(label.minute.unwrap_or(0));
    set(weather, labels, ends);
    if labels.iter().any(|label| label.minute == Some(60)) {
        return Ok(());
    }
    let breaks_at_ends = breaks(weather);
    set(weather, labels, begins);
    let breaks_at_begins = breaks(weather);
    let begin = if breaks_at_begins == breaks_at_ends {
        let at_begins = rms(weather);
        set(weather, labels, ends);
        at_begins.zip(rms(weather)).is_some_and(|(at_begins, at_ends)| at_begins + CLEARLY < at_ends)
    } else {
        breaks_at_begins < breaks_at_ends
    };
    if begin {
        set(weather, labels, begins);
        let message =
            "minutes are those at which the intervals begin (0 is the first of an hour), not at which they end";
        weather.findings.push(Finding::info("minute-begin", message));
    } else {
        set(weather, labels, ends);
    }
    Ok(())
}

/// Returns the length of the intervals: by the minutes of the rows if these agree, else by the header. \[min\]
fn interval(weather: &Weather, labels: &[Label], stated: Stated) -> Result<u16, FormatError> {
    let minutes = || labels.iter().filter_map(|label| label.minute);
    let distances = distances(&weather.records, labels);
    let pairs: usize = distances.iter().sum();
    let fits = |interval: u16| minutes().all(|minute| u16::from(minute).is_multiple_of(interval));
    // Most rows stand alone in their hour: of one record an hour the minute says nothing.
    if 3 * pairs < labels.len() {
        let whole = labels.len() > 1 && fits(60);
        return Ok(if whole { 60 } else { stated.interval });
    }
    // Of equals the longest.
    let distance = (1..=60).max_by_key(|minutes| distances[usize::from(*minutes)]).unwrap_or(stated.interval);
    if distance == stated.interval || (60 % distance == 0 && fits(distance)) {
        return Ok(distance);
    }
    if stated.interval < 60 {
        return Ok(stated.interval);
    }
    let found = format!("1 record per hour, while rows are {distance} min apart");
    let expected = "the number of rows per hour, all at multiples of the same minutes";
    Err(FormatError::new(Location::line(stated.line).in_element("DATA PERIODS, records per hour"), found, expected))
}

/// Returns for each distance from 1 to 60 min how many pairs of successive rows within an hour have it, indexed by the
/// distance; the hour ends with minute 60 or 0.
fn distances(records: &[Record], labels: &[Label]) -> [usize; 61] {
    let mut counts = [0; 61];
    for (pair, records) in labels.windows(2).zip(records.windows(2)) {
        let (Some(before), Some(after)) = (pair[0].minute, pair[1].minute) else { continue };
        if records[0].day == records[1].day && pair[0].hour == pair[1].hour && before != after {
            let after = if after == 0 { 60 } else { after };
            counts[usize::from(after.abs_diff(before))] += 1;
        }
    }
    counts
}

/// Sets the begin of each record's interval; `begin` returns it in seconds after the full hour before it.
fn set(weather: &mut Weather, labels: &[Label], begin: impl Fn(&Label) -> i32) {
    for (record, label) in weather.records.iter_mut().zip(labels) {
        record.start = 3600 * (i32::from(label.hour) - 1) + begin(label);
    }
}

/// Returns the number of rows that do not begin where the row above ends.
fn breaks(weather: &Weather) -> usize {
    let length = 60 * i64::from(weather.interval);
    weather.records.windows(2).filter(|pair| pair[0].seconds_to(&pair[1]) != length).count()
}

/// Returns the rms residual of global − diffuse − direct · sin h; `None` if the file does not allow to compute it.
/// \[W/m²\]
fn rms(weather: &Weather) -> Option<f64> {
    weather.closure().ok().flatten().map(|closure| closure.rms)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::weather::{Day, SunPath};
    use crate::formats::weather::read;

    /// An EPW file that states `records` an hour, with rows of hour, minute and light (global, direct normal, diffuse).
    fn file(records: u16, rows: &[(u8, u8, [f64; 3])]) -> Result<Weather, FormatError> {
        read("x.epw", text(records, rows).as_bytes())
    }

    /// The text of [`file`].
    fn text(records: u16, rows: &[(u8, u8, [f64; 3])]) -> String {
        let head = "LOCATION,Somewhere,-,Land,-,-,50,15,1,250\n";
        let mut text = format!("{head}DATA PERIODS,1,{records},Data,Sunday,6/21,6/21\n");
        for (hour, minute, [global, direct, diffuse]) in rows {
            text += &format!(
                "2018,6,21,{hour},{minute},?9,15,8,60,101300,0,1361,300,{global},{direct},{diffuse},999999,999999,999999\n"
            );
        }
        text
    }

    /// Rows of two hours with these minutes.
    fn rows(minutes: &[u8]) -> Vec<(u8, u8, [f64; 3])> {
        [12, 13].iter().flat_map(|hour| minutes.iter().map(move |minute| (*hour, *minute, [0.0; 3]))).collect()
    }

    fn codes(weather: &Weather) -> Vec<&'static str> {
        weather.findings.iter().map(|finding| finding.code).collect()
    }

    #[test]
    fn minutes_are_begins_or_ends_as_the_rows_follow_each_other() {
        let two_hours = |step: i32| (0..7200 / step).map(|k| 11 * 3600 + step * k).collect::<Vec<_>>();
        for (records, minutes, step, begin) in [
            (6, [0, 10, 20, 30, 40, 50].as_slice(), 600, true),
            (6, &[10, 20, 30, 40, 50, 60], 600, false),
            (6, &[10, 20, 30, 40, 50, 0], 600, false),
            (4, &[0, 15, 30, 45], 900, true),
            (4, &[15, 30, 45, 0], 900, false),
            (2, &[0, 30], 1800, true),
            (2, &[30, 60], 1800, false),
        ] {
            let weather = file(records, &rows(minutes)).unwrap();
            let starts: Vec<i32> = weather.records.iter().map(|record| record.start).collect();
            assert_eq!((weather.interval, starts), ((step / 60) as u16, two_hours(step)), "{minutes:?}");
            assert_eq!(codes(&weather).contains(&"minute-begin"), begin, "{minutes:?}");
        }
    }

    #[test]
    fn the_sun_tells_where_rows_do_not() {
        // One row an hour in a file of half hours: minute 30 ends the first one or begins the second one.
        let day = Day::new(2018, 6, 21).unwrap();
        for (middle, begin) in [(15.0, false), (45.0, true)] {
            let lit = |hour: u8| {
                let mut path = SunPath::new(&file(2, &rows(&[30])).unwrap().station);
                path.turn_to(day.number()).unwrap();
                let sine = path.at(60.0 * (f64::from(hour) - 1.0) + middle).z.max(0.0);
                let direct = if sine > 0.0 { 800.0 } else { 0.0 };
                [100.0 + direct * sine, direct, 100.0]
            };
            let rows: Vec<_> = (1..=24).chain(1..=24).map(|hour| (hour, 30, lit(hour))).collect();
            let weather = file(2, &rows).unwrap();
            assert_eq!((weather.interval, codes(&weather).contains(&"minute-begin")), (30, begin));
            assert_eq!(weather.records[0].start, if begin { 1800 } else { 0 });
        }
    }

    #[test]
    fn hours_from_zero_begin_or_end_as_the_sun_tells() {
        let day = Day::new(2018, 6, 21).unwrap();
        let station = file(1, &rows(&[60])).unwrap().station;
        // Light of the middle of an interval, in hours from midnight.
        let lit = |middle: f64| {
            let mut path = SunPath::new(&station);
            path.turn_to(day.number()).unwrap();
            let sine = path.at(60.0 * middle).z.max(0.0);
            let direct = if sine > 0.0 { 800.0 } else { 0.0 };
            [100.0 + direct * sine, direct, 100.0]
        };
        for (middle, first, words) in [(0.5, 0, "begin"), (-0.5, -3600, "end, 0 the last")] {
            let rows: Vec<_> = (0..24).map(|hour| (hour, 0, lit(f64::from(hour) + middle))).collect();
            let (mut text, length) = (text(1, &rows), text(1, &[]).len());
            // One day has too few hours of sun.
            text += &text[length..].replace("2018,6,21,", "2018,6,22,");
            let weather = read("x.epw", text.as_bytes()).unwrap();
            let starts: Vec<i32> = weather.records.iter().take(24).map(|record| record.start).collect();
            assert_eq!(starts, (0..24).map(|hour| first + 3600 * hour).collect::<Vec<_>>());
            assert_eq!((weather.interval, codes(&weather)), (60, vec!["hour-zero"]));
            assert!(weather.findings[0].message.contains(words), "{}", weather.findings[0].message);
        }
        // Without light they begin there, also in steps of half an hour.
        let rows: Vec<_> = (0..24).flat_map(|hour| [0, 30].map(|minute| (hour, minute, [0.0; 3]))).collect();
        let weather = file(2, &rows).unwrap();
        assert_eq!((weather.interval, weather.records[0].start, weather.records[47].start), (30, 0, 84_600));
        for (hours, words) in [([1, 24, 0], "hour 24"), ([22, 23, 0], "hour 0 after")] {
            let rows: Vec<_> = hours.iter().map(|hour| (*hour, 0, [0.0; 3])).collect();
            let error = file(1, &rows).unwrap_err().to_string();
            assert!(error.contains(words) && error.contains("field 4 (hour)"), "{error}");
        }
    }

    #[test]
    fn rows_are_believed_where_the_header_has_another_number() {
        let weather = file(1, &rows(&[15, 30, 45, 60])).unwrap();
        assert_eq!((weather.interval, weather.records[0].start), (15, 11 * 3600));
        assert_eq!(codes(&weather), ["records-per-hour"]);
        let message = &weather.findings[0].message;
        assert!(message.contains("line 2") && message.contains("60 min") && message.contains("15 min"), "{message}");
        let weather = file(4, &rows(&[60])).unwrap();
        assert_eq!((weather.interval, weather.records[1].start), (60, 12 * 3600));
        assert_eq!(codes(&weather), ["records-per-hour"]);
        // Whatever the minute of one record an hour, and a row that is repeated.
        for minutes in [[0].as_slice(), &[30], &[60, 60]] {
            let weather = file(1, &rows(minutes)).unwrap();
            assert_eq!((weather.interval, codes(&weather).len()), (60, 0));
        }
        let error = file(1, &rows(&[7, 14, 21, 28])).unwrap_err().to_string();
        assert!(error.starts_with("line 2, DATA PERIODS, records per hour: 1 record per hour"), "{error}");
        assert!(error.contains("7 min apart"), "{error}");
    }
}
