//! Current date and time, valid even if the computer's clock is not.

use jiff::tz::TimeZone;
use jiff::{Timestamp, Zoned};
use std::time::SystemTime;

/// Returns the current date and time in the user's time zone. A clock beyond the calendar (before the year −9999 or
/// after 9999) is set to its end.
pub fn now() -> Zoned {
    at(SystemTime::now())
}

fn at(time: SystemTime) -> Zoned {
    let end = if time < SystemTime::UNIX_EPOCH { Timestamp::MIN } else { Timestamp::MAX };
    Timestamp::try_from(time).unwrap_or(end).to_zoned(TimeZone::system())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_clock_beyond_the_calendar_stands_at_its_end() {
        let year = Duration::from_secs(31_556_952);
        let late = at(SystemTime::UNIX_EPOCH + 9000 * year);
        assert!(late.year() >= 9999 || late.timestamp() == Timestamp::MAX);
        assert_eq!(late.strftime("%H:%M").to_string().len(), 5);
        assert_eq!(at(SystemTime::UNIX_EPOCH + 50 * year).timestamp().as_second(), 50 * 31_556_952);
    }
}
