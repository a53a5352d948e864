//! Record of a weather file with its sun: position in the sunlit part of the interval, irradiances and illuminances.

use super::record::{Field, Quantity, Record, Weather};
use super::sun_path::{SunPath, SunPathError};
use crate::compute::direction::{Dir, World};
use crate::compute::sky::perez::{Air, PerezState, SOLAR_CONSTANT};

/// Source of the illuminances of an hour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LightSource {
    /// Illuminances computed from the file's irradiances by the luminous efficacies of Perez 1990.
    #[default]
    Efficacy,
    /// Illuminances that the file states, where it has plausible ones; else those of [`Self::Efficacy`].
    File,
}

/// Offset of the records' intervals from the times that the weather file states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SunOffset {
    /// Given offset by which the intervals lie later than the file states; negative: earlier. \[min\]
    Minutes(f64),
    /// Offset at which global = diffuse + direct · sin h (h: altitude of the sun) holds best for the file's
    /// irradiances.
    Auto,
}

impl Default for SunOffset {
    fn default() -> Self {
        Self::Minutes(0.0)
    }
}

/// Altitude of the sun above which a record without diffuse light is taken for a gap of the file: in typical years
/// (CZ2010, TMY3) rows that are dark at sunrise and sunset end at 8.6°, dark rows above are gaps. \[°\]
pub const HIGH_SUN: f64 = 10.0;

/// Altitude of the sun below which a missing direct normal irradiance is not computed from global and diffuse ones: at
/// 5° half a watt of rounding in global and diffuse irradiance causes 6 W/m², and a clock that is off by 10 min a third
/// of it. \[°\]
pub(super) const MIN_ALTITUDE: f64 = 5.0;

/// Maximum offset of the intervals, later and earlier, from the times that the file states. \[min\] Chosen: limit of
/// input; larger values are refused.
pub const WIDEST_OFFSET: f64 = 180.0;

/// Options for reading a weather file as illuminances.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reading {
    /// Source of the illuminances: the file, or its irradiances with luminous efficacies.
    pub light: LightSource,
    /// Offset of the intervals from the times that the file states.
    pub offset: SunOffset,
}

/// Reason why the light of a record of a weather file is not available.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HourError {
    /// Value that the file marks as missing although the sun is up.
    #[error(
        "line {line}: {field} is missing while the sun is up ({time}); expected a number: repair the row, or leave the hour out"
    )]
    Missing {
        /// Line of the file, from 1.
        line: u32,
        /// Name and number of the field in the file.
        field: &'static str,
        /// Day, begin and end of the interval as text, in local standard time.
        time: String,
    },
    /// Clock that cannot be tested with the file's data, so that the automatic offset is not available.
    #[error(
        "\"auto\" needs global horizontal irradiances beside direct and diffuse ones, and hours with sun: give minutes"
    )]
    NoClosure,
    /// Offset of the intervals beyond ±[`WIDEST_OFFSET`]. \[min\]
    #[error("{0} min is out of range (allowed: −180 to 180)")]
    Offset(f64),
    /// Index beyond the records of the weather file.
    #[error("there is no record {0}")]
    Index(usize),
    /// Position of the sun that cannot be computed for the record's day.
    #[error(transparent)]
    Sun(#[from] SunPathError),
}

/// Interval of a weather file with its sun, irradiances, illuminances and sky parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hour {
    /// Index of the record in the weather file.
    pub index: usize,
    /// Direction towards the sun's centre (x east, y north, z up) in the middle of that part of the interval in which
    /// it is above the horizon; if it stays below, in the middle of the interval.
    pub sun: Dir<World>,
    /// Share of the interval in which the sun's centre is above the horizon, 0 … 1.
    pub lit: f64,
    /// Direct normal irradiance, mean over the interval; 0 with the sun down. \[W/m²\]
    pub direct_normal_irradiance: f64,
    /// Diffuse horizontal irradiance, mean over the interval. \[W/m²\]
    pub diffuse_horizontal_irradiance: f64,
    /// Direct normal illuminance: by the sun on a plane that faces it, mean over the interval. \[lx\]
    pub direct_normal: f64,
    /// Diffuse horizontal illuminance: by the sky alone on an unobstructed horizontal plane, mean over the interval.
    /// \[lx\]
    pub diffuse_horizontal: f64,
    /// Source of the illuminances: the file, or its irradiances with luminous efficacies.
    pub light: LightSource,
    /// Parameters of the Perez all-weather sky; `None` without light of sun or sky.
    pub state: Option<PerezState>,
}

