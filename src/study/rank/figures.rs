//! Annual figures of the ranked products, with their errors: computed with patch-averaged data first, then with sharp
//! beams.

use super::candidate::with_product;
use super::parts::{Grouping, Parts};
use super::question::Group;
use crate::catalogue::{Origin, Product};
use crate::compute::btdf::{Severity, SolarSource};
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::year::StepTable;
use crate::study::error::StudyError;
use crate::study::scene_file::Interpolation;
use crate::study::session::Session;
use crate::study::system::SystemLibrary;
use crate::study::year::{Climate, Dgp, Entry, Light, SHADE, Settings, Year, figures, metric, metrics, year_in};

/// Annual figures of one product in a ranking. They do not depend on weights and scale limits.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Found {
    /// Values of the figures with their errors, in the order of the list's keys; rounded to nine significant digits as
    /// in tables.
    pub figures: Vec<Estimate>,
    /// Contributions to each figure by season, sun and zone, in the same order.
    pub parts: Vec<Parts>,
    /// Reasons why the figures are less certain than their errors say; empty if there are none.
    pub approximate: Vec<String>,
}

/// Result of computing a product in a ranking: its figures, or the reason why it is excluded.
pub type Outcome = Result<Found, String>;

/// Stage of computing a product: coarse first, then full.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Year with data that are taken as constant on their patches, as with `compute.interpolation = "patch"`. The
    /// errors include the uncertainty by this.
    Coarse,
    /// Year with the interpolation that the scene asks for.
    Full,
}

/// Relative error of illuminances behind patch-averaged data, because they blur beams. Found with the built-in prisms,
/// whose beams are as wide as patches: the share of hours above 3000 lx at two sensors is 0.289 by patches and 0.267 by
/// beams, a difference that 8 % more light makes.
const BLURRED: f64 = 0.1;
/// Key of the error about a figure that a year does not have.
const NO_FIGURE: &str = "rank.objective";
/// Code of the finding on the accuracy of data that are computed from a description. It is ignored, because such data
/// may still be missing on one machine and exist on another; the figures' errors include it, or the description itself
/// was evaluated.
const COMPUTED: &str = "error-target-missed";
/// Relative error of the illuminances above which figures count as approximate.
const MAX_RELATIVE_ERROR: f64 = 0.05;

/// Rounds a number to nine significant digits, the number of digits in tables, so that a ranking from tables is the
/// same.
pub(super) fn as_written(value: f64) -> f64 {
    format!("{value:.8e}").parse().unwrap_or(value)
}

/// Input with which all products of a list are computed.
pub(super) struct Setting<'a> {
    pub group: &'a Group,
    pub climate: &'a Climate,
    /// Climate of the coarse stage: without figures that blurred light does not determine, glare and blinds that are
    /// operated by direct sun on the sensors.
    pub by_cells: &'a Climate,
    pub grouping: &'a Grouping,
    pub library: &'a dyn SystemLibrary,
    pub session: &'a Session,
}

impl Setting<'_> {
    /// Computes the figures of one product in one stage.
    ///
    /// # Errors
    /// Returns an error for wrong data or control of the product, for a figure that the year does not have, or if
    /// cancelled.
    pub fn product(&self, product: &Product, stage: Stage, progress: &dyn Progress) -> Result<Found, StudyError> {
        let group = self.group;
        let mut file = with_product(&group.file, product, group.control)?;
        let coarse = stage == Stage::Coarse && file.compute.interpolation != Interpolation::Patch;
        if coarse {
            file.compute.interpolation = Interpolation::Patch;
        }
        let climate = if coarse { self.by_cells } else { self.climate };
        let mut year = year_in(climate, &file, &group.base, self.library, self.session, &|_| true, progress)?;
        let mut found = Found { approximate: approximation_reasons(product, &year), ..Found::default() };
        if coarse {
            blur(&mut year);
        }
        let all = metrics(&year, &figures(&year));
        for (key, objective) in group.figures.iter().zip(&group.objectives) {
            // Figures that blurred light does not determine may be anything between the scale limits.
            let between = || {
                let (a, b) = (objective.worst, objective.best);
                Estimate { value: 0.5 * (a + b), error: 0.5 * (b - a).abs() }
            };
            let figure = match figure(&year, &all, key) {
                // Nor does it determine the states of a control that reads the room.
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

    /// Checks that a year of this list can have the figures that the list needs, before all products are computed in
    /// vain. A year without light has most of them; whether the data provide a missing one is checked with the list's
    /// first product.
    ///
    /// # Errors
    /// Returns an error that names the missing figure and the existing ones, or if cancelled.
    pub fn check(&self, first: &Product, progress: &dyn Progress) -> Result<(), StudyError> {
        let year = dark(self.climate);
        let all = metrics(&year, &figures(&year));
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

/// Adds the error by blurring beams in patch-averaged data to the errors of a year.
fn blur(year: &mut Year) {
    let more = |error: f64, value: f64| error + BLURRED * value;
    year.light.errors = year.light.errors.with(&year.light.values, more);
    if let Some(own) = &mut year.lm83 {
        own.errors = own.errors.with(&own.values, more);
    }
    if let Some(own) = &mut year.solar {
        own.errors.iter_mut().zip(&own.watts).for_each(|(error, watts)| *error = more(*error, *watts));
    }
}

/// Returns a year without any light, in a room with an aperture that would transmit direct sun.
fn dark(climate: &Climate) -> Year {
    let steps = climate.steps.list.len();
    let places = climate.settings.sensors + climate.settings.eyes.len();
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
        light: Light { sun: Some(StepTable::zeros(steps, places, 0)), ..Light::zeros(steps, places, 0, 0) },
        retracted_sun: None,
        direct_sun: true,
        lm83: None,
        solar: None,
        dgp: (climate.settings.keys.dgp && eyes > 0).then(dgp),
        notes: Vec::new(),
        spent: Vec::new(),
    }
}

/// Returns an annual figure of a year by its key, with its error. `metrics`: metrics of the year.
fn figure(year: &Year, metrics: &[Entry], key: &str) -> Result<Estimate, StudyError> {
    if let Some(figure) = metrics.iter().find(|entry| entry.key() == key).and_then(Entry::estimate) {
        return Ok(figure);
    }
    if metric(key).is_some_and(|(metric, _)| metric.is_zero(year)) {
        return Ok(Estimate::exact(0.0));
    }
    let stated = metrics.iter().filter(|entry| entry.estimate().is_some()).map(Entry::key);
    let keys = stated.collect::<Vec<_>>().join(", ");
    Err(StudyError::key(NO_FIGURE, format!("the year has no figure \"{key}\"; it has: {keys}")))
}

/// Returns the reasons why the figures of a product are less certain than their errors say.
fn approximation_reasons(product: &Product, year: &Year) -> Vec<String> {
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
    let (light, errors): (f64, f64) = (year.light.values.values().sum(), year.light.errors.values().sum());
    if errors > MAX_RELATIVE_ERROR * light {
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
