//! Error against run time of a year: the same year with rising effort, each beside the finest.
//!
//! What is measured is how far the computation has converged, not what weather, sky model or data leave out. Compared are the
//! illuminances of all hours at all sensors and eyes, and the figures that the year comes to. Each year is timed by itself, with
//! nothing known before, on all processors.

use super::{Coverage, Errors};
use crate::compute::estimate::{Cancelled, Progress};
use crate::study::error::StudyError;
use crate::study::scene_file::SceneFile;
use crate::study::session::Session;
use crate::study::system::SystemLibrary;
use crate::study::year::{Climate, Step, Year, climate, figures, metrics, year_in};
use serde_json::Value;
use std::path::Path;
use std::time::Instant;

/// Error targets of a year, the last one is the finest: what the others are measured by.
const TARGETS: [f64; 4] = [0.1, 0.03, 0.01, 0.003];
/// Hours darker than this share of the mean at a sensor do not count.
const DARK: f64 = 0.01;
/// Figures that are told.
const FIGURES: [&str; 7] =
    ["annual_mean_lx", "DA300", "UDI_a", "sDA300_50", "sDA300_50_LM83_12", "lighting.LENI_kWh_m2", "lighting.kWh_m2"];

/// A figure at one effort.
#[derive(Debug, Clone, PartialEq)]
pub struct YearFigure {
    /// Its key; of a list its mean.
    pub key: &'static str,
    /// What the year says.
    pub value: f64,
    /// How far that may be off, as stated.
    pub stated: f64,
    /// Distance from the finest year's.
    pub real: f64,
}

/// One year.
#[derive(Debug, Clone, PartialEq)]
pub struct YearRung {
    /// Relative error that was asked for; `None`: as the scene has it.
    pub target: Option<f64>,
    /// From nothing to the last hour. \[s\]
    pub seconds: f64,
    /// How long its stages took. \[s\]
    pub stages: Vec<(&'static str, f64)>,
    /// Of every hour at every sensor and eye that is not dark, relative to the finest; none in the finest itself.
    pub errors: Vec<Errors>,
    /// Mean of the stated errors, relative to the light of all hours.
    pub stated: f64,
    /// What the year comes to.
    pub figures: Vec<YearFigure>,
}

impl YearRung {
    /// Root of the mean square of the distances from the finest.
    pub fn rms(&self) -> f64 {
        (self.errors.iter().map(|e| e.real * e.real).sum::<f64>() / self.errors.len().max(1) as f64).sqrt()
    }

    /// Largest distance from the finest.
    pub fn max(&self) -> f64 {
        self.errors.iter().map(|e| e.real).fold(0.0, f64::max)
    }

    /// What the stated errors of the hours are worth; `None` of the finest itself.
    pub fn coverage(&self) -> Option<Coverage> {
        (!self.errors.is_empty()).then(|| Coverage::of(&self.errors))
    }
}

/// The whole comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct YearAccuracy {
    /// By rising effort; the last one is what the others are measured by.
    pub rungs: Vec<YearRung>,
    /// Hours that were computed, and those of them with light.
    pub steps: [usize; 2],
    /// Sensors and eyes.
    pub places: usize,
    /// Threads that the times are of.
    pub threads: usize,
}

/// Hands on that the work is not wanted any more; its own steps are the ladder's.
pub(super) struct Inner<'a>(pub &'a dyn Progress);

impl Progress for Inner<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

