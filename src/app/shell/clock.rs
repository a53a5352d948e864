//! Time of day in the user's time zone, and dates as text.

use crate::study::clock::now as zoned;
use crate::texts::{Text, scene as texts};
use jiff::Timestamp;
use jiff::civil::Date;

/// Names of the months in short dates: short names in English, numbers in German.
const MONTHS: [Text; 12] = [
    texts::JANUARY,
    texts::FEBRUARY,
    texts::MARCH,
    texts::APRIL,
    texts::MAY,
    texts::JUNE,
    texts::JULY,
    texts::AUGUST,
    texts::SEPTEMBER,
    texts::OCTOBER,
    texts::NOVEMBER,
    texts::DECEMBER,
];

/// Returns the short name of the month of a day.
fn month(day: Date) -> Text {
    // Months count from 1.
    MONTHS[usize::from(day.month().unsigned_abs()) - 1]
}

/// Returns a date as text, e.g. `21 Mar 2026`.
pub fn date(day: Date) -> String {
    texts::day_month_year(day.day(), month(day), day.year())
}

/// Returns a day of any year as text, e.g. `21 Mar`.
pub fn day_of_year(day: Date) -> String {
    texts::day_and_month(day.day(), month(day))
}

/// Returns the current time in hours and minutes, e.g. `14:03`.
pub fn now() -> String {
    zoned().strftime("%H:%M").to_string()
}

/// Returns the current time in UTC, e.g. `2026-03-21T13:03:59.123456Z`.
pub fn stamp() -> String {
    zoned().timestamp().to_string()
}

/// Returns a time stamp (UTC) as text in the user's time zone: the time of day if it is of today, else with its date.
/// Returns the text unchanged if it is not a time stamp.
pub fn words(stamp: &str) -> String {
    let Ok(time) = stamp.parse::<Timestamp>() else { return stamp.to_owned() };
    let now = zoned();
    let then = time.to_zoned(now.time_zone().clone());
    let clock = then.strftime("%H:%M");
    if then.date() == now.date() { clock.to_string() } else { format!("{}, {clock}", date(then.date())) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stamps_read_as_clock_times_of_today_and_with_their_date_before() {
        assert_eq!(words(&stamp()).len(), 5);
        assert!(words("2020-03-21T12:00:00Z").contains("Mar 2020, "));
        assert_eq!(words("soon"), "soon");
    }
}