impl Hour {
    /// Whether sun or sky give any light in the interval.
    pub fn is_lit(&self) -> bool {
        self.direct_normal > 0.0 || self.diffuse_horizontal > 0.0
    }

    /// Whether the record has no diffuse light although the sun is high (`HIGH_SUN`): a gap of the file.
    pub fn lacks_sky(&self) -> bool {
        self.diffuse_horizontal <= 0.0 && self.sun.altitude().to_degrees() > HIGH_SUN
    }

    /// Returns the direction of the sky model's circumsolar peak (x east, y north, z up): that of the sun, or, with the
    /// sun below the horizon, the point of the horizon above it.
    pub fn sky_sun(&self) -> Dir<World> {
        if self.sun.vector().z >= 0.0 { self.sun } else { Dir::from_altitude_bearing(0.0, self.sun.bearing()) }
    }
}

/// Reader that computes sun and light of a weather file's records one by one; consecutive records are cheap.
#[derive(Debug, Clone)]
pub struct Hours<'a> {
    weather: &'a Weather,
    path: SunPath,
    offset: f64,
    moved_clock: i32,
    light: LightSource,
    next: usize,
}

impl Weather {
    /// Creates a reader that computes sun and light of the file's records: in any order, or as an iterator over all.
    ///
    /// # Errors
    /// Returns an error if the offset is out of range, or if it is to be automatic and the file has no data to test its
    /// clock with.
    pub fn hours(&self, reading: Reading) -> Result<Hours<'_>, HourError> {
        let offset = match reading.offset {
            SunOffset::Minutes(minutes) if minutes.abs() <= WIDEST_OFFSET => minutes,
            SunOffset::Minutes(minutes) => return Err(HourError::Offset(minutes)),
            // A clock that was tested before is stated by the file.
            SunOffset::Auto if self.tested.is_some() => 0.0,
            SunOffset::Auto => self.closure()?.ok_or(HourError::NoClosure)?.best_offset,
        };
        let path = SunPath::new(&self.station);
        let moved_clock = 60 * (offset / 60.0).trunc() as i32;
        Ok(Hours { weather: self, path, offset: self.clock + offset, moved_clock, light: reading.light, next: 0 })
    }
}

