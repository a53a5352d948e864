//! Content of a weather file in numbers: the station, and a record for every interval.

use super::calendar::Day;
use crate::compute::btdf::Finding;

/// Weather station: location of the records and time zone of their clock.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Station {
    /// Name of the place.
    pub name: String,
    /// State or province of the place.
    pub region: String,
    /// Country of the place.
    pub country: String,
    /// Source of the data: institution that measured or modelled them, and the station's number.
    pub source: String,
    /// Latitude, north positive. \[°\]
    pub latitude: f64,
    /// Longitude, east positive. \[°\]
    pub longitude: f64,
    /// UTC offset of local standard time, positive ahead of UTC. \[h\]
    pub utc_offset: f64,
    /// Elevation of the station above sea level. \[m\]
    pub elevation: f64,
}

/// Physical quantities of a record's direct and diffuse values.
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
    /// Returns the names of the two quantities with their unit, as text for messages.
    pub const fn words(self) -> &'static str {
        match self {
            Self::NormalIrradiance => "direct normal and diffuse horizontal irradiance, W/m²",
            Self::HorizontalIrradiance => "direct horizontal and diffuse horizontal irradiance, W/m²",
            Self::NormalIlluminance => "direct normal and diffuse horizontal illuminance, lx",
        }
    }
}

/// Value of a record that may be missing, named in messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Field {
    /// Direct value, of the sun.
    Direct,
    /// Diffuse value, of the sky.
    Diffuse,
}

/// Weather data of one interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Record {
    /// Day that holds the interval's middle, in local standard time; the year is the row's own.
    pub day: Day,
    /// Begin of the interval, as time after the midnight with which `day` begins; negative for an interval that
    /// contains that midnight. \[s\]
    pub start: i32,
    /// Direct value of the sun, in the quantity and unit of [`Weather::quantity`]; `None` where the file marks it as
    /// missing.
    pub direct: Option<f64>,
    /// Diffuse value of the sky on the horizontal plane, in the unit of [`Weather::quantity`]; `None` where the file
    /// marks it as missing.
    pub diffuse: Option<f64>,
    /// Global horizontal irradiance; `None` where the file has none. \[W/m²\]
    pub global: Option<f64>,
    /// Dew point of the air; `None` where the file has none. \[°C\]
    pub dew_point: Option<f64>,
    /// Direct normal illuminance that the file states beside the irradiance; `None` where it has none. \[lx\]
    pub direct_illuminance: Option<f64>,
    /// Diffuse horizontal illuminance that the file states beside the irradiance; `None` where it has none. \[lx\]
    pub diffuse_illuminance: Option<f64>,
    /// Line of the file from which the record was read, from 1.
    pub line: u32,
}

/// Test of a weather file's clock: rms of the residual global − diffuse − direct · sin h (h: altitude of the sun) over
/// the hours with sun, at several clock offsets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closure {
    /// Rms residual with the intervals at the times that the file states. \[W/m²\]
    pub rms: f64,
    /// Clock offset with the smallest rms residual of all offsets tried; positive if the intervals lie later than the
    /// file states. \[min\]
    pub best_offset: f64,
    /// Rms residual at `best_offset`. \[W/m²\]
    pub best_rms: f64,
}

/// Maximum rms residual global − diffuse − direct · sin h of irradiances that are consistent with each other: files of
/// measured and modelled years leave 0.5 to 5.7 W/m² at their best clock. \[W/m²\]
pub(super) const MAX_RMS: f64 = 30.0;

impl Closure {
    /// Whether global = diffuse + direct · sin h holds at one of the clock offsets tried, within an rms residual of 30
    /// W/m².
    pub fn closes(&self) -> bool {
        self.best_rms <= MAX_RMS
    }

    /// Whether the file's clock disagrees with its irradiances: another offset, by 20 minutes or more, reduces the rms
    /// residual by 10 W/m² or more.
    pub fn is_off(&self) -> bool {
        self.best_offset.abs() >= 20.0 && self.rms - self.best_rms >= 10.0
    }
}

