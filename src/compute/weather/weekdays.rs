//! Days of the week of a weather file. A typical year is spliced of months of several years, each with its own
//! weekdays: one running calendar keeps five working days in every seven.

use super::record::{Record, Weather};

/// Length of a day. \[s\]
const DAY: i64 = 86_400;

impl Weather {
    /// Returns the day of the week of every record, 0 (Monday) … 6 (Sunday): that of its date where all dates belong to
    /// one calendar; in a year spliced of several, that of a running calendar, which begins with the weekday that the
    /// file states, else with that of the first record's date.
    pub fn weekdays(&self) -> Vec<u8> {
        let Some(first) = self.records.first() else { return Vec::new() };
        let stated = self.first_weekday.filter(|_| self.is_spliced());
        // Counted from middles, since an interval may begin on the day before.
        let middle = i64::from(first.start) + 30 * i64::from(self.interval);
        let mut seconds = DAY * i64::from(stated.unwrap_or_else(|| first.day.weekday())) + middle;
        let mut weekdays = Vec::with_capacity(self.records.len());
        let mut before = first;
        for record in &self.records {
            seconds += before.seconds_to(record);
            weekdays.push(seconds.div_euclid(DAY).rem_euclid(7) as u8);
            before = record;
        }
        weekdays
    }

    /// Whether the dates of successive records belong to different calendars, as in typical years.
    pub fn is_spliced(&self) -> bool {
        let own = |a: &Record, b: &Record| b.day.number() - a.day.number();
        let half = 30 * i64::from(self.interval);
        let on_day = |a: &Record, b: &Record| (i64::from(a.start) + half + a.seconds_to(b)).div_euclid(DAY);
        self.records.windows(2).any(|pair| own(&pair[0], &pair[1]) != on_day(&pair[0], &pair[1]))
    }
}
