//! Electric lighting over a sunny day, and by month. The picture of a day's lighting power follows IEA SHC Task 31
//! report (2005), figure 18.

use super::{Annual, Year};
use crate::drawing::plot::{Axis, Form, Guide, Plot, Series, Unit};
use crate::texts::{fixed, words::MONTHS, year as say};
use jiff::civil::Date;

/// Power of the electric lighting over one day of the year.
#[derive(Debug, Clone, PartialEq)]
pub struct Day {
    /// Date of the day, in the year of the weather record.
    pub date: Date,
    /// Direct normal irradiation of the day. \[Wh/m²\]
    pub direct: f64,
    /// Begin and end of every step, as local standard time in hours from midnight. \[h\]
    pub spans: Vec<[f64; 2]>,
    /// Power of the electric lighting in every step. \[W/m²\]
    pub watts: Vec<f64>,
    /// Smallest and largest power in every step within the error of the illuminances. \[W/m²\]
    pub between: Vec<[f64; 2]>,
}

/// Returns the occupied day of a month (1 … 12) with the highest direct normal irradiation, among those that were
/// computed; `None` if there is none.
pub fn sunniest(year: &Year, month: u8) -> Option<Date> {
    let mut best: Option<(f64, Date)> = None;
    let (mut sum, mut occupied) = (0.0, false);
    for (place, &k) in year.chosen.iter().enumerate() {
        let step = &year.steps.list[k];
        let next = year.chosen.get(place + 1).map(|&next| year.steps.list[next].time.date());
        sum += step.hour.direct_normal_irradiance * year.steps.length;
        occupied |= step.occupied;
        if next != Some(step.time.date()) {
            if step.month == month && occupied && best.is_none_or(|(most, _)| sum > most) {
                best = Some((sum, step.time.date()));
            }
            (sum, occupied) = (0.0, false);
        }
    }
    best.map(|(_, date)| date)
}

/// Returns the power of the electric lighting over a day; `None` if the scene has no lighting, or the day was not
/// computed.
pub fn day(year: &Year, date: Date) -> Option<Day> {
    let lamps = year.settings.lamps.as_ref()?;
    let sensors = year.settings.sensors;
    let half = 0.5 * year.steps.length;
    let mut day = Day { date, direct: 0.0, spans: Vec::new(), watts: Vec::new(), between: Vec::new() };
    for (row, &k) in year.chosen.iter().enumerate() {
        let step = &year.steps.list[k];
        if step.time.date() != date {
            continue;
        }
        let [values, errors] = [&year.light.values, &year.light.errors].map(|table| &table.row(row)[..sensors]);
        let watts = |sign: f64| {
            let light: Vec<f64> = values
                .iter()
                .zip(errors)
                .map(|(e, error)| (f64::from(*e) + sign * f64::from(*error)).max(0.0))
                .collect();
            lamps.watts(step.occupied, &light)
        };
        let time = step.time;
        let middle = f64::from(time.hour()) + f64::from(time.minute()) / 60.0 + f64::from(time.second()) / 3600.0;
        day.direct += step.hour.direct_normal_irradiance * year.steps.length;
        day.spans.push([middle - half, middle + half]);
        let own = watts(0.0);
        let [more, less] = [1.0, -1.0].map(watts);
        day.watts.push(own);
        // More light may cost more where lamps that are off stand by.
        day.between.push([own.min(more).min(less), own.max(more).max(less)]);
    }
    (!day.spans.is_empty()).then_some(day)
}

/// Returns the lighting energy of each month, with its estimated absolute error \[kWh/m²\]; `None` if the scene has no
/// lighting.
pub fn months(annual: &Annual) -> Option<[(f64, f64); 12]> {
    let [own, less, more] = annual.figures.each_ref().map(|one| one.lighting.as_ref().map(|energy| energy.months));
    let (own, less, more) = (own?, less?, more?);
    Some(std::array::from_fn(|k| (own[k], (less[k] - own[k]).abs().max((more[k] - own[k]).abs()))))
}

/// Formats date and direct normal irradiation of a day, such as `17 Mar, 7.3 kWh/m² direct normal`.
pub fn day_words(day: &Day) -> String {
    let month = MONTHS[usize::from(day.date.month().unsigned_abs()) - 1];
    say::sunny_day(day.date.day(), month, fixed(day.direct / 1000.0, 1))
}

/// Returns the plot of lighting power against the hours of a day, one level for each step, with its uncertainty.
/// `installed`: installed power. \[W/m²\]
pub fn day_plot(day: &Day, installed: f64) -> Plot {
    let (mut points, mut band) = (Vec::new(), Vec::new());
    for ((span, watts), between) in day.spans.iter().zip(&day.watts).zip(&day.between) {
        for hour in span {
            points.push([*hour, *watts]);
            band.push(*between);
        }
    }
    let name = say::LIGHTING_POWER.to_string();
    Plot {
        x: Axis::linear([0.0, 24.0], "", Unit::Hours),
        y: Axis::linear([0.0, 1.08 * installed.max(1e-3)], name.clone(), Unit::Named("W/m²")),
        series: vec![Series { name, points, band, form: Form::Line }],
        guides: vec![Guide { name: say::INSTALLED.into(), ends: [[0.0, installed], [24.0, installed]] }],
    }
}
