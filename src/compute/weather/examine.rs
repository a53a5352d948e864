//! Examination of a weather file: period, gaps, clock, light with the sun down, sums.

use super::contradictions::DIRECT_HORIZONTAL;
use super::count::Count;
use super::hour::{HIGH_SUN, HourError, LightSource, MIN_ALTITUDE, Reading, SunOffset};
use super::record::{Closure, Field, Quantity, Weather};
use super::sun_path::SunPath;
use crate::compute::btdf::Finding;

/// Sums over all records of a weather file: irradiations in kWh/m², luminous exposures (illuminance times time) in
/// klx·h.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sums {
    /// Global horizontal irradiation by the file's global irradiances; records without one count as 0. \[kWh/m²\]
    pub global: f64,
    /// Direct irradiation on a plane that always faces the sun (direct normal). \[kWh/m²\]
    pub direct_normal: f64,
    /// Diffuse irradiation of the sky on the horizontal plane. \[kWh/m²\]
    pub diffuse: f64,
    /// Sum of diffuse horizontal illuminance times duration. \[klx·h\]
    pub diffuse_light: f64,
    /// Sum of the sun's illuminance on a plane that always faces it (direct normal) times duration. \[klx·h\]
    pub direct_light: f64,
    /// Sum of global horizontal illuminance times duration. \[klx·h\]
    pub global_light: f64,
}

/// Summary of a weather file: sums, counts of records, the test of its clock, and findings.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Sums of irradiation and luminous exposure over all records.
    pub sums: Sums,
    /// Total duration of the records with sunlight or skylight. \[h\]
    pub lit_hours: f64,
    /// Total duration of sunshine: records with a direct normal irradiance of 120 W/m² or more (WMO). \[h\]
    pub sunshine_hours: f64,
    /// Number of records for which the file has plausible illuminances.
    pub with_illuminances: usize,
    /// Number of records with light of the sun but a diffuse horizontal irradiance of 0.
    pub without_sky: usize,
    /// Number of intervals without a record between the first and the last record.
    pub missing: usize,
    /// Test of the file's clock against its irradiances; `None` where they do not allow it.
    pub closure: Option<Closure>,
    /// Findings of the file's reader, followed by those of the examination.
    pub findings: Vec<Finding>,
}

/// Direct normal irradiance from which a record counts as sunshine (WMO). \[W/m²\]
const SUNSHINE: f64 = 120.0;
/// Direct irradiance above which a record with the sun below the horizon points to a wrong clock. \[W/m²\] Chosen:
/// affects a warning only; two years with a wrong clock have 37 and 65 rows above it with the sun down.
const BEAM_AT_NIGHT: f64 = 50.0;
/// Number of rows for each of which one row with direct irradiance at night is tolerated: such a row may stem from the
/// sunset of a day in another year and is not evidence against the clock. Chosen: affects a warning only; of the 8,760
/// rows of a year 8 are tolerated.
const STRAY: usize = 1000;

/// Whether a number of days is that of whole years, with their leap days or without.
fn are_years(days: usize) -> bool {
    let years = days / 365;
    years > 0 && days % 365 <= years.div_ceil(4)
}

impl Weather {
    /// Examines all records and sums them up.
    ///
    /// # Errors
    /// Returns an error if the sun's position cannot be computed.
    pub fn examine(&self) -> Result<Summary, HourError> {
        let closure = match self.tested {
            Some(tested) => Some(tested),
            None => self.closure()?,
        };
        let mut findings = self.findings.clone();
        let missing = self.sequence(&mut findings);
        let contradictions = self.contradictions(closure)?;
        // A sum that holds another quantity is not evidence about the clock.
        let testable = contradictions.iter().all(|finding| finding.code != DIRECT_HORIZONTAL);
        let closure = closure.filter(|_| testable);
        if testable {
            self.say_clock(closure, &mut findings);
        }
        findings.extend(contradictions);
        let mut summary = Summary {
            sums: Sums::default(),
            lit_hours: 0.0,
            sunshine_hours: 0.0,
            with_illuminances: 0,
            without_sky: 0,
            missing,
            closure,
            findings,
        };
        self.sum_up(&mut summary)?;
        Ok(summary)
    }

