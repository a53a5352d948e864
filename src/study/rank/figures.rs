//! Figures of a product in a list, with their errors: by data on their cells first, then with beams as they are.

use super::candidate::with_product;
use super::parts::{Grouping, Parts};
use super::question::Group;
use crate::catalogue::{Origin, Product};
use crate::compute::btdf::{Severity, SolarSource};
use crate::compute::estimate::{Estimate, Progress};
use crate::study::error::StudyError;
use crate::study::scene_file::Interpolation;
use crate::study::session::Session;
use crate::study::system::SystemLibrary;
use crate::study::year::{Climate, Dgp, Light, SHADE, Settings, Year, figures, metrics, year_in};
use serde_json::Value;

/// Figures of a product: valid whatever weights and anchors are.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Found {
    /// In the order of the list's figures, with nine significant digits, as tables hold them.
    pub figures: Vec<Estimate>,
    /// What they are sums of.
    pub parts: Vec<Parts>,
    /// Why they are approximate beyond their errors; empty where they are not.
    pub approximate: Vec<String>,
}

/// What became of a product: its figures, or why it is left out.
pub type Outcome = Result<Found, String>;

/// How far the work on a product has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// A year by data that are constant on their cells, as `compute.interpolation = "patch"` has them. Errors hold what that
    /// leaves open.
    Coarse,
    /// As the scene has it.
    Full,
}

/// What light behind data on cells may be off for the beams that they blur. Seen on the built-in prisms, whose fans are as wide
/// as cells: hours above 3000 lx of two sensors, 0.289 by cells where beams make 0.267, are what 8 % more light make.
const BLURRED: f64 = 0.1;
/// What a figure that a year does not have is told under.
const NO_FIGURE: &str = "rank.objective";
/// Says how well data were computed of a description. They may be waiting to be computed on one machine and be there on
/// another; how far figures are off for it is in their errors, or the description itself was asked.
const COMPUTED: &str = "error-target-missed";
/// Light that is known no better than so makes figures approximate.
const DOUBTFUL: f64 = 0.05;

/// Nine significant digits: what a table holds, so that a ranking from tables is the same.
pub(super) fn as_written(value: f64) -> f64 {
    format!("{value:.8e}").parse().unwrap_or(value)
}

/// What all products of a list are computed with.
pub(super) struct Setting<'a> {
    pub group: &'a Group,
    pub climate: &'a Climate,
    /// The same without what blurred light does not tell: glare, and blinds worked by where the sun falls.
    pub by_cells: &'a Climate,
    pub grouping: &'a Grouping,
    pub library: &'a dyn SystemLibrary,
    pub session: &'a Session,
}

impl Setting<'_> {
    /// The figures of one product.
    ///
    /// # Errors
    /// Of the product's data or control; a figure that the year does not have; cancelled.
    pub fn product(&self, product: &Product, stage: Stage, progress: &dyn Progress) -> Result<Found, StudyError> {
        let group = self.group;
        let mut file = with_product(&group.file, product, group.control)?;
        let coarse = stage == Stage::Coarse && file.compute.interpolation != Interpolation::Patch;
        if coarse {
            file.compute.interpolation = Interpolation::Patch;
        }
        let climate = if coarse { self.by_cells } else { self.climate };
        let mut year = year_in(climate, &file, &group.base, self.library, self.session, &|_| true, progress)?;
        let mut found = Found { approximate: doubts(product, &year), ..Found::default() };
        if coarse {
            blur(&mut year);
        }
        let all = three(&year, group.file.room.width * group.file.room.depth);
        for (key, objective) in group.figures.iter().zip(&group.objectives) {
            // What blurred light does not tell may be anything between the anchors.
            let between = || {
                let (a, b) = (objective.worst, objective.best);
                Estimate { value: 0.5 * (a + b), error: 0.5 * (b - a).abs() }
            };
            let figure = match figure(&year, &all, key) {
                // Nor which states a control takes that reads the room.
                Err(_) if coarse => between(),
                Ok(_) if coarse && year.indoor.is_some() => between(),
                found => found?,
            };
            found.figures.push(Estimate { value: as_written(figure.value), error: as_written(figure.error) });
            let mut parts = self.grouping.parts(&year, key);
            parts.values.iter_mut().for_each(|part| *part = as_written(*part));
            found.parts.push(parts);
        }
        Ok(found)
    }

    /// Are the list's figures such as a year here can have? Asked before all products are computed in vain. A year of darkness
    /// has most of them; whether it is the data that bring one, the list's first product tells.
    ///
    /// # Errors
    /// The figure that there is none of, and those that there are; cancelled.
    pub fn check(&self, first: &Product, progress: &dyn Progress) -> Result<(), StudyError> {
        let year = dark(self.climate);
        let all = three(&year, self.group.file.room.width * self.group.file.room.depth);
        let Some(error) = self.group.figures.iter().find_map(|key| figure(&year, &all, key).err()) else {
            return Ok(());
        };
        match self.product(first, Stage::Full, progress) {
            Err(StudyError::Key { key, message }) if key == NO_FIGURE => Err(StudyError::Key { key, message }),
            Err(StudyError::Cancelled(cancelled)) => Err(cancelled.into()),
            Err(_) => Err(error),
            Ok(_) => Ok(()),
        }
    }
}

