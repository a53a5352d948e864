//! Contradictions within a weather file: global, direct and diffuse irradiances that do not belong together, another
//! unit than W/m², a clock that belongs to no place.
//!
//! Nothing is changed here: only the author of the file knows which of two values is wrong.

use super::count::Count;
use super::record::{Closure, MAX_RMS, Quantity, Station, Weather};
use super::sun_path::{SunPath, SunPathError};
use crate::compute::btdf::{Finding, Severity};
use crate::compute::sky::perez::SOLAR_CONSTANT;

/// Code of the finding that direct normal irradiances are those on the horizontal plane.
pub(super) const DIRECT_HORIZONTAL: &str = "direct-horizontal";
/// Altitude of the sun above which a row has to satisfy global = diffuse + direct · sin h: below it sunrise falls into
/// the interval. \[°\] In half an hour the sun climbs by up to 7.5°.
const ROW_ALTITUDE: f64 = 10.0;
/// Largest residual global − diffuse − direct · sin h that a row may have: in four measured and modelled years no row
/// with such a sun leaves more than 25, and a sun that is 10 min off leaves up to 40. \[W/m²\]
const MAX_REST: f64 = 150.0;
/// Direct irradiance from which a row of the file counts as sunny. \[W/m²\] Chosen: rounding of three values, 1.5 W/m²,
/// is 3 % of it; no test depends on its exact value.
const SUNNY: f64 = 50.0;
/// Minimum number of sunny rows from which a finding about all of them is derived. Chosen; no test depends on its exact
/// value.
const MIN_ROWS: usize = 10;
/// Largest residual global − diffuse − direct that counts as 0: \[W/m²\], above the rounding of three values (3 · 0.5),
/// and as a share of direct, of which the larger applies.
const SAME: (f64, f64) = (2.0, 0.005);
/// Rms residual of global − diffuse − direct · sin h above which the direct values are not taken for normal
/// irradiances, when global − diffuse = direct holds instead. \[W/m²\] Files of measured and modelled years leave 0.5
/// to 5.7 at their best clock, see [`MAX_RMS`].
const NOT_NORMAL: f64 = 10.0;
/// Altitude of the sun above which a clear atmosphere transmits more than half of the sun's radiation: at 20° 55 % with
/// a Linke turbidity of 4 (Ineichen & Perez 2002). \[°\]
const CLEAR_ALTITUDE: f64 = 20.0;
/// Maximum share of diffuse in global irradiance under a clear sky: 0.41 at an altitude of 20° with a Linke turbidity
/// of 5, and less with a higher sun (Ineichen & Perez 2002).
const CLEAR_DIFFUSE: f64 = 0.4;
/// Minimum clearness index (global over extraterrestrial horizontal irradiance) of the brightest clear row of a file
/// whose unit is W/m²: in five measured and modelled years that of any month has 0.59 or more.
const MIN_CLEARNESS: f64 = 0.5;
/// Largest difference between standard time and mean solar time that a country may have; the largest is 3.2 h in the
/// west of China. \[h\]
const MAX_FROM_SUN: f64 = 3.5;
/// Latitude, north and south, beyond which clocks do not follow the sun. \[°\] Chosen: affects a warning only.
const POLAR: f64 = 80.0;

/// Sums over the rows of a weather file with the sun above [`ROW_ALTITUDE`], from which contradictions are found.
#[derive(Default)]
struct Balance {
    /// Number of rows with direct sun and all three irradiances.
    sunny: usize,
    /// Number of sunny rows with global − diffuse = direct: direct values on the horizontal plane instead of normal
    /// ones.
    flat: usize,
    /// Sum over the sunny rows of the squared residual of global − diffuse − direct · sin h. \[W²/m⁴\]
    squares: f64,
    /// Rows whose residual global − diffuse − direct · sin h is larger than [`MAX_REST`].
    open: Count,
    /// Largest absolute residual of a row. \[W/m²\]
    rest: f64,
    /// Number of rows with little diffuse light under a high sun.
    clear: usize,
    /// Largest clearness index (global over extraterrestrial horizontal irradiance) of the rows that `clear` counts.
    clearness: f64,
}

