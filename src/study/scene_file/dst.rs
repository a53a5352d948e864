//! Key `site.dst`: rule of summer time, by which local time is an hour ahead of standard time.

use jiff::ToSpan;
use jiff::civil::{Date, DateTime, Weekday, date};
use serde::{Deserialize, Serialize};

/// Value of `site.dst`: rule of summer time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(try_from = "DstAsTyped", into = "DstAsTyped")]
pub enum DstKey {
    /// No summer time: the clock shows local standard time throughout the year.
    #[default]
    None,
    /// European Union: last Sunday of March to last Sunday of October, changed at 01:00 UTC.
    Eu,
    /// United States: second Sunday of March to first Sunday of November, changed at 02:00 by the clock.
    Us,
    /// South-eastern states of Australia: first Sunday of October to first Sunday of April, changed at 02:00 standard
    /// time.
    Australia,
    /// New Zealand: last Sunday of September to first Sunday of April, changed at 02:00 standard time.
    NewZealand,
    /// Chile: Sunday on or after 2 September to Sunday on or after 2 April, changed at midnight by the clock.
    Chile,
    /// Period from a first to a last day, both included: month and day of any year, stored in [`ANY_YEAR`]. The last
    /// day may be earlier in the year than the first.
    Days(Date, Date),
}

/// Year that represents all years in [`DstKey::Days`]: it has a 29th of February.
pub const ANY_YEAR: i16 = 2000;

/// Value of `site.dst` as typed: the name of a rule, or two days.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(untagged)]
enum DstAsTyped {
    Word(String),
    Days(Vec<String>),
}

const RIGHT: &str = "\"none\", \"eu\", \"us\", \"australia\", \"new-zealand\", \"chile\", or the first and the last day, e.g. \
                     [\"03-29\", \"10-25\"]";

/// Rules that have a name in scene files, with their names.
const RULES: [(DstKey, &str); 6] = [
    (DstKey::None, "none"),
    (DstKey::Eu, "eu"),
    (DstKey::Us, "us"),
    (DstKey::Australia, "australia"),
    (DstKey::NewZealand, "new-zealand"),
    (DstKey::Chile, "chile"),
];

impl TryFrom<DstAsTyped> for DstKey {
    type Error = String;

    /// Returns the rule with the given name, or the period between two days.
    fn try_from(typed: DstAsTyped) -> Result<Self, String> {
        let days = match typed {
            DstAsTyped::Word(word) => {
                let rule = RULES.iter().find(|(_, name)| *name == word);
                return rule
                    .map(|(key, _)| *key)
                    .ok_or_else(|| format!("site.dst: \"{word}\" is not a rule of summer time (allowed: {RIGHT})"));
            }
            DstAsTyped::Days(days) => days,
        };
        let [first, last] = days.as_slice() else {
            return Err(format!("site.dst: {} days (allowed: {RIGHT})", days.len()));
        };
        // With a year, the day has to be one of that year; the year counts for nothing else.
        let day = |text: &String| {
            let whole = if text.len() == 5 { format!("{ANY_YEAR}-{text}") } else { text.clone() };
            whole
                .parse::<Date>()
                .map_err(|_| format!("site.dst: \"{text}\" is not a day of the calendar; write MM-DD or YYYY-MM-DD"))
        };
        Ok(Self::days(day(first)?, day(last)?))
    }
}

impl From<DstKey> for DstAsTyped {
    fn from(key: DstKey) -> Self {
        if let DstKey::Days(first, last) = key {
            return Self::Days([first, last].map(|day| day.strftime("%m-%d").to_string()).to_vec());
        }
        let name = RULES.iter().find(|(rule, _)| *rule == key).map_or("none", |(_, name)| name);
        Self::Word(name.to_owned())
    }
}

/// Returns the first Sunday on or after a day of the calendar.
fn sunday_from(year: i16, month: i8, day: i8) -> Date {
    // Months and days of the rules are of every year's calendar.
    let from = date(year, month, day);
    let ahead = i32::from(Weekday::Sunday.since(from.weekday()));
    from.saturating_add(ahead.days())
}

