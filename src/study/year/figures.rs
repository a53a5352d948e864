//! Annual figures: daylight autonomy, provision, glare, lighting, solar energy, each with the error that follows from
//! the errors of the hourly results.

use super::Year;
use crate::compute::year::autonomy::{Autonomy, Exposure};
use crate::compute::year::blinds::Blinds;
use crate::compute::year::glare::{Glare, glare};
use crate::compute::year::lighting::Energy;
use crate::compute::year::probability::Probability;
use crate::compute::year::provision::Provision;
use crate::compute::year::solar::{Transmitted, When};
use crate::compute::year::{Step, StepTable};

/// Annual figures of the requested steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Figures {
    /// Number of requested steps.
    pub steps: usize,
    /// Number of occupied steps among them.
    pub occupied: usize,
    /// Number of steps among them with light from the sky.
    pub lit: usize,
    /// Daylight autonomy at the sensors.
    pub autonomy: Autonomy,
    /// Spatial daylight autonomy with blinds operated by the rule of IES LM-83-12; `None` if not requested.
    pub blinds: Option<Blinds>,
    /// Annual sunlight exposure: direct sun on the sensors; `None` if nothing transmits sunlight unscattered, or for
    /// less than a year.
    pub exposure: Option<Exposure>,
    /// Daylight provision by EN 17037; `None` for less than a year, or if only occupied hours were computed.
    pub provision: Option<Provision>,
    /// Annual glare figures by simplified DGP (DGPs), one entry per observer.
    pub glare: Vec<Glare>,
    /// Annual glare figures by daylight glare probability (DGP), one entry per observer; empty if not requested.
    pub probability: Vec<Probability>,
    /// Energy of the electric lighting; `None` without lighting in the scene.
    pub lighting: Option<Energy>,
    /// Solar energy transmitted through the apertures; `None` if not requested.
    pub solar: Option<SolarFigures>,
}

/// Solar energy transmitted through the apertures. \[kWh\]
#[derive(Debug, Clone, PartialEq)]
pub struct SolarFigures {
    /// Solar energy through all apertures together. \[kWh\]
    pub energy: Transmitted,
    /// Solar energy through each aperture, in the scene's order. \[kWh\]
    pub apertures: Vec<f64>,
}

/// Returns the figures of a year as computed, of the same year with all illuminances lower by their errors, and with
/// all illuminances higher. The differences are the uncertainty of the figures.
pub fn figures(year: &Year) -> [Figures; 3] {
    let light = &year.light;
    let shifted = |sign: f64| light.values.with(&light.errors, |value, error| (value + sign * error).max(0.0));
    // One after the other: each table is as large as the light itself.
    let own = of(year, &light.values, 0.0);
    let [less, more] = [-1.0, 1.0].map(|sign| of(year, &shifted(sign), sign));
    [own, less, more]
}

/// Returns the transmitted solar energy, with `sign` times the errors of the hourly powers added.
fn transmitted(year: &Year, sign: f64) -> Option<SolarFigures> {
    let solar = year.solar.as_ref()?;
    let steps: Vec<When> = year
        .chosen
        .iter()
        .map(|&k| {
            let step = &year.steps.list[k];
            When { month: step.month, hour: step.time.hour().unsigned_abs() }
        })
        .collect();
    let shifted = |value: f64, error: f64| (value + sign * error).max(0.0);
    let watts: Vec<f64> = solar.watts.iter().zip(&solar.errors).map(|(watts, error)| shifted(*watts, *error)).collect();
    Some(SolarFigures {
        energy: Transmitted::of(&steps, &watts, year.steps.length),
        apertures: solar.apertures.iter().map(|one| shifted(one.energy.value, one.energy.error)).collect(),
    })
}

/// Returns the figures for the illuminances `values` of the year \[lx\]. `sign`: factor of the errors that are added to
/// solar power and glare.
fn of(year: &Year, values: &StepTable, sign: f64) -> Figures {
    let (sensors, places) = (year.settings.sensors, year.light.places);
    let steps: Vec<Step> = year
        .chosen
        .iter()
        .map(|&k| {
            let step = &year.steps.list[k];
            Step { month: step.month, occupied: step.occupied, diffuse_horizontal: step.hour.diffuse_horizontal }
        })
        .collect();
    let whole = year.steps.whole && year.chosen.len() == year.steps.list.len();
    // EN 17037 counts the hours of daylight, whether occupied or not.
    let daylit = whole && year.settings.unoccupied;
    let sun = year.light.sun.as_ref().and_then(|table| table.columns(sensors..places));
    let length = year.steps.length;
    let light = values.columns(0..sensors);
    Figures {
        steps: steps.len(),
        occupied: steps.iter().filter(|step| step.occupied).count(),
        lit: steps.iter().filter(|step| step.diffuse_horizontal > 0.0).count(),
        autonomy: light.map(|light| Autonomy::of(&steps, light)).unwrap_or_default(),
        blinds: blinds(year, &steps, sign),
        exposure: if whole { exposure(year, &steps) } else { None },
        provision: light.filter(|_| daylit).map(|light| Provision::of(&steps, light)),
        glare: values.columns(sensors..places).map(|light| glare(&steps, light, sun)).unwrap_or_default(),
        solar: transmitted(year, sign),
        probability: probability(year, sign),
        lighting: year.settings.lamps.as_ref().zip(light).map(|(lamps, light)| lamps.energy(&steps, light, length)),
    }
}

/// Returns the exposure of the sensors to direct sun. Systems that transmit none in the states in use, or in the open
/// states, count as zero.
fn exposure(year: &Year, steps: &[Step]) -> Option<Exposure> {
    let in_use = year.light.sun.as_ref();
    let retracted = if year.moving.is_empty() { in_use } else { year.retracted_sun.as_ref() };
    in_use.or(retracted)?;
    let dark = StepTable::zeros(steps.len(), year.light.places, 0);
    let [in_use, retracted] = [in_use, retracted].map(|sun| sun.unwrap_or(&dark).columns(0..year.settings.sensors));
    Some(Exposure::of(steps, in_use?, retracted?, year.steps.length))
}

/// Returns the figures with blinds operated by LM-83, with `sign` times the errors of the illuminances and of the
/// direct sun that operates them.
fn blinds(year: &Year, steps: &[Step], sign: f64) -> Option<Blinds> {
    let lm83 = year.lm83.as_ref()?;
    let values = lm83.values.with(&lm83.errors, |value, error| (value + sign * error).max(0.0));
    let light = values.columns(0..year.settings.sensors)?;
    Some(Blinds::of(steps, light, &lm83.worked, year.steps.length, sign))
}

/// Returns the annual figures of DGP, one entry per observer, with `sign` times its errors added. In dark steps DGP is
/// 0.
fn probability(year: &Year, sign: f64) -> Vec<Probability> {
    let Some(dgp) = &year.dgp else { return Vec::new() };
    let occupied = |row: &usize| year.steps.list[year.chosen[*row]].occupied;
    let value = |row: usize, eye: usize| dgp.row(row)[eye].map_or(0.0, |one| one.value + sign * one.error);
    let of = |eye: usize| Probability::of((0..year.chosen.len()).filter(occupied).map(|row| value(row, eye)).collect());
    (0..dgp.eyes).map(of).collect()
}