impl Weather {
    /// Returns findings about contradictions between the file's values, its unit, its clock and its location;
    /// `closure`: result of the test of its clock.
    pub(super) fn contradictions(&self, closure: Option<Closure>) -> Result<Vec<Finding>, SunPathError> {
        let mut findings = Vec::new();
        check_zone(&self.station, &mut findings);
        if self.quantity == Quantity::NormalIrradiance {
            self.balance(closure)?.say(self, &mut findings);
        }
        Ok(findings)
    }

    /// Sums up the rows with the sun above [`ROW_ALTITUDE`], with the clock offset that `closure` found best.
    fn balance(&self, closure: Option<Closure>) -> Result<Balance, SunPathError> {
        // A clock that is off is said elsewhere, once and not for every row.
        let moved = closure.filter(|one| self.tested.is_none() && one.is_off()).map_or(0.0, |one| one.best_offset);
        let [least, clear] = [ROW_ALTITUDE, CLEAR_ALTITUDE].map(|degrees| degrees.to_radians().sin());
        let mut path = SunPath::new(&self.station);
        let mut balance = Balance::default();
        for record in &self.records {
            let (Some(direct), Some(diffuse)) = (record.direct, record.diffuse) else { continue };
            if direct + diffuse + record.global.unwrap_or(0.0) < SUNNY {
                continue;
            }
            path.turn_to(record.day.number())?;
            let sine = path.at(record.middle_minutes(self.interval, self.clock + moved)).z;
            if sine < least {
                continue;
            }
            let global = record.global.unwrap_or(diffuse + direct * sine);
            let rest = global - diffuse - direct * sine;
            if rest.abs() > MAX_REST {
                balance.open.add(record);
            }
            balance.rest = balance.rest.max(rest.abs());
            if direct >= SUNNY && record.global.is_some() {
                balance.sunny += 1;
                balance.flat += usize::from((global - diffuse - direct).abs() <= SAME.0 + SAME.1 * direct);
                balance.squares += rest * rest;
            }
            if sine > clear && diffuse < CLEAR_DIFFUSE * global {
                balance.clear += 1;
                let outside = SOLAR_CONSTANT * record.day.eccentricity() * sine;
                balance.clearness = balance.clearness.max(global / outside);
            }
        }
        Ok(balance)
    }
}

impl Balance {
    /// Adds to `findings` the contradictions that the sums show.
    fn say(&self, weather: &Weather, findings: &mut Vec<Finding>) {
        let rms = (self.squares / self.sunny.max(1) as f64).sqrt();
        if self.sunny >= MIN_ROWS && 100 * self.flat >= 99 * self.sunny && rms > NOT_NORMAL {
            let message = format!(
                "{} = global − diffuse in {} of {} rows with sun, while global − diffuse − direct · sin h leaves {rms:.0} W/m²: \
                 it is the direct irradiance on the horizontal plane; expected that on a plane facing the sun, 1 / sin h \
                 times as much",
                weather.field_names[0], self.flat, self.sunny
            );
            findings.push(Finding::warning(DIRECT_HORIZONTAL, message));
        } else if self.open.number > 0 {
            let message = format!(
                "global − diffuse − direct · sin h is off by more than {MAX_REST} W/m² with the sun more than {ROW_ALTITUDE}° above \
                 the horizon, by {:.0} W/m² at most: {}; one of the three irradiances is wrong there, or the clock",
                self.rest,
                self.open.words()
            );
            findings.push(Finding::warning("not-closed", message));
        } else if self.sunny >= MIN_ROWS && rms > MAX_RMS {
            let message = format!(
                "global − diffuse − direct · sin h leaves {rms:.0} W/m² in {} rows with the sun more than {ROW_ALTITUDE}° above the \
                 horizon: the irradiances contradict each other",
                self.sunny
            );
            findings.push(Finding::warning("not-closed", message));
        }
        if weather.interval < 60 && self.clear >= MIN_ROWS && self.clearness < MIN_CLEARNESS {
            let minutes = weather.interval;
            let message = format!(
                "with the sun more than {CLEAR_ALTITUDE}° above the horizon and little diffuse light no row has more than {:.0} % of \
                 the irradiance outside the atmosphere: the unit is Wh/m² of {minutes} min, it seems, and is read as W/m²; \
                 expected {} times as much",
                100.0 * self.clearness,
                60.0 / f64::from(minutes)
            );
            findings.push(Finding::warning("unit-watt-hours", message));
        }
    }
}

