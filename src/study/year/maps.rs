//! Results of a year, or data of a weather file, as a map of hours.

use super::Year;
use super::look::{Look, Shows};
use super::steps::Step;
use crate::compute::glare::dgps;
use crate::compute::weather::{Quantity, Reading, Weather};
use crate::drawing::colours::{ColourMap, ColourScale};
use crate::drawing::hour_map::{Colours, HourMap, Interval};
use crate::study::control::Device;
use crate::study::weather::moment;
use crate::texts::year as say;
use jiff::civil::DateTime;

/// Smallest and largest simplified DGP (DGPs) of the colour scale: no light, and intolerable glare.
const DGPS: [f64; 2] = [0.184, 0.6];
/// Number of decades of a logarithmic colour scale.
const DECADES: i32 = 3;

/// Returns the quantities that a map of this year can display.
pub fn choices(year: &Year) -> Vec<Shows> {
    let mut list = vec![Shows::Mean];
    list.extend((0..year.moving.len()).map(Shows::State));
    list.extend((0..year.settings.eyes.len()).map(Shows::Dgps));
    list.extend(year.settings.lamps.as_ref().map(|_| Shows::Lighting));
    list.extend([Shows::DirectNormal, Shows::DiffuseHorizontal]);
    list.extend((0..year.settings.sensors).map(Shows::Sensor));
    list
}

/// Returns the translated title of a map of a quantity.
pub fn title(shows: Shows) -> String {
    match shows {
        Shows::Mean => say::MEAN.into(),
        Shows::Sensor(place) => say::sensor(place + 1),
        Shows::State(_) => say::STATE.into(),
        Shows::Dgps(eye) => say::dgps(eye + 1),
        Shows::Lighting => say::LIGHTING_POWER.into(),
        Shows::DirectNormal => say::DIRECT_NORMAL.into(),
        Shows::DiffuseHorizontal => say::DIFFUSE_HORIZONTAL.into(),
    }
}

/// Returns the heading of the column with a map's values in CSV files; it does not change with the language.
pub fn csv_column(shows: Shows) -> String {
    match shows {
        Shows::Mean => "Mean illuminance".to_owned(),
        Shows::Sensor(place) => format!("Sensor {}", place + 1),
        Shows::State(_) => "State".to_owned(),
        Shows::Dgps(eye) => format!("DGPs, eye {}", eye + 1),
        Shows::Lighting => "Lighting power".to_owned(),
        Shows::DirectNormal => "Direct normal".to_owned(),
        Shows::DiffuseHorizontal => "Diffuse horizontal".to_owned(),
    }
}

/// Returns the position of each state of a device in the ascending order of their numbers, and the keys in that order;
/// if states have no numbers, the order of the device is used.
pub(super) fn states(device: &Device) -> (Vec<usize>, Vec<String>) {
    let mut order: Vec<usize> = (0..device.keys.len()).collect();
    if let Some(values) = &device.values {
        order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    }
    let mut ranks = vec![0; order.len()];
    for (rank, state) in order.iter().enumerate() {
        ranks[*state] = rank;
    }
    (ranks, order.iter().map(|state| device.keys[*state].clone()).collect())
}

/// Returns the value of a quantity in a computed step, in the unit of the map. `k`: index of the step; `row`: its index
/// among the chosen ones; `ranks`: positions of the states in their order.
fn value(year: &Year, shows: Shows, ranks: &[usize], k: usize, row: usize) -> f64 {
    let own = year.light.values.row(row);
    let (sensors, step) = (year.settings.sensors, &year.steps.list[k]);
    match shows {
        Shows::Mean => mean(&own[..sensors]),
        Shows::Sensor(place) => own.get(place).map_or(f64::NAN, |value| f64::from(*value)),
        Shows::State(moving) => {
            let place = year.states[k].get(moving).and_then(|state| ranks.get(*state));
            place.map_or(f64::NAN, |place| *place as f64)
        }
        Shows::Dgps(eye) => own.get(sensors + eye).map_or(f64::NAN, |vertical| dgps(f64::from(*vertical))),
        Shows::Lighting => {
            year.settings.lamps.as_ref().map_or(f64::NAN, |lamps| lamps.watts(step.occupied, &own[..sensors]))
        }
        Shows::DirectNormal => step.hour.direct_normal,
        Shows::DiffuseHorizontal => step.hour.diffuse_horizontal,
    }
}

/// Returns the estimated absolute error of a value in a map, in its unit; `None` if the value has no stated error.
/// `step`: index of the step in the year.
pub fn error(year: &Year, shows: Shows, step: usize) -> Option<f64> {
    let row = year.chosen.binary_search(&step).ok()?;
    let own = year.light.errors.row(row);
    let sensors = year.settings.sensors;
    match shows {
        // Errors of neighbouring sensors are correlated: they are assumed to add up.
        Shows::Mean => Some(mean(&own[..sensors])),
        Shows::Sensor(place) => own.get(place).map(|error| f64::from(*error)),
        Shows::Dgps(eye) => own.get(sensors + eye).map(|error| dgps(f64::from(*error)) - dgps(0.0)),
        Shows::State(_) | Shows::Lighting | Shows::DirectNormal | Shows::DiffuseHorizontal => None,
    }
}