/// The year of a scene by rising effort. Takes as long as five years.
///
/// # Errors
/// As [`crate::study::year::year`].
pub fn annual(
    file: &SceneFile,
    base: &Path,
    library: &dyn SystemLibrary,
    wanted: &dyn Fn(&Step) -> bool,
    progress: &dyn Progress,
) -> Result<YearAccuracy, StudyError> {
    let climate = climate(file, base)?;
    let targets = targets(file.compute.error_target);
    let mut years = Vec::with_capacity(targets.len());
    for (k, target) in targets.iter().enumerate() {
        if progress.cancelled() {
            return Err(Cancelled.into());
        }
        progress.advance("accuracy", k, targets.len());
        years.push(timed(&climate, file, base, library, *target, wanted, &Inner(progress))?);
    }
    let Some((finest, _)) = years.last() else { return Err(Cancelled.into()) };
    let area = file.room.width * file.room.depth;
    let last = told(finest, area);
    let rungs = years
        .iter()
        .zip(&targets)
        .enumerate()
        .map(|(k, ((year, seconds), &target))| YearRung {
            target,
            seconds: *seconds,
            stages: year.spent.iter().map(|(stage, time)| (*stage, time.as_secs_f64())).collect(),
            errors: if k + 1 == targets.len() { Vec::new() } else { errors(year, finest) },
            stated: year.light.errors.iter().sum::<f64>()
                / year.light.values.iter().sum::<f64>().max(f64::MIN_POSITIVE),
            figures: beside(told(year, area), &last),
        })
        .collect();
    let steps = [finest.chosen.len(), finest.chosen.len() - finest.light.dark];
    Ok(YearAccuracy { rungs, steps, places: finest.light.places, threads: rayon::current_num_threads() })
}

/// Error targets by rising effort. The scene's own, where it names one, is a line of its own; so is none.
pub(super) fn targets(own: Option<f64>) -> Vec<Option<f64>> {
    let mut targets: Vec<Option<f64>> = TARGETS.into_iter().map(Some).collect();
    if !targets.contains(&own) {
        let place = own.map_or(0, |own| TARGETS.iter().filter(|target| **target > own).count());
        // The last is what all are measured by.
        targets.insert(place.min(TARGETS.len() - 1), own);
    }
    targets
}

fn timed(
    climate: &Climate,
    file: &SceneFile,
    base: &Path,
    library: &dyn SystemLibrary,
    target: Option<f64>,
    wanted: &dyn Fn(&Step) -> bool,
    progress: &dyn Progress,
) -> Result<(Year, f64), StudyError> {
    let mut file = file.clone();
    file.compute.error_target = target;
    let clock = Instant::now();
    let year = year_in(climate, &file, base, library, &Session::new(), wanted, progress)?;
    Ok((year, clock.elapsed().as_secs_f64()))
}

/// Of every lit hour at every place, relative to the finest. States are the same: controls see the outside alone, but for those
/// that read the room.
fn errors(year: &Year, finest: &Year) -> Vec<Errors> {
    let (own, last) = (&year.light, &finest.light);
    let lit = last.values.iter().filter(|value| **value > 0.0).count();
    let least = DARK * last.values.iter().sum::<f64>() / lit.max(1) as f64;
    let of = |k: usize| {
        let value = last.values[k];
        (value > least).then(|| Errors {
            stated: own.errors[k] / value,
            real: (own.values[k] - value).abs() / value,
            open: last.errors[k] / value,
        })
    };
    (0..last.values.len()).filter_map(of).collect()
}

/// Values of the figures, with what the hours' errors leave open of them.
fn told(year: &Year, area: f64) -> Vec<YearFigure> {
    let all: [Value; 3] = figures(year).map(|one| metrics::metrics(year, &one, area));
    let of = |key: &'static str| {
        let [Some(value), Some(less), Some(more)] = all.each_ref().map(|one| metrics::number(one, key)) else {
            return None;
        };
        let stated = (less - value).abs().max((more - value).abs());
        Some(YearFigure { key, value, stated, real: 0.0 })
    };
    FIGURES.into_iter().filter_map(of).collect()
}

fn beside(mut own: Vec<YearFigure>, last: &[YearFigure]) -> Vec<YearFigure> {
    for figure in &mut own {
        let finest = last.iter().find(|other| other.key == figure.key);
        figure.real = finest.map_or(0.0, |finest| (figure.value - finest.value).abs());
    }
    own
}