/// Content of a weather file: station, quantities, and one record per interval.
#[derive(Debug, Clone, PartialEq)]
pub struct Weather {
    /// Name of the file's format, e.g. "EPW".
    pub format: &'static str,
    /// Station of the records.
    pub station: Station,
    /// Quantities of the records' direct and diffuse values.
    pub quantity: Quantity,
    /// Length of the interval of every record. \[min\]
    pub interval: u16,
    /// Offset by which all intervals lie later than the records state, as the file itself specifies it. \[min\]
    pub clock: f64,
    /// Result of the test of the file's clock, stored where the file specifies an offset: the test was made when the
    /// offset was found, with global irradiances that this file no longer contains.
    pub tested: Option<Closure>,
    /// Day of the week on which the records begin, as the file states it; 0 (Monday) … 6 (Sunday).
    pub first_weekday: Option<u8>,
    /// Records in the file's order; at least one.
    pub records: Vec<Record>,
    /// Findings of the reader of the file.
    pub findings: Vec<Finding>,
    /// Names that the file gives to its direct and diffuse fields.
    pub field_names: [&'static str; 2],
}

impl Weather {
    /// Returns the index of the record whose interval contains the given month, day and second of the day, in local
    /// standard time; of several (in a file of several years) the first. `None` if no interval does.
    pub fn find(&self, month: u8, day: u8, second: u32) -> Option<usize> {
        let second = i32::try_from(second).ok()?;
        self.records.iter().position(|record| record.holds(self.interval, (month, day), second))
    }

    /// Returns the name that the file gives to its direct or diffuse field.
    pub const fn field_name(&self, field: Field) -> &'static str {
        match field {
            Field::Direct => self.field_names[0],
            Field::Diffuse => self.field_names[1],
        }
    }

    /// Returns the calendar years of the records, each once, in rising order.
    pub fn years(&self) -> Vec<i16> {
        let mut years: Vec<i16> = self.records.iter().map(|record| record.day.year).collect();
        years.sort_unstable();
        years.dedup();
        years
    }
}

/// Length of a day. \[s\]
const DAY: i32 = 86_400;

/// Returns the length of an interval of `minutes`. \[s\]
fn seconds(minutes: u16) -> i32 {
    60 * i32::from(minutes)
}

impl Record {
    /// Whether the record's interval, `interval` minutes long, contains second `second` of the day `date` (month, day).
    fn holds(&self, interval: u16, date: (u8, u8), second: i32) -> bool {
        let within = |day: Day, second: i32| {
            (self.start..self.start + seconds(interval)).contains(&second) && (day.month, day.day) == date
        };
        within(self.day, second)
            || (self.start < 0 && within(self.day.previous(), second - DAY))
            || (self.start + seconds(interval) > DAY && within(self.day.next(), second + DAY))
    }

    /// Returns the time from the begin of this record's interval to that of a later one. \[s\]
    ///
    /// Typical years are spliced of months of several years: years count only where both are the same, or follow each
    /// other.
    pub fn seconds_to(&self, later: &Self) -> i64 {
        let day = i64::from(DAY);
        let begin = |record: &Self, year: i16| day * Day { year, ..record.day }.number() + i64::from(record.start);
        let whole = begin(later, later.day.year) - begin(self, self.day.year);
        if self.day.year == later.day.year {
            return whole;
        }
        // A common year for both; the new one after the old one's end.
        let mut spliced = begin(later, 2001) - begin(self, 2001);
        if (self.day.month, self.day.day) > (later.day.month, later.day.day) {
            spliced += day * 365;
        }
        if whole >= 0 && whole < spliced { whole } else { spliced }
    }

    /// Returns day, begin and end of the record's interval, `interval` minutes long, as text in local standard time:
    /// `2005-06-21 12:00–13:00`.
    pub fn label(&self, interval: u16) -> String {
        let clock = |second: i32| {
            let minutes = format!("{:02}:{:02}", second / 3600, second / 60 % 60);
            if second % 60 == 0 { minutes } else { format!("{minutes}:{:02}", second % 60) }
        };
        let end = self.start + seconds(interval);
        let end = clock(if end > DAY { end - DAY } else { end });
        if self.start < 0 {
            format!("{} {}–{end}", self.day.previous(), clock(self.start + DAY))
        } else {
            format!("{} {}–{end}", self.day, clock(self.start))
        }
    }

    /// Returns the middle of the record's interval, `interval` minutes long, plus `offset` \[min\], in minutes after
    /// the midnight with which its day begins.
    pub fn middle_minutes(&self, interval: u16, offset: f64) -> f64 {
        f64::from(self.start) / 60.0 + 0.5 * f64::from(interval) + offset
    }

    /// Returns the middle of part number `part` (from 0) of `parts` equal parts of the record's interval, `interval`
    /// minutes long, in seconds after the midnight with which its day begins.
    pub fn middle_seconds(&self, interval: u16, part: u32, parts: u32) -> f64 {
        f64::from(self.start) + 60.0 * f64::from(interval) * (f64::from(part) + 0.5) / f64::from(parts)
    }

    /// Returns the middle of the record's interval, `interval` minutes long and without clock offset, as text:
    /// `2005-06-21T12:30:00`, local standard time.
    pub fn middle(&self, interval: u16) -> String {
        let second = self.start + seconds(interval) / 2;
        format!("{}T{:02}:{:02}:{:02}", self.day, second / 3600, second / 60 % 60, second % 60)
    }
}
