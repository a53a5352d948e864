//! What a year comes to: autonomy, provision, glare, lighting, each with the error that the hours' own errors leave it.

use super::Year;
use crate::compute::year::autonomy::{Autonomy, Exposure};
use crate::compute::year::blinds::Blinds;
use crate::compute::year::glare::{Glare, glare};
use crate::compute::year::lighting::Energy;
use crate::compute::year::probability::Probability;
use crate::compute::year::provision::Provision;
use crate::compute::year::solar::{Transmitted, When};
use crate::compute::year::{Light, Step};

/// Figures of the steps that were asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Figures {
    /// Steps.
    pub steps: usize,
    /// Occupied ones.
    pub occupied: usize,
    /// With light from the sky.
    pub lit: usize,
    /// Of the sensors.
    pub autonomy: Autonomy,
    /// With blinds by IES LM-83-12's own rule, where they are asked for.
    pub blinds: Option<Blinds>,
    /// Sun on the sensors; `None` where nothing lets it through unscattered, or for less than a year.
    pub exposure: Option<Exposure>,
    /// EN 17037; `None` for less than a year, or for its occupied hours alone.
    pub provision: Option<Provision>,
    /// By eye.
    pub glare: Vec<Glare>,
    /// The same by daylight glare probability; empty where that was not asked for.
    pub probability: Vec<Probability>,
    /// With lamps.
    pub lighting: Option<Energy>,
    /// Where it is asked for.
    pub solar: Option<SolarFigures>,
}

/// Solar energy straight through apertures. \[kWh\]
#[derive(Debug, Clone, PartialEq)]
pub struct SolarFigures {
    /// All of them together.
    pub energy: Transmitted,
    /// One by one, in the scene's order.
    pub apertures: Vec<f64>,
}

/// The figures of a year, and of the same year with all illuminances less and more by their errors: between these lies what
/// the errors leave open.
pub fn figures(year: &Year) -> [Figures; 3] {
    let light = &year.light;
    let shifted = |sign: f64| -> Vec<f64> {
        light.values.iter().zip(&light.errors).map(|(value, error)| (value + sign * error).max(0.0)).collect()
    };
    [of(year, &light.values, 0.0), of(year, &shifted(-1.0), -1.0), of(year, &shifted(1.0), 1.0)]
}

/// Solar energy, with `sign` times the errors of its steps.
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

/// Of illuminances; `sign`: times their errors are added to solar power and glare.
fn of(year: &Year, values: &[f64], sign: f64) -> Figures {
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
    // EN 17037 counts the hours of daylight, whoever is in.
    let daylit = whole && year.settings.unoccupied;
    let desks = |values| Light::of_columns(places, 0..sensors, values);
    let eyes = |values| Light::of_columns(places, sensors..places, values);
    let sun = year.light.sun.as_deref();
    let length = year.steps.length;
    let light = desks(values);
    Figures {
        steps: steps.len(),
        occupied: steps.iter().filter(|step| step.occupied).count(),
        lit: steps.iter().filter(|step| step.diffuse_horizontal > 0.0).count(),
        autonomy: light.map(|light| Autonomy::of(&steps, light)).unwrap_or_default(),
        blinds: blinds(year, &steps, sign),
        exposure: if whole { exposure(year, &steps) } else { None },
        provision: light.filter(|_| daylit).map(|light| Provision::of(&steps, light)),
        glare: eyes(values).map(|light| glare(&steps, light, sun.and_then(eyes))).unwrap_or_default(),
        solar: transmitted(year, sign),
        probability: probability(year, sign),
        lighting: year.settings.lamps.as_ref().zip(light).map(|(lamps, light)| lamps.energy(&steps, light, length)),
    }
}

/// What lets the sun through in no state in use, or retracted, lets none through.
fn exposure(year: &Year, steps: &[Step]) -> Option<Exposure> {
    let (sensors, places) = (year.settings.sensors, year.light.places);
    let in_use = year.light.sun.as_deref();
    let retracted = if year.moving.is_empty() { in_use } else { year.retracted_sun.as_deref() };
    in_use.or(retracted)?;
    let dark = vec![0.0; places * steps.len()];
    let desks = |values| Light::of_columns(places, 0..sensors, values);
    let [in_use, retracted] = [in_use, retracted].map(|sun| desks(sun.unwrap_or(&dark)));
    Some(Exposure::of(steps, in_use?, retracted?, year.steps.length))
}

/// With `sign` times the errors of the light, and of the sun that works the blinds.
fn blinds(year: &Year, steps: &[Step], sign: f64) -> Option<Blinds> {
    let lm83 = year.lm83.as_ref()?;
    let own = lm83.values.iter().zip(&lm83.errors);
    let values: Vec<f64> = own.map(|(value, error)| (value + sign * error).max(0.0)).collect();
    let light = Light::new(year.settings.sensors.max(1), &values)?;
    Some(Blinds::of(steps, light, &lm83.worked, year.steps.length, sign))
}

/// Of every eye; dark steps have no glare.
fn probability(year: &Year, sign: f64) -> Vec<Probability> {
    let Some(dgp) = &year.dgp else { return Vec::new() };
    let occupied = |row: &usize| year.steps.list[year.chosen[*row]].occupied;
    let value = |row: usize, eye: usize| dgp.row(row)[eye].map_or(0.0, |one| one.value + sign * one.error);
    let of = |eye: usize| Probability::of((0..year.chosen.len()).filter(occupied).map(|row| value(row, eye)).collect());
    (0..dgp.eyes).map(of).collect()
}