impl DstKey {
    /// Creates a period from its first and its last day, whatever their years.
    pub fn days(first: Date, last: Date) -> Self {
        let of_any_year = |day: Date| date(ANY_YEAR, day.month(), day.day());
        Self::Days(of_any_year(first), of_any_year(last))
    }

    /// Whether the rule is "no summer time", which is not written to the file.
    pub(super) fn is_none(&self) -> bool {
        *self == Self::None
    }

    /// Whether summer time applies at a moment given in local standard time. `utc_offset`: UTC offset of standard time.
    /// \[h\]
    fn is_summer(self, standard: DateTime, utc_offset: f64) -> bool {
        let year = standard.year();
        let at = |day: Date, hours: f64| day.to_datetime(jiff::civil::Time::midnight()).saturating_add(minutes(hours));
        let (from, to) = match self {
            Self::None => return false,
            Self::Eu => {
                let hour = 1.0 + utc_offset;
                (at(sunday_from(year, 3, 25), hour), at(sunday_from(year, 10, 25), hour))
            }
            Self::Us => (at(sunday_from(year, 3, 8), 2.0), at(sunday_from(year, 11, 1), 1.0)),
            Self::Australia => (at(sunday_from(year, 10, 1), 2.0), at(sunday_from(year, 4, 1), 2.0)),
            Self::NewZealand => (at(sunday_from(year, 9, 24), 2.0), at(sunday_from(year, 4, 1), 2.0)),
            Self::Chile => (at(sunday_from(year, 9, 2), 0.0), at(sunday_from(year, 4, 2), -1.0)),
            // Whole days by the clock: the hour between the two midnights belongs to them.
            Self::Days(first, last) => {
                let shown = standard.saturating_add(minutes(1.0)).date();
                let [first, last, shown] = [first, last, shown].map(|day| (day.month(), day.day()));
                return if first <= last { (first..=last).contains(&shown) } else { first <= shown || shown <= last };
            }
        };
        if from < to { from <= standard && standard < to } else { from <= standard || standard < to }
    }

    /// Returns the local standard time for a time by the clock. If the clock shows an hour twice in autumn, the first
    /// one is taken. `utc_offset`: UTC offset of standard time. \[h\]
    pub fn standard(self, clock: DateTime, utc_offset: f64) -> DateTime {
        let ahead = clock.saturating_sub(minutes(1.0));
        if self.is_summer(ahead, utc_offset) { ahead } else { clock }
    }

    /// Returns the time by the clock for a moment given in local standard time. `utc_offset`: UTC offset of standard
    /// time. \[h\]
    pub fn clock(self, standard: DateTime, utc_offset: f64) -> DateTime {
        if self.is_summer(standard, utc_offset) { standard.saturating_add(minutes(1.0)) } else { standard }
    }
}