    /// Adds findings about gaps and repetitions, and returns the number of missing intervals.
    fn sequence(&self, findings: &mut Vec<Finding>) -> usize {
        let step = 60 * i64::from(self.interval);
        let (mut missing, mut gaps, mut back) = (0, Count::default(), Count::default());
        let mut first_gap = String::new();
        for pair in self.records.windows(2) {
            let (before, after) = (&pair[0], &pair[1]);
            let seconds = before.seconds_to(after);
            if seconds > step {
                if gaps.number == 0 {
                    let hours = (seconds - step) as f64 / 3600.0;
                    first_gap = format!("{hours} h between lines {} and {}", before.line, after.line);
                }
                gaps.add(after);
                missing += usize::try_from((seconds - step) / step).unwrap_or(0);
            } else if seconds < step {
                back.add(after);
            }
        }
        let rows = self.records.len();
        if gaps.number > 0 {
            let what = if gaps.number == 1 { "a gap".to_owned() } else { format!("{} gaps", gaps.number) };
            findings.push(Finding::warning("gaps", format!("{what}, the first of {first_gap}; what is there is used")));
        }
        if back.number > 0 {
            let message =
                format!("{} that begin before the row above has ended: a repeated or misplaced row", back.words());
            findings.push(Finding::warning("order", message));
        }
        let days = rows * usize::from(self.interval) / 1440;
        let whole = (rows * usize::from(self.interval)).is_multiple_of(1440) && are_years(days);
        if whole && days == 366 {
            findings.push(Finding::info("leap-year", format!("{rows} rows: a year of 366 days")));
        } else if !whole {
            let year = 365 * 1440 / usize::from(self.interval);
            let message = format!("{rows} of {year} rows of a year: what is there is used, figures of a year need all");
            findings.push(Finding::warning("partial-year", message));
        }
        missing
    }

    /// Adds findings about a clock that contradicts the file's irradiances or could not be tested.
    fn say_clock(&self, closure: Option<Closure>, findings: &mut Vec<Finding>) {
        match closure {
            Some(one) if self.tested.is_some() => {
                let message = format!(
                    "the table moves its intervals by {:+} min: there its source's irradiances close to {:.1} W/m², to {:.1} W/m² without",
                    self.clock, one.best_rms, one.rms
                );
                findings.push(Finding::info("clock-stated", message));
            }
            Some(one) if one.is_off() => {
                let message = format!(
                    "global − diffuse − direct · sin h closes to {:.1} W/m² with the intervals where the file says, to {:.1} W/m² \
                     with all of them {} min {}: sun_offset_minutes = {} moves them",
                    one.rms,
                    one.best_rms,
                    one.best_offset.abs(),
                    if one.best_offset < 0.0 { "earlier" } else { "later" },
                    one.best_offset
                );
                findings.push(Finding::warning("clock-off", message));
            }
            Some(_) => {}
            None => {
                let has_global = self.records.iter().any(|one| one.global.is_some());
                let why = if self.quantity != Quantity::NormalIrradiance || !has_global {
                    "no global horizontal irradiance beside direct normal and diffuse"
                } else if self.records.iter().all(|one| one.completion().is_some()) {
                    "direct normal or diffuse irradiance is missing in every row"
                } else {
                    "too few hours with sun"
                };
                findings.push(Finding::info("clock-untested", format!("the clock cannot be tested: {why}")));
            }
        }
    }