/// Adds a finding about a clock that does not belong to any time zone, or that is far from solar time.
fn check_zone(station: &Station, findings: &mut Vec<Finding>) {
    let (offset, sun) = (station.utc_offset, station.longitude / 15.0);
    let nearest = (4.0 * offset).round() / 4.0;
    if (offset - nearest).abs() > 1e-3 {
        let message = format!(
            "UTC{offset:+.3} h is the clock of no time zone, which are multiples of a quarter of an hour (3.75° of the \
             meridian): the nearest is UTC{nearest:+} h with the meridian of {}°",
            15.0 * nearest
        );
        // The mean time of the place itself is a choice.
        let severity = if (offset - sun).abs() < 0.01 { Severity::Info } else { Severity::Warning };
        findings.push(Finding { severity, code: "zone", message });
    }
    let difference = (offset - sun + 12.0).rem_euclid(24.0) - 12.0;
    if difference.abs() > MAX_FROM_SUN && station.latitude.abs() < POLAR {
        let message = format!(
            "the clock of UTC{:+} h is {:.1} h {} that of the sun at longitude {}°: longitude or time zone has the wrong \
             sign, or rows are by UTC",
            (1000.0 * offset).round() / 1000.0,
            difference.abs(),
            if difference > 0.0 { "ahead of" } else { "behind" },
            station.longitude
        );
        findings.push(Finding::warning("zone", message));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::weather::{Day, Hour, Reading, Record};

    /// A clear day in records of `interval` minutes, on the meridian of its zone: 800 W/m² of direct normal and 100
    /// W/m² of diffuse irradiance, and the global one that belongs to them.
    fn clear_day(interval: u16) -> Weather {
        let station = Station { latitude: 45.0, longitude: 15.0, utc_offset: 1.0, ..Station::default() };
        let day = Day::new(2018, 6, 21).unwrap();
        let mut path = SunPath::new(&station);
        path.turn_to(day.number()).unwrap();
        let records = (0..1440 / interval).map(|k| {
            let start = 60 * i32::from(k) * i32::from(interval);
            let sine = path.at(f64::from(start) / 60.0 + 0.5 * f64::from(interval)).z;
            let [direct, diffuse] = if sine > 0.0 { [800.0, 100.0] } else { [0.0, 0.0] };
            Record {
                day,
                start,
                direct: Some(direct),
                diffuse: Some(diffuse),
                global: Some(diffuse + direct * sine.max(0.0)),
                dew_point: None,
                direct_illuminance: None,
                diffuse_illuminance: None,
                line: u32::from(k) + 9,
            }
        });
        Weather {
            format: "made",
            station,
            quantity: Quantity::NormalIrradiance,
            interval,
            clock: 0.0,
            tested: None,
            first_weekday: None,
            records: records.collect(),
            findings: Vec::new(),
            field_names: ["direct", "diffuse"],
        }
    }

    /// Messages of the findings of one code.
    fn messages(weather: &Weather, code: &str) -> Vec<String> {
        let findings = weather.examine().unwrap().findings;
        findings.into_iter().filter(|finding| finding.code == code).map(|finding| finding.message).collect()
    }

    #[test]
    fn days_that_close_are_not_blamed() {
        for interval in [1, 10, 15, 30, 60] {
            let weather = clear_day(interval);
            for code in ["not-closed", DIRECT_HORIZONTAL, "unit-watt-hours", "zone", "clock-off"] {
                assert_eq!(messages(&weather, code).len(), 0, "{interval} {code}");
            }
        }
    }

    #[test]
    fn direct_on_the_horizontal_is_told_by_every_row() {
        let mut weather = clear_day(15);
        for record in &mut weather.records {
            record.direct = Some(record.global.unwrap() - record.diffuse.unwrap());
        }
        let said = messages(&weather, DIRECT_HORIZONTAL);
        assert!(said[0].contains("direct = global − diffuse in"), "{said:?}");
        let summary = weather.examine().unwrap();
        assert_eq!((summary.closure, messages(&weather, "clock-off").len()), (None, 0));
        assert_eq!((messages(&weather, "not-closed").len(), messages(&weather, "clock-untested").len()), (0, 0));
    }

    #[test]
    fn a_row_that_does_not_close_is_named() {
        let mut weather = clear_day(15);
        weather.records[48].global = Some(weather.records[48].global.unwrap() + 300.0);
        let said = messages(&weather, "not-closed");
        assert!(said[0].contains("by 300 W/m² at most: 1 row, first in line 57"), "{said:?}");
        // Rows that are all a little off, in both senses.
        let mut weather = clear_day(15);
        for (k, record) in weather.records.iter_mut().enumerate() {
            let rest = if k % 2 == 0 { 60.0 } else { -60.0 };
            record.global = record.global.map(|global| (global + rest).max(0.0));
        }
        let said = messages(&weather, "not-closed");
        assert!(said[0].contains("leaves 60 W/m² in"), "{said:?}");
        // At sunrise a row may be anything.
        let mut weather = clear_day(15);
        let first = weather.records.iter().position(|record| record.direct > Some(0.0)).unwrap();
        weather.records[first].global = Some(400.0);
        assert_eq!(messages(&weather, "not-closed").len(), 0);
    }

    #[test]
    fn watt_hours_of_short_rows_are_told_by_their_sums() {
        for interval in [10, 15, 30] {
            let mut weather = clear_day(interval);
            let share = f64::from(interval) / 60.0;
            for record in &mut weather.records {
                for value in [&mut record.direct, &mut record.diffuse, &mut record.global] {
                    *value = value.map(|value| share * value);
                }
            }
            let said = messages(&weather, "unit-watt-hours");
            assert!(said[0].contains(&format!("Wh/m² of {interval} min")), "{said:?}");
        }
    }

    #[test]
    fn clocks_of_no_place_are_told() {
        for (longitude, utc_offset, told) in [
            (77.2, 5.5, 0),
            (85.3, 5.75, 0),
            (77.2, 82.0 / 15.0, 1),
            // The west of China, and the islands at the date line.
            (76.0, 8.0, 0),
            (-157.4, 14.0, 0),
            (74.0, -5.0, 1),
            (-74.0, 5.0, 1),
        ] {
            let mut findings = Vec::new();
            check_zone(&Station { longitude, utc_offset, latitude: 30.0, ..Station::default() }, &mut findings);
            assert_eq!(findings.len(), told, "{longitude} {utc_offset}");
        }
        let mut findings = Vec::new();
        check_zone(&Station { longitude: 9.18, utc_offset: 9.18 / 15.0, ..Station::default() }, &mut findings);
        assert_eq!(findings[0].severity, Severity::Info);
    }

    #[test]
    fn what_two_irradiances_tell_is_computed() {
        let light = |weather: &Weather| -> Vec<Hour> {
            weather.hours(Reading::default()).unwrap().map(|hour| hour.unwrap()).collect()
        };
        let whole = clear_day(10);
        let full = light(&whole);
        let (mut no_direct, mut no_diffuse) = (whole.clone(), whole.clone());
        no_direct.records.iter_mut().for_each(|record| record.direct = None);
        no_diffuse.records.iter_mut().for_each(|record| record.diffuse = None);
        for (k, hour) in light(&no_direct).iter().enumerate().filter(|(k, _)| full[*k].lit == 1.0) {
            let altitude = hour.sun.altitude().to_degrees();
            let (direct, diffuse) = (hour.direct_normal_irradiance, hour.diffuse_horizontal_irradiance);
            if altitude < 5.0 {
                assert_eq!((direct, Some(diffuse)), (0.0, whole.records[k].global));
            } else {
                assert!((direct - 800.0).abs() < 1e-9 && diffuse == 100.0, "{altitude}: {direct} {diffuse}");
            }
        }
        for (hour, full) in light(&no_diffuse).iter().zip(&full).filter(|(_, full)| full.lit == 1.0) {
            assert!((hour.diffuse_horizontal_irradiance - full.diffuse_horizontal_irradiance).abs() < 1e-9);
            assert_eq!(hour.direct_normal_irradiance, 800.0);
        }
        for (weather, code) in [(&no_direct, "direct-computed"), (&no_diffuse, "diffuse-computed")] {
            assert_eq!((messages(weather, code).len(), messages(weather, "light-missing").len()), (1, 0));
            assert_eq!(weather.examine().unwrap().closure, None);
        }
        // The parts of an interval have its irradiances.
        let mut hours = no_direct.hours(Reading::default()).unwrap();
        let parts = [0, 1].map(|part| hours.part(72, part, 2).unwrap().direct_normal_irradiance);
        assert!(parts.iter().all(|direct| (direct - 800.0).abs() < 1e-9), "{parts:?}");
    }
}