/// Returns hours as a time span to the minute, because UTC offsets are not always whole hours.
fn minutes(hours: f64) -> jiff::Span {
    ((60.0 * hours).round() as i64).minutes()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(text: &str) -> Result<DstKey, String> {
        #[derive(Deserialize)]
        struct Site {
            dst: DstKey,
        }
        toml::from_str::<Site>(&format!("dst = {text}")).map(|site| site.dst).map_err(|error| error.to_string())
    }

    fn standard(key: DstKey, clock: &str, offset: f64) -> String {
        key.standard(clock.parse().unwrap(), offset).strftime("%m-%d %H:%M").to_string()
    }

    #[test]
    fn clocks_change_when_the_calendar_says() {
        let eu = key("\"eu\"").unwrap();
        // 2026: 29 March and 25 October, 2:00 and 3:00 in Central Europe, an hour earlier in Portugal.
        for (clock, is) in [
            ("2026-03-29T01:59", "03-29 01:59"),
            ("2026-03-29T03:00", "03-29 02:00"),
            ("2026-07-01T00:30", "06-30 23:30"),
            ("2026-10-25T02:59", "10-25 01:59"),
            ("2026-10-25T03:00", "10-25 03:00"),
            ("2026-12-21T12:00", "12-21 12:00"),
        ] {
            assert_eq!(standard(eu, clock, 1.0), is, "{clock}");
        }
        assert_eq!(standard(eu, "2026-03-29T02:00", 0.0), "03-29 01:00");
        let us = key("\"us\"").unwrap();
        assert_eq!(standard(us, "2026-03-08T01:59", -8.0), "03-08 01:59");
        assert_eq!(standard(us, "2026-03-08T03:00", -8.0), "03-08 02:00");
        assert_eq!(standard(us, "2026-11-01T01:30", -8.0), "11-01 00:30");
        assert_eq!(standard(us, "2026-11-01T02:00", -8.0), "11-01 02:00");
    }

    #[test]
    fn named_days_count_as_a_whole_and_the_way_back_is_the_same() {
        let days = key("[\"2026-04-01\", \"2026-09-30\"]").unwrap();
        for (clock, is) in [
            ("2026-03-31T23:59", "03-31 23:59"),
            ("2026-04-01T00:00", "03-31 23:00"),
            ("2026-09-30T23:59", "09-30 22:59"),
            ("2026-10-01T00:00", "10-01 00:00"),
        ] {
            assert_eq!(standard(days, clock, 1.0), is, "{clock}");
        }
        for key in [days, DstKey::Eu, DstKey::Us, DstKey::None] {
            for time in ["2026-01-10T08:00", "2026-06-10T08:00", "2026-10-10T23:30"] {
                let time: DateTime = time.parse().unwrap();
                assert_eq!(key.standard(key.clock(time, 1.0), 1.0), time);
            }
        }
    }

    #[test]
    fn south_of_the_equator_summer_time_runs_across_new_year() {
        // Last and first hours of 2026: Sydney 5 April and 4 October, Auckland 5 April and 27 September, Santiago 4
        // April and 6 September at midnight.
        let southern = [
            ("\"australia\"", ["2026-04-05T01:59", "2026-04-05T03:00", "2026-10-04T01:59", "2026-10-04T03:00"]),
            ("\"new-zealand\"", ["2026-04-05T01:59", "2026-04-05T03:00", "2026-09-27T01:59", "2026-09-27T03:00"]),
            ("\"chile\"", ["2026-04-04T22:59", "2026-04-05T00:00", "2026-09-05T23:59", "2026-09-06T01:00"]),
            (
                "[\"10-01\", \"04-01\"]",
                ["2026-04-01T23:59", "2026-04-02T00:00", "2026-09-30T23:59", "2026-10-01T00:00"],
            ),
        ];
        for (text, clocks) in southern {
            let key = key(text).unwrap();
            let ahead = clocks.map(|clock| {
                let clock: DateTime = clock.parse().unwrap();
                key.standard(clock, 10.0) != clock
            });
            assert_eq!(ahead, [true, false, false, true], "{text}");
            let summer: DateTime = "2026-01-01T00:30".parse().unwrap();
            assert_eq!(key.clock(summer, 10.0), summer.saturating_add(minutes(1.0)), "{text}");
        }
    }

    #[test]
    fn named_days_are_those_of_any_year() {
        let typed = key("[\"2026-04-01\", \"2026-09-30\"]").unwrap();
        assert_eq!(typed, key("[\"04-01\", \"09-30\"]").unwrap());
        assert_eq!(standard(typed, "1961-06-21T12:00", -5.0), "06-21 11:00");
        assert_eq!(toml::Value::try_from(typed).unwrap().to_string(), "[\"04-01\", \"09-30\"]");
        for (rule, name) in RULES {
            assert_eq!(
                (key(&format!("\"{name}\"")), toml::Value::try_from(rule).unwrap().as_str()),
                (Ok(rule), Some(name))
            );
        }
    }

    #[test]
    fn what_is_no_rule_says_what_would_be_one() {
        for text in ["\"summer\"", "[\"2026-03-29\"]", "[\"2026-02-30\", \"2026-10-25\"]", "[\"3-29\", \"10-25\"]"] {
            assert!(key(text).unwrap_err().contains("site.dst"), "{text}");
        }
    }
}