/// Adds to the errors of a year what its data on cells may have blurred.
fn blur(year: &mut Year) {
    let add = |values: &[f64], errors: &mut [f64]| {
        errors.iter_mut().zip(values).for_each(|(error, value)| *error += BLURRED * value);
    };
    add(&year.light.values, &mut year.light.errors);
    if let Some(own) = &mut year.lm83 {
        add(&own.values, &mut own.errors);
    }
    if let Some(own) = &mut year.solar {
        add(&own.watts, &mut own.errors);
    }
}

/// A year without any light in a room with a window to see the sun through.
fn dark(climate: &Climate) -> Year {
    let steps = climate.steps.list.len();
    let places = climate.settings.sensors + climate.settings.eyes.len();
    let nothing = vec![0.0; places * steps];
    let eyes = climate.settings.eyes.len();
    let dgp = || Dgp { eyes, values: vec![Some(Estimate::exact(0.0)); eyes * steps], unproven: 0 };
    Year {
        settings: Settings { unoccupied: true, direct_sun: true, ..climate.settings.clone() },
        steps: climate.steps.clone(),
        moving: Vec::new(),
        states: vec![Vec::new(); steps],
        movements: Vec::new(),
        indoor: None,
        chosen: (0..steps).collect(),
        light: Light {
            places,
            values: nothing.clone(),
            errors: nothing.clone(),
            sun: Some(nothing),
            sets: 0,
            dark: steps,
        },
        retracted_sun: None,
        lm83: None,
        solar: None,
        dgp: (climate.settings.keys.dgp && eyes > 0).then(dgp),
        notes: Vec::new(),
        spent: Vec::new(),
    }
}

/// Metrics of a year, with less and with more light.
fn three(year: &Year, area: f64) -> [Value; 3] {
    figures(year).map(|one| metrics::metrics(year, &one, area))
}

/// A figure of a whole year; its error is the larger distance from those with less and with more light.
fn figure(year: &Year, metrics: &[Value; 3], key: &str) -> Result<Estimate, StudyError> {
    if let Some(figure) = read(metrics, key) {
        return Ok(figure);
    }
    if let Some(figure) = nought(year, key) {
        return Ok(figure);
    }
    let keys = metrics::keys(&metrics[0]).join(", ");
    Err(StudyError::key(NO_FIGURE, format!("the year has no figure \"{key}\"; it has: {keys}")))
}

/// Nothing moves, or no sun comes through unscattered: no doubt about how often.
fn nought(year: &Year, key: &str) -> Option<Estimate> {
    let still = year.moving.is_empty();
    let nought = match key {
        "movements" => still,
        "ASE1000_250" | "ASE_hours_1000" | "sun_hours_1000" => {
            year.steps.whole && year.light.sun.is_none() && year.retracted_sun.is_none()
        }
        _ => false,
    };
    nought.then(|| Estimate::exact(0.0))
}

fn read(three: &[Value; 3], key: &str) -> Option<Estimate> {
    let [own, less, more] = three.each_ref().map(|one| metrics::number(one, key));
    let (own, less, more) = (own?, less?, more?);
    Some(Estimate { value: own, error: (less - own).abs().max((more - own).abs()) })
}

/// Why figures are approximate beyond their errors.
fn doubts(product: &Product, year: &Year) -> Vec<String> {
    let mut list = Vec::new();
    if product.provenance.origin == Origin::Measured {
        list.push("measuring error not stated".to_owned());
    }
    let mut codes: Vec<&str> = product
        .findings
        .iter()
        .filter(|finding| finding.severity >= Severity::Warning)
        .filter(|finding| product.system.is_empty() || finding.code != COMPUTED)
        .map(|finding| finding.code.as_str())
        .collect();
    codes.sort_unstable();
    codes.dedup();
    if !codes.is_empty() {
        list.push(format!("data: {}", codes.join(", ")));
    }
    if let Some(solar) = &year.solar
        && solar.source() != SolarSource::Own
    {
        list.push(format!("solar: {}", solar.source().words()));
    }
    if year.lm83.as_ref().is_some_and(|lm83| lm83.groups.iter().any(|group| group.states.is_none())) {
        list.push(format!("LM-83: a shade of {:.0} % stands in for blinds", 100.0 * SHADE));
    }
    let (light, errors): (f64, f64) = (year.light.values.iter().sum(), year.light.errors.iter().sum());
    if errors > DOUBTFUL * light {
        list.push(format!("light known to {:.0} %", 100.0 * errors / light));
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_keep_the_digits_of_a_table() {
        assert_eq!(
            [0.1 + 0.2, 0.0, 123_456_789.44, 1e-12 / 3.0].map(as_written),
            [0.3, 0.0, 123_456_789.0, 3.333_333_33e-13]
        );
    }
}
