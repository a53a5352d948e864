//! The time of day where the user is.

use jiff::{Timestamp, Zoned};

/// Hours and minutes now, e.g. `14:03`.
pub fn now() -> String {
    Zoned::now().strftime("%H:%M").to_string()
}

/// Now as UTC, e.g. `2026-03-21T13:03:59.123456Z`.
pub fn stamp() -> String {
    Timestamp::now().to_string()
}

/// A stamp in words of the user's own time: the clock time of today, else with its date. As it is where it is none.
pub fn words(stamp: &str) -> String {
    let Ok(time) = stamp.parse::<Timestamp>() else { return stamp.to_owned() };
    let now = Zoned::now();
    let then = time.to_zoned(now.time_zone().clone());
    let format = if then.date() == now.date() { "%H:%M" } else { "%-d %b %Y, %H:%M" };
    then.strftime(format).to_string()
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
