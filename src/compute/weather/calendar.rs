//! Days of the Gregorian calendar, without a clock.

use std::fmt;

/// Day of the Gregorian calendar, as the row of a weather file states it. 29 February is accepted in any year, since
/// rows are used as given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Day {
    /// Calendar year, e.g. 2005.
    pub year: i16,
    /// Month, 1 … 12.
    pub month: u8,
    /// Day of the month, from 1.
    pub day: u8,
}

/// Number of days before each month of a common year.
const BEFORE: [u16; 12] = [0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334];
/// Number of days of each month, February with its leap day.
const LENGTHS: [u8; 12] = [31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];

impl Day {
    /// Creates a day; `None` where no year has such a day.
    pub fn new(year: i16, month: u8, day: u8) -> Option<Self> {
        let most = *LENGTHS.get(usize::from(month).checked_sub(1)?)?;
        (1..=most).contains(&day).then_some(Self { year, month, day })
    }

    /// Returns the next day of the calendar.
    #[must_use]
    pub fn next(self) -> Self {
        match (self.month, self.day) {
            (12, 31) => Self { year: self.year + 1, month: 1, day: 1 },
            (month, day) if day >= length(self.year, month) => Self { month: month + 1, day: 1, ..self },
            (_, day) => Self { day: day + 1, ..self },
        }
    }

    /// Returns the day before in the calendar.
    #[must_use]
    pub fn previous(self) -> Self {
        match (self.month, self.day) {
            (1, 1) => Self { year: self.year - 1, month: 12, day: 31 },
            (month, 1) => Self { month: month - 1, day: length(self.year, month - 1), ..self },
            (_, day) => Self { day: day - 1, ..self },
        }
    }

    /// Returns the days since 1 January 1970. A 29 February in a common year is the day after the 28th, as its 1 March.
    pub fn number(self) -> i64 {
        // Years from March on, so that the leap day is the last.
        let shifted = i64::from(self.month < 3);
        let year = i64::from(self.year) - shifted;
        let era = year.div_euclid(400);
        let year_of_era = year.rem_euclid(400);
        let months = i64::from(self.month) + 12 * shifted - 3;
        let day_of_year = (153 * months + 2) / 5 + i64::from(self.day) - 1;
        era * 146_097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year - 719_468
    }

    /// Returns the number of the day in a common year, 1 (1 January) … 365; 29 February has that of the 28th.
    pub fn of_common_year(self) -> u16 {
        let day = if self.month == 2 { self.day.min(28) } else { self.day };
        BEFORE[usize::from(self.month.clamp(1, 12)) - 1] + u16::from(day)
    }

    /// Returns the day of the week, 0 (Monday) … 6 (Sunday).
    pub fn weekday(self) -> u8 {
        // 1 January 1970 was a Thursday.
        (self.number() + 3).rem_euclid(7) as u8
    }

    /// Returns the correction for the earth's eccentric orbit by which the solar constant is multiplied: the square of
    /// the mean distance of the sun over its distance on this day (Spencer 1971, by the day of a common year).
    pub fn eccentricity(self) -> f64 {
        crate::compute::sky::perez::eccentricity(self.of_common_year())
    }
}

/// Returns the number of days of a month, 1 … 12, in a year of the Gregorian calendar.
fn length(year: i16, month: u8) -> u8 {
    let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    if month == 2 && !leap { 28 } else { LENGTHS[usize::from(month.clamp(1, 12)) - 1] }
}

impl fmt::Display for Day {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04}-{:02}-{:02}", self.year, self.month, self.day)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn day(year: i16, month: u8, day: u8) -> Day {
        Day::new(year, month, day).unwrap()
    }

    #[test]
    fn days_are_counted_as_calendars_do() {
        assert_eq!(day(1970, 1, 1).number(), 0);
        assert_eq!(day(2000, 3, 1).number(), 11_017);
        assert_eq!(day(2000, 3, 1).number() - day(2000, 2, 28).number(), 2);
        assert_eq!(day(1900, 3, 1).number() - day(1900, 2, 28).number(), 1);
        assert_eq!(day(1900, 2, 29).number(), day(1900, 3, 1).number());
        assert_eq!(day(2026, 1, 1).number() - day(2025, 1, 1).number(), 365);
        assert_eq!((day(2026, 11, 22).weekday(), day(2026, 11, 23).weekday()), (6, 0));
        assert_eq!((day(2001, 12, 31).of_common_year(), day(2004, 2, 29).of_common_year()), (365, 59));
        for (month, number) in [(0, 1), (13, 1), (4, 31), (2, 30), (1, 0)] {
            assert_eq!(Day::new(2001, month, number), None);
        }
        assert_eq!(day(958, 2, 3).to_string(), "0958-02-03");
    }

    #[test]
    fn days_follow_each_other() {
        let pairs = [
            (day(2001, 2, 28), day(2001, 3, 1)),
            (day(2004, 2, 28), day(2004, 2, 29)),
            (day(2004, 2, 29), day(2004, 3, 1)),
            (day(1900, 2, 28), day(1900, 3, 1)),
            (day(2001, 6, 30), day(2001, 7, 1)),
            (day(2001, 12, 31), day(2002, 1, 1)),
            (day(2001, 6, 20), day(2001, 6, 21)),
        ];
        for (before, after) in pairs {
            assert_eq!((before.next(), after.previous()), (after, before));
        }
        // A 29th of February that its year has not is followed by March all the same.
        assert_eq!(day(2001, 2, 29).next(), day(2001, 3, 1));
    }

    #[test]
    fn the_sun_is_nearest_in_january() {
        assert!((day(2001, 1, 3).eccentricity() - 1.0350).abs() < 3e-4);
        assert!((day(2001, 7, 4).eccentricity() - 0.9666).abs() < 3e-4);
    }
}