impl Hours<'_> {
    /// Returns the offset by which intervals lie later than the records state: that which the file specifies plus that
    /// of the reading. \[min\]
    pub fn offset(&self) -> f64 {
        self.offset
    }

    /// Returns the whole hours of the reading's offset, by which schedules move with the sun: by them the file's clock
    /// is wrong (e.g. rows in UTC under a header of local time). \[min\] The rest of the offset is the position of the
    /// light within its interval and moves the sun alone.
    pub fn moved_clock(&self) -> i32 {
        self.moved_clock
    }

    /// Computes sun, irradiances and illuminances of the record at `index`.
    ///
    /// # Errors
    /// Returns an error if a value is missing by day, or if there is no such record.
    pub fn at(&mut self, index: usize) -> Result<Hour, HourError> {
        self.part(index, 0, 1)
    }

    /// Computes sun, irradiances and illuminances in part number `part` (from 0) of `parts` equal parts of a record's
    /// interval: every part has a sun position of its own, the irradiances are those of the whole interval.
    ///
    /// # Errors
    /// Returns an error if a value is missing by day, or if there is no such record.
    pub fn part(&mut self, index: usize, part: u32, parts: u32) -> Result<Hour, HourError> {
        let record = self.weather.records.get(index).ok_or(HourError::Index(index))?;
        self.path.turn_to(record.day.number())?;
        let (sun, lit) = self.sun(record, part, parts);
        // Irradiances are means over the whole interval: so is what is computed from them.
        let whole = if parts > 1 && record.completion().is_some() { self.sun(record, 0, 1) } else { (sun, lit) };
        self.with_sun(index, record.completed(whole), sun, lit)
    }

    /// Returns the position of the sun in part number `part` of `parts` equal parts of a record's interval, and the
    /// share of the part in which the sun's centre is above the horizon.
    fn sun(&self, record: &Record, part: u32, parts: u32) -> (Dir<World>, f64) {
        let interval = f64::from(self.weather.interval) / f64::from(parts);
        let middle = record.middle_seconds(self.weather.interval, part, parts) / 60.0 + self.offset;
        let part = lit_part(&self.path, middle - 0.5 * interval, middle + 0.5 * interval);
        let sun = Dir::from_unit(self.path.at(part.map_or(middle, |(_, middle)| middle)));
        (sun, part.map_or(0.0, |(share, _)| share))
    }

    /// Computes the light of the record at `index` from its direct and diffuse `irradiances` \[W/m²\] (`None`:
    /// missing), the direction of its sun, and the share `lit` of the interval with the sun above the horizon.
    fn with_sun(
        &self,
        index: usize,
        irradiances: [Option<f64>; 2],
        sun: Dir<World>,
        lit: f64,
    ) -> Result<Hour, HourError> {
        let weather = self.weather;
        let record = &weather.records[index];
        let up = lit > 0.0 && sun.vector().z > 0.0;
        let figure = |value: Option<f64>, field: Field| match value {
            Some(value) => Ok(value),
            None if !up => Ok(0.0),
            None => Err(HourError::Missing {
                line: record.line,
                field: weather.field_name(field),
                time: record.label(weather.interval),
            }),
        };
        let diffuse = figure(irradiances[1], Field::Diffuse)?.max(0.0);
        let direct = if up { figure(irradiances[0], Field::Direct)?.max(0.0) } else { 0.0 };
        let mut hour = Hour {
            index,
            sun,
            lit,
            direct_normal_irradiance: 0.0,
            diffuse_horizontal_irradiance: 0.0,
            direct_normal: 0.0,
            diffuse_horizontal: 0.0,
            light: LightSource::Efficacy,
            state: None,
        };
        if direct <= 0.0 && diffuse <= 0.0 {
            return Ok(hour);
        }
        let altitude = sun.altitude().max(0.0);
        let air =
            Air { eccentricity: record.day.eccentricity(), water: record.dew_point.map_or(Air::UNKNOWN.water, water) };
        let by_efficacy = |direct: f64, diffuse: f64| {
            let state = PerezState::in_air(altitude, direct, diffuse, air);
            let light = state.map_or([0.0; 2], |s| [direct * s.direct_efficacy(), diffuse * s.diffuse_efficacy()]);
            (state, light)
        };
        let (irradiances, light) = match weather.quantity {
            Quantity::NormalIrradiance => ([direct, diffuse], None),
            Quantity::HorizontalIrradiance => {
                // With the sun just above the horizon, no more than the solar constant.
                let most = SOLAR_CONSTANT * air.eccentricity;
                let normal = if up { (direct / sun.vector().z).min(most) } else { 0.0 };
                ([normal, diffuse], None)
            }
            Quantity::NormalIlluminance => {
                // Back from light to power: a few rounds, since the efficacy is that of the answer.
                let mut power = [direct / 100.0, diffuse / 120.0];
                for _ in 0..ROUNDS {
                    let (_, light) = by_efficacy(power[0], power[1]);
                    for ((power, light), wanted) in power.iter_mut().zip(light).zip([direct, diffuse]) {
                        *power *= if light > 0.0 { (wanted / light).clamp(0.2, 5.0) } else { 1.0 };
                    }
                }
                (power, Some([direct, diffuse]))
            }
        };
        [hour.direct_normal_irradiance, hour.diffuse_horizontal_irradiance] = irradiances;
        let (state, by_model) = by_efficacy(irradiances[0], irradiances[1]);
        hour.state = state;
        let reported = light.or_else(|| {
            (self.light == LightSource::File).then(|| reported_illuminances(record, irradiances)).flatten()
        });
        if reported.is_some() {
            hour.light = LightSource::File;
        }
        [hour.direct_normal, hour.diffuse_horizontal] = reported.unwrap_or(by_model);
        Ok(hour)
    }
}

impl Record {
    /// Returns which irradiance, direct or diffuse, the record lacks, if it follows from its global and its other
    /// irradiance.
    pub(super) fn completion(&self) -> Option<Field> {
        match (self.global, self.direct, self.diffuse) {
            (Some(_), None, Some(_)) => Some(Field::Direct),
            (Some(_), Some(_), None) => Some(Field::Diffuse),
            _ => None,
        }
    }

