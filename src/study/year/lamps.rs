//! The lamps over a sunny day, and by month. Lighting power of a day: IEA SHC Task 31 report (2005), figure 18.

use super::{Annual, Year};
use crate::drawing::plot::{Axis, Form, Guide, Plot, Series, Unit};
use crate::texts::{fixed, words::MONTHS, year as say};
use jiff::civil::Date;

/// Power of the lamps over a day.
#[derive(Debug, Clone, PartialEq)]
pub struct Day {
    /// Which, in the row's own year.
    pub date: Date,
    /// Direct normal irradiation of it. \[Wh/m²\]
    pub direct: f64,
    /// Begin and end of every step, in hours of local standard time.
    pub spans: Vec<[f64; 2]>,
    /// Power in it. \[W/m²\]
    pub watts: Vec<f64>,
    /// The same with all light more, and less, by its error: least and most power. \[W/m²\]
    pub between: Vec<[f64; 2]>,
}

/// The day of a month (1 … 12) with most direct normal irradiation, of those that were computed and on which somebody is
/// there; `None` where there is none.
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

/// The lamps over a day; `None` without lamps, or where the day was not computed.
pub fn day(year: &Year, date: Date) -> Option<Day> {
    let lamps = year.settings.lamps.as_ref()?;
    let (sensors, places) = (year.settings.sensors, year.light.places);
    let half = 0.5 * year.steps.length;
    let mut day = Day { date, direct: 0.0, spans: Vec::new(), watts: Vec::new(), between: Vec::new() };
    for (row, &k) in year.chosen.iter().enumerate() {
        let step = &year.steps.list[k];
        if step.time.date() != date {
            continue;
        }
        let own = row * places..row * places + sensors;
        let (values, errors) = (&year.light.values[own.clone()], &year.light.errors[own]);
        let watts = |sign: f64| {
            let light: Vec<f64> = values.iter().zip(errors).map(|(e, error)| (e + sign * error).max(0.0)).collect();
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

/// Energy by month and how far it may be off \[kWh/m²\]; `None` without lamps.
pub fn months(annual: &Annual) -> Option<[(f64, f64); 12]> {
    let [own, less, more] = annual.figures.each_ref().map(|one| one.lighting.as_ref().map(|energy| energy.months));
    let (own, less, more) = (own?, less?, more?);
    Some(std::array::from_fn(|k| (own[k], (less[k] - own[k]).abs().max((more[k] - own[k]).abs()))))
}

/// `17 Mar, 7.3 kWh/m² direct normal`.
pub fn day_words(day: &Day) -> String {
    let month = MONTHS[usize::from(day.date.month().unsigned_abs()) - 1];
    say::sunny_day(day.date.day(), month, fixed(day.direct / 1000.0, 1))
}

/// Power over the hours of a day, a level for each step, with what the errors leave open.
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