fn mean(row: &[f32]) -> f64 {
    row.iter().map(|value| f64::from(*value)).sum::<f64>() / row.len().max(1) as f64
}

/// Returns an interval of the map with a value, from the middle of the step, to whole minutes.
fn interval(time: DateTime, value: f64) -> Interval {
    let minute = 60 * u16::from(time.hour().unsigned_abs()) + u16::from(time.minute().unsigned_abs());
    Interval { month: time.month().unsigned_abs(), day: time.day().unsigned_abs(), minute, value }
}

/// Returns the colour scale for the values of a map.
fn scale(values: impl Iterator<Item = f64>, log: bool) -> ColourScale {
    let most = values.filter(|value| value.is_finite()).fold(0.0, f64::max);
    ColourScale::up_to(if most > 0.0 { most } else { 1.0 }, log, DECADES, ColourMap::Sequential)
}

/// Returns the map of a quantity over the hours of a year. Dark steps and steps that were not computed have no value;
/// electric lighting has one at night too. If the year does not contain the quantity, the mean illuminance is
/// displayed.
pub fn map(year: &Year, look: &Look) -> HourMap {
    let shows = if choices(year).contains(&look.shows) { look.shows } else { Shows::Mean };
    let mut rows = vec![None; year.steps.list.len()];
    for (row, &k) in year.chosen.iter().enumerate() {
        rows[k] = Some(row);
    }
    let ranks = match shows {
        Shows::State(moving) => states(&year.moving[moving].device).0,
        _ => Vec::new(),
    };
    let at_night = shows == Shows::Lighting;
    let shown = |k: usize, step: &Step| match rows[k] {
        Some(row) if at_night || step.hour.is_lit() => value(year, shows, &ranks, k, row),
        _ => f64::NAN,
    };
    let list: Vec<Interval> =
        year.steps.list.iter().enumerate().map(|(k, step)| interval(step.time, shown(k, step))).collect();
    let values = || list.iter().map(|one| one.value);
    let colours = match shows {
        Shows::State(moving) => Colours::Names(states(&year.moving[moving].device).1),
        Shows::Dgps(_) => {
            let [lo, hi] = DGPS;
            Colours::Scale(ColourScale { lo, hi, log: false, map: ColourMap::Sequential }, "DGPs")
        }
        Shows::Lighting => Colours::Scale(scale(values(), false), "W/m²"),
        _ => Colours::Scale(scale(values(), look.log), "lx"),
    };
    HourMap::of(title(shows), colours, 60.0 * year.steps.length, &list)
}

/// Returns the map of the direct normal (`direct`) or the diffuse horizontal component in a weather file, in the unit
/// of the file, W/m² or lx. Intervals that are dark or lack the value have none.
pub fn weather_map(weather: &Weather, reading: Reading, direct: bool) -> HourMap {
    let lux = weather.quantity == Quantity::NormalIlluminance;
    let mut hours = weather.hours(reading).ok();
    let moved = hours.as_ref().map_or(0.0, |hours| 60.0 * f64::from(hours.moved_clock()));
    let list: Vec<Interval> = weather
        .records
        .iter()
        .enumerate()
        .map(|(index, record)| {
            let hour = hours.as_mut().and_then(|hours| hours.at(index).ok()).filter(|hour| hour.is_lit());
            let value = hour.map_or(f64::NAN, |hour| match (direct, lux) {
                (true, true) => hour.direct_normal,
                (true, false) => hour.direct_normal_irradiance,
                (false, true) => hour.diffuse_horizontal,
                (false, false) => hour.diffuse_horizontal_irradiance,
            });
            interval(moment(record, record.middle_seconds(weather.interval, 0, 1) + moved), value)
        })
        .collect();
    let scale = scale(list.iter().map(|one| one.value), false);
    let name = if direct { say::DIRECT_NORMAL } else { say::DIFFUSE_HORIZONTAL };
    let unit = if lux { "lx" } else { "W/m²" };
    HourMap::of(name.into(), Colours::Scale(scale, unit), f64::from(weather.interval), &list)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::weather::{YEARS, load};
    use std::path::Path;

    #[test]
    fn a_calendar_holds_what_the_weather_holds() {
        for year in &YEARS {
            let weather = load(&year.name(), Path::new("")).unwrap();
            for direct in [true, false] {
                let map = weather_map(&weather, Reading::default(), direct);
                let sum: f64 = map.values.iter().filter(|value| !value.is_nan()).sum();
                let of = |record: &crate::compute::weather::Record| {
                    (if direct { record.direct } else { record.diffuse }).unwrap_or(0.0)
                };
                let own: f64 = weather.records.iter().map(of).sum();
                // A sun that is down gives nothing, whatever the row says.
                assert!((sum / own - 1.0).abs() < 2e-3, "{}: {sum} {own}", year.key);
                assert_eq!((map.days, map.rows), (365, 24));
                assert!(map.from.iter().all(Option::is_some));
            }
            // Noon of midsummer has light, its midnight none.
            let map = weather_map(&weather, Reading::default(), false);
            let [noon, midnight] = [720, 30].map(|minute| map.values[map.cell(6, 21, minute).unwrap()]);
            assert!(noon > 0.0 && midnight.is_nan());
        }
    }
}