    /// Returns direct normal and diffuse horizontal irradiance; where the row lacks one of them, by global = diffuse +
    /// direct · sin h with the sun of the interval and the share of it in which the sun is up. Near the horizon, where
    /// sin h is almost 0, all global irradiance counts as diffuse. \[W/m²\]
    fn completed(&self, (sun, lit): (Dir<World>, f64)) -> [Option<f64>; 2] {
        let sine = sun.vector().z.max(0.0);
        match (self.global, self.direct, self.diffuse) {
            (Some(global), None, Some(diffuse)) if sun.altitude().to_degrees() < MIN_ALTITUDE => {
                [Some(0.0), Some(global.max(diffuse))]
            }
            (Some(global), None, Some(diffuse)) => {
                let most = SOLAR_CONSTANT * self.day.eccentricity() * lit;
                [Some(((global - diffuse).max(0.0) / sine).min(most)), Some(diffuse)]
            }
            (Some(global), Some(direct), None) => [Some(direct), Some((global - direct * sine).max(0.0))],
            _ => [self.direct, self.diffuse],
        }
    }
}

/// Number of iterations by which the irradiance is found whose luminous efficacy gives a known illuminance: each
/// reduces the residual to a tenth. Held by
/// `tests/compute/weather.rs::horizontal_beams_and_illuminances_lead_back_to_the_same_hour`, to 1e-4.
const ROUNDS: usize = 8;

impl Iterator for Hours<'_> {
    type Item = Result<Hour, HourError>;

    fn next(&mut self) -> Option<Self::Item> {
        let index = self.next;
        self.next += 1;
        (index < self.weather.records.len()).then(|| self.at(index))
    }
}

/// Returns the precipitable water of the atmosphere for a dew point at the ground \[°C\]. \[cm\]
fn water(dew_point: f64) -> f64 {
    (0.07 * dew_point - 0.075).exp()
}

/// Returns the direct normal and diffuse horizontal illuminance that the record states, if both are present and
/// plausible for its irradiances `direct` and `diffuse` \[W/m²\]. \[lx\]
fn reported_illuminances(record: &Record, [direct, diffuse]: [f64; 2]) -> Option<[f64; 2]> {
    let plausible = |light: Option<f64>, power: f64, least: f64, most: f64| match light {
        _ if power <= 0.0 => Some(0.0),
        Some(light) if (least * power..=most * power).contains(&light) => Some(light),
        _ => None,
    };
    Some([
        plausible(record.direct_illuminance, direct, 20.0, 140.0)?,
        plausible(record.diffuse_illuminance, diffuse, 60.0, 200.0)?,
    ])
}

/// Returns share and middle of the part of an interval in which the sun's centre is above the horizon; of two such
/// parts the longer. `from`, `to` and the middle are minutes after local midnight. `None` if the sun stays below the
/// horizon.
fn lit_part(path: &SunPath, from: f64, to: f64) -> Option<(f64, f64)> {
    /// Sine of an altitude that the sun does not cross between three places of an hour: within the 30 min between two
    /// of them it passes its highest or lowest place by no more than 1 − cos 3.75° = 0.002.
    const CLEAR: f64 = 0.01;
    let height = |minutes: f64| path.at(minutes).z;
    let ends = [from, 0.5 * (from + to), to].map(height);
    if ends.iter().all(|z| *z > CLEAR) {
        return Some((1.0, 0.5 * (from + to)));
    }
    if ends.iter().all(|z| *z < -CLEAR) {
        return None;
    }
    // Minute by minute, linear between.
    let steps = ((to - from).round() as usize).clamp(12, 60);
    let step = (to - from) / steps as f64;
    let (mut best, mut begun, mut last) = (None::<(f64, f64)>, (ends[0] > 0.0).then_some(from), ends[0]);
    let longer = |best: Option<(f64, f64)>, part: (f64, f64)| match best {
        Some(one) if one.1 - one.0 >= part.1 - part.0 => Some(one),
        _ => Some(part),
    };
    for k in 1..=steps {
        let end = from + step * k as f64;
        let z = height(end);
        let crossing = end - step + step * last / (last - z);
        match begun {
            Some(begin) if z <= 0.0 => {
                best = longer(best, (begin, crossing));
                begun = None;
            }
            None if z > 0.0 => begun = Some(if last == z { end } else { crossing }),
            _ => {}
        }
        last = z;
    }
    if let Some(begin) = begun {
        best = longer(best, (begin, to));
    }
    best.filter(|(begin, end)| end > begin).map(|(begin, end)| ((end - begin) / (to - from), 0.5 * (begin + end)))
}