    /// Adds all records to the summary's sums and counts, with findings about missing values and light at the wrong
    /// time.
    fn sum_up(&self, summary: &mut Summary) -> Result<(), HourError> {
        let mut hours = self.hours(Reading { light: LightSource::File, offset: SunOffset::default() })?;
        let mut path = SunPath::new(&self.station);
        let length = f64::from(self.interval) / 60.0;
        let (mut absent, mut night, mut black) = (Count::default(), Count::default(), Count::default());
        let (mut no_direct, mut no_diffuse) = (Count::default(), Count::default());
        let (mut dew, mut lit) = (0, 0);
        let sums = &mut summary.sums;
        for (index, record) in self.records.iter().enumerate() {
            sums.global += record.global.unwrap_or(0.0) * length / 1000.0;
            if record.direct.is_some_and(|direct| direct > BEAM_AT_NIGHT) {
                path.turn_to(record.day.number())?;
                // At its highest in the interval the sun may be another quarter of an hour's way up.
                let sine = path.at(record.middle_minutes(self.interval, self.clock)).z;
                if sine < (-1.0_f64).to_radians().sin() {
                    night.add(record);
                }
            }
            let hour = match hours.at(index) {
                Ok(hour) => hour,
                Err(HourError::Missing { .. }) => {
                    absent.add(record);
                    continue;
                }
                Err(error) => return Err(error),
            };
            if hour.lacks_sky() {
                black.add(record);
            }
            if !hour.is_lit() {
                continue;
            }
            match record.completion() {
                Some(Field::Direct) => no_direct.add(record),
                Some(Field::Diffuse) => no_diffuse.add(record),
                None => {}
            }
            lit += 1;
            dew += usize::from(record.dew_point.is_some());
            summary.with_illuminances += usize::from(hour.light == LightSource::File);
            summary.without_sky += usize::from(hour.diffuse_horizontal_irradiance == 0.0);
            summary.lit_hours += length;
            if hour.direct_normal_irradiance >= SUNSHINE {
                summary.sunshine_hours += length;
            }
            sums.direct_normal += hour.direct_normal_irradiance * length / 1000.0;
            sums.diffuse += hour.diffuse_horizontal_irradiance * length / 1000.0;
            let beam = hour.direct_normal * hour.sun.vector().z.max(0.0);
            sums.diffuse_light += hour.diffuse_horizontal * length / 1000.0;
            sums.direct_light += hour.direct_normal * length / 1000.0;
            sums.global_light += (hour.diffuse_horizontal + beam) * length / 1000.0;
        }
        let findings = &mut summary.findings;
        if absent.number > 0 {
            let message = format!(
                "direct or diffuse light is missing by day: {}; these hours cannot be computed, and no figures of a year",
                absent.words()
            );
            findings.push(Finding::warning("light-missing", message));
        }
        if no_direct.number > 0 {
            let message = format!(
                "direct normal irradiance is missing and computed as (global − diffuse) / sin h, with the sun less than \
                 {MIN_ALTITUDE}° above the horizon as 0 under a sky that sends all: {}",
                no_direct.words()
            );
            findings.push(Finding::info("direct-computed", message));
        }
        if no_diffuse.number > 0 {
            let rows = no_diffuse.words();
            let message = format!("diffuse irradiance is missing and computed as global − direct · sin h: {rows}");
            findings.push(Finding::info("diffuse-computed", message));
        }
        if night.number > self.records.len() / STRAY {
            let message = format!(
                "more than {BEAM_AT_NIGHT} W/m² from a sun that is more than 1° below the horizon: {}; the clock is off, or longitude or \
                 time zone has the wrong sign",
                night.words()
            );
            findings.push(Finding::warning("sun-down-light", message));
        }
        if black.number > 0 {
            let message = format!(
                "no diffuse light with the sun more than {HIGH_SUN}° above the horizon: {}; their sky is black",
                black.words()
            );
            findings.push(Finding::warning("black-sky", message));
        }
        let low = summary.without_sky.saturating_sub(black.number);
        if low > 0 {
            let message = format!("{low} rows with a low sun and a diffuse part of 0: their sky is dark");
            findings.push(Finding::info("dark-sky", message));
        }
        if dew == 0 && lit > 0 {
            let message = "no dew points: luminous efficacies are those of 2 cm of water in the air";
            findings.push(Finding::info("dew-point-missing", message));
        }
        if self.quantity != Quantity::NormalIlluminance && summary.with_illuminances < lit {
            let rows = lit - summary.with_illuminances;
            let message = format!(
                "{rows} of {lit} lit rows without plausible illuminances: light = \"file\" takes luminous efficacy there"
            );
            findings.push(Finding::info("illuminance-missing", message));
        }
        Ok(())
    }
}
