//! The time of day where the user is.

use crate::study::clock::now as zoned;
use crate::texts::{Text, scene as texts};
use jiff::Timestamp;
use jiff::civil::Date;

/// Months: by name in English, by number in German, as short dates are written.
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

/// Short name of the month of a day.
fn month(day: Date) -> Text {
    // Months count from 1.
    MONTHS[usize::from(day.month().unsigned_abs()) - 1]
}

/// A day: `21 Mar 2026`.
pub fn date(day: Date) -> String {
    texts::day_month_year(day.day(), month(day), day.year())
}

/// A day of any year: `21 Mar`.
pub fn day_of_year(day: Date) -> String {
    texts::day_and_month(day.day(), month(day))
}

/// Hours and minutes now, e.g. `14:03`.
pub fn now() -> String {
    zoned().strftime("%H:%M").to_string()
}

/// Now as UTC, e.g. `2026-03-21T13:03:59.123456Z`.
pub fn stamp() -> String {
    zoned().timestamp().to_string()
}

/// A stamp in words of the user's own time: the clock time of today, else with its date. As it is where it is none.
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
