//! Figures of a product in a list, with their errors: of typical days first, then of the whole year.

use super::candidate::with_product;
use super::parts::{Grouping, Parts};
use super::question::Group;
use crate::catalogue::{Origin, Product};
use crate::compute::btdf::{Severity, SolarSource};
use crate::compute::estimate::{Estimate, Progress};
use crate::study::error::StudyError;
use crate::study::session::Session;
use crate::study::system::SystemLibrary;
use crate::study::year::{Climate, Dgp, Light, SHADE, Step, Way, Year, figures, metrics, year_in};
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
    /// Typical days: two of each month. Errors hold what they leave open.
    Coarse,
    /// The whole year.
    Full,
}

/// Days of every month that stand for it while results are coarse; what they differ by tells how well they do.
const TYPICAL: [i8; 2] = [8, 22];
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
        let file = with_product(&group.file, product, group.control)?;
        let wanted = |step: &Step| stage == Stage::Full || TYPICAL.contains(&step.time.day());
        let year = year_in(self.climate, &file, &group.base, self.library, self.session, &wanted, progress)?;
        let area = group.file.room.width * group.file.room.depth;
        let all = three(&year, area);
        let pairs = if stage == Stage::Coarse { pairs(&year, area) } else { Vec::new() };
        let mut found = Found { approximate: doubts(product, &year), ..Found::default() };
        for (key, objective) in group.figures.iter().zip(&group.objectives) {
            let figure = match stage {
                Stage::Full => figure(&year, &all, key)?,
                // What typical days do not tell may be anything between the anchors.
                Stage::Coarse => coarse(&year, &all, &pairs, key).or_else(|| nought(&year, key)).unwrap_or_else(|| {
                    let (a, b) = (objective.worst, objective.best);
                    Estimate { value: 0.5 * (a + b), error: 0.5 * (b - a).abs() }
                }),
            };
            found.figures.push(Estimate { value: as_written(figure.value), error: as_written(figure.error) });
            let mut parts = if stage == Stage::Full { self.grouping.parts(&year, key) } else { Parts::default() };
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

/// A year without any light in a room with a window to see the sun through.
fn dark(climate: &Climate) -> Year {
    let steps = climate.steps.list.len();
    let places = climate.settings.sensors + climate.settings.eyes.len();
    let nothing = vec![0.0; places * steps];
    let eyes = climate.settings.eyes.len();
    let dgp = || Dgp { eyes, values: vec![Some(Estimate::exact(0.0)); eyes * steps], unproven: 0 };
    Year {
        settings: climate.settings.clone(),
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
            way: Way::Coefficients,
            sets: 0,
            dark: steps,
        },
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
        "ASE1000_250" | "sun_hours_1000" => still && year.steps.whole && year.light.sun.is_none(),
        _ => false,
    };
    nought.then(|| Estimate::exact(0.0))
}

fn read(three: &[Value; 3], key: &str) -> Option<Estimate> {
    let [own, less, more] = three.each_ref().map(|one| metrics::number(one, key));
    let (own, less, more) = (own?, less?, more?);
    Some(Estimate { value: own, error: (less - own).abs().max((more - own).abs()) })
}

/// A figure of the year by typical days; `None` where days do not tell it. Its error has twice the standard error of a mean
/// over months of each two days added: (Σ (a − b)²/4)^½ / number of months.
fn coarse(year: &Year, three: &[Value; 3], pairs: &[[Value; 2]], key: &str) -> Option<Estimate> {
    // Sums are of a year, whatever was computed of it.
    let (key, sum) = match key {
        "lighting.LENI_kWh_m2" => ("lighting.kWh_m2", true),
        "lighting.kWh_m2" | "lighting.kWh" => (key, true),
        key => (key, false),
    };
    let all = year.steps.list.len() as f64 * year.steps.length;
    let scale = |metrics: &Value| Some(if sum { all / metrics::number(metrics, "hours")? } else { 1.0 });
    let own = read(three, key)? * scale(&three[0])?;
    let at = |metrics: &Value| Some(metrics::number(metrics, key)? * scale(metrics)?);
    let squares: Option<f64> = pairs.iter().map(|[a, b]| Some((at(a)? - at(b)?).powi(2) / 4.0)).sum();
    let spread = squares?.sqrt() / pairs.len().max(1) as f64;
    Some(Estimate { value: own.value, error: own.error + 2.0 * spread })
}

/// Metrics of the typical days alone, in pairs by month, of the months that have both.
fn pairs(year: &Year, area: f64) -> Vec<[Value; 2]> {
    let day = |month: u8, day: i8| {
        let on = |row: &usize| {
            let step = &year.steps.list[year.chosen[*row]];
            step.month == month && step.time.day() == day
        };
        let rows: Vec<usize> = (0..year.chosen.len()).filter(on).collect();
        let part = part(year, &rows);
        (!rows.is_empty()).then(|| metrics::metrics(&part, &figures(&part)[0], area))
    };
    (1..=12).filter_map(|month| Some([day(month, TYPICAL[0])?, day(month, TYPICAL[1])?])).collect()
}

/// Some rows of a year, with what figures ask of it.
fn part(year: &Year, rows: &[usize]) -> Year {
    let places = year.light.places;
    let of = |values: &[f64]| -> Vec<f64> {
        rows.iter().flat_map(|row| values[row * places..][..places].iter().copied()).collect()
    };
    Year {
        settings: year.settings.clone(),
        steps: year.steps.clone(),
        moving: year.moving.clone(),
        states: Vec::new(),
        movements: year.movements.clone(),
        indoor: None,
        chosen: rows.iter().map(|&row| year.chosen[row]).collect(),
        light: Light {
            places,
            values: of(&year.light.values),
            errors: of(&year.light.errors),
            sun: year.light.sun.as_deref().map(of),
            way: year.light.way,
            sets: year.light.sets,
            dark: year.light.dark,
        },
        lm83: year.lm83.as_ref().map(|lm83| lm83.only(rows)),
        solar: year.solar.clone().map(|mut solar| {
            solar.watts = rows.iter().map(|&row| solar.watts[row]).collect();
            solar.errors = rows.iter().map(|&row| solar.errors[row]).collect();
            solar
        }),
        dgp: year.dgp.clone().map(|mut dgp| {
            dgp.values = rows.iter().flat_map(|&row| dgp.row(row).to_vec()).collect();
            dgp
        }),
        notes: Vec::new(),
        spent: Vec::new(),
    }
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
