//! What a weather file tells, as numbers: the station, and a record for every interval.

use super::calendar::Day;
use crate::compute::btdf::Finding;

/// Where the records belong, and whose clock counts.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Station {
    /// Name of the place.
    pub name: String,
    /// State or province.
    pub region: String,
    /// Country.
    pub country: String,
    /// Who measured or modelled, and the station's number.
    pub source: String,
    /// \[°\], north positive.
    pub latitude: f64,
    /// \[°\], east positive.
    pub longitude: f64,
    /// Hours that local standard time is ahead of UTC.
    pub utc_offset: f64,
    /// Above the sea. \[m\]
    pub elevation: f64,
}

/// What the two figures of light in a record are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Quantity {
    /// Direct normal and diffuse horizontal irradiance. \[W/m²\]
    #[default]
    NormalIrradiance,
    /// Direct *horizontal* and diffuse horizontal irradiance. \[W/m²\]
    HorizontalIrradiance,
    /// Direct normal and diffuse horizontal illuminance. \[lx\]
    NormalIlluminance,
}

impl Quantity {
    /// In words, with the unit.
    pub const fn words(self) -> &'static str {
        match self {
            Self::NormalIrradiance => "direct normal and diffuse horizontal irradiance, W/m²",
            Self::HorizontalIrradiance => "direct horizontal and diffuse horizontal irradiance, W/m²",
            Self::NormalIlluminance => "direct normal and diffuse horizontal illuminance, lx",
        }
    }
}

/// A figure of a record, for messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Field {
    /// The sun's.
    Direct,
    /// The sky's.
    Diffuse,
}

/// One interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Record {
    /// The day on which it begins, the row's own year.
    pub day: Day,
    /// Minutes from midnight of local standard time to its begin.
    pub start: u16,
    /// Of the sun, see [`Quantity`]; `None` where the file has a missing code.
    pub direct: Option<f64>,
    /// Of the sky, see [`Quantity`]; `None` where the file has a missing code.
    pub diffuse: Option<f64>,
    /// Global horizontal irradiance. \[W/m²\]
    pub global: Option<f64>,
    /// Dew point. \[°C\]
    pub dew_point: Option<f64>,
    /// Direct normal illuminance beside an irradiance. \[lx\]
    pub direct_illuminance: Option<f64>,
    /// Diffuse horizontal illuminance beside an irradiance. \[lx\]
    pub diffuse_illuminance: Option<f64>,
    /// Line of the file, from 1.
    pub line: u32,
}

/// What is left over in global − diffuse − direct · sin h, root of the mean square over the hours with sun.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closure {
    /// With the intervals where the file says that they are. \[W/m²\]
    pub rms: f64,
    /// Minutes by which the intervals lie later at the best of the places tried.
    pub best_offset: f64,
    /// There. \[W/m²\]
    pub best_rms: f64,
}

impl Closure {
    /// Does the file's clock disagree with its own irradiances: by 20 minutes and 10 W/m² or more?
    pub fn is_off(&self) -> bool {
        self.best_offset.abs() >= 20.0 && self.rms - self.best_rms >= 10.0
    }
}

/// A weather file.
#[derive(Debug, Clone, PartialEq)]
pub struct Weather {
    /// Name of the format.
    pub format: &'static str,
    /// Where.
    pub station: Station,
    /// What the records' figures of light are.
    pub quantity: Quantity,
    /// Length of every record. \[min\]
    pub interval: u16,
    /// Minutes by which all intervals lie later than the records say, as the file itself states it.
    pub clock: f64,
    /// How the clock was found where the file states one: it was tested before the global irradiances were left out.
    pub tested: Option<Closure>,
    /// Day of the week on which the records begin, as the file states it; 0 (Monday) … 6 (Sunday).
    pub first_weekday: Option<u8>,
    /// In the file's order; at least one.
    pub records: Vec<Record>,
    /// What the reader had to say.
    pub findings: Vec<Finding>,
    /// What the fields are called in the file, direct and diffuse.
    pub field_names: [&'static str; 2],
}

impl Weather {
    /// The record that holds a moment, by month, day and minute of the day: the interval that begins at or before it.
    /// The first where there are several (a file of several years).
    pub fn find(&self, month: u8, day: u8, minute: u16) -> Option<usize> {
        let length = self.interval;
        self.records.iter().position(|record| {
            (record.day.month, record.day.day) == (month, day)
                && (record.start..record.start + length).contains(&minute)
        })
    }

    /// What a field is called in the file.
    pub const fn field_name(&self, field: Field) -> &'static str {
        match field {
            Field::Direct => self.field_names[0],
            Field::Diffuse => self.field_names[1],
        }
    }

    /// Years that occur, rising.
    pub fn years(&self) -> Vec<i16> {
        let mut years: Vec<i16> = self.records.iter().map(|record| record.day.year).collect();
        years.sort_unstable();
        years.dedup();
        years
    }
}

impl Record {
    /// Minutes from the begin of this record to that of a later one. Typical years are spliced of months of several
    /// years: years count only where both are the same, or follow each other.
    pub(super) fn minutes_to(&self, later: &Self) -> i64 {
        let minutes = |record: &Self, year: i16| 1440 * Day { year, ..record.day }.number() + i64::from(record.start);
        let whole = minutes(later, later.day.year) - minutes(self, self.day.year);
        if self.day.year == later.day.year {
            return whole;
        }
        // A common year for both; the new one after the old one's end.
        let mut spliced = minutes(later, 2001) - minutes(self, 2001);
        if (self.day.month, self.day.day) > (later.day.month, later.day.day) {
            spliced += 1440 * 365;
        }
        if whole >= 0 && whole < spliced { whole } else { spliced }
    }

    /// Begin and end as clocks show them: `12:00–13:00`.
    pub fn clock_words(&self, interval: u16) -> String {
        let at = |minutes: u16| format!("{:02}:{:02}", minutes / 60, minutes % 60);
        format!("{}–{}", at(self.start), at(self.start + interval))
    }

    /// Minutes from the midnight of its day to its middle, moved by an offset.
    pub fn middle_minutes(&self, interval: u16, offset: f64) -> f64 {
        f64::from(self.start) + 0.5 * f64::from(interval) + offset
    }

    /// Seconds from the midnight of its day to the middle of a part, of `parts` equal ones.
    pub fn middle_seconds(&self, interval: u16, part: u32, parts: u32) -> f64 {
        60.0 * (f64::from(self.start) + f64::from(interval) * (f64::from(part) + 0.5) / f64::from(parts))
    }

    /// The nominal middle as `2005-06-21T12:30:00`, local standard time.
    pub fn middle(&self, interval: u16) -> String {
        let seconds = 60 * u32::from(self.start) + 30 * u32::from(interval);
        format!("{}T{:02}:{:02}:{:02}", self.day, seconds / 3600, seconds / 60 % 60, seconds % 60)
    }
}
