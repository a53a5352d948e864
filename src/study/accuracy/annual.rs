//! Error against computing time of an annual simulation: the same year with rising effort, each compared with the
//! finest.
//!
//! The errors show how far the computation has converged, not what weather, sky model or data leave out. The
//! illuminances of all hours at all sensors and observers, and the annual figures are compared. Each year is timed
//! separately, with nothing stored before, on all processors.

use super::{Coverage, Errors};
use crate::compute::estimate::{Cancelled, Estimate, Progress};
use crate::study::error::StudyError;
use crate::study::scene_file::SceneFile;
use crate::study::session::Session;
use crate::study::system::SystemLibrary;
use crate::study::year::{Climate, Entry, Step, Year, climate, figures, metrics, year_in};
use std::path::Path;
use std::time::Instant;

/// Relative error targets of the years that are computed; the last one is the finest, the reference of the others.
const TARGETS: [f64; 4] = [0.1, 0.03, 0.01, 0.003];
/// Share of the mean illuminance below which an hour at a sensor or observer is left out.
const DARK: f64 = 0.01;
/// Annual figure (such as daylight autonomy) computed with a certain effort.
#[derive(Debug, Clone, PartialEq)]
pub struct YearFigure {
    /// Key of the figure in JSON files; of a figure that is a list the mean is compared.
    pub key: String,
    /// Value of the figure, in its unit.
    pub value: f64,
    /// Stated uncertainty of the figure, in its unit.
    pub stated: f64,
    /// Actual error: absolute difference from the value in the finest year.
    pub real: f64,
}

/// Annual simulation with a certain effort: its computing times and its errors.
#[derive(Debug, Clone, PartialEq)]
pub struct YearRung {
    /// Relative error target; `None` for a computation without one.
    pub target: Option<f64>,
    /// Computing time of the year, with nothing stored before. \[s\]
    pub seconds: f64,
    /// Computing times of the stages, by their names. \[s\]
    pub stages: Vec<(&'static str, f64)>,
    /// Errors of every hour at every sensor and observer that is not dark, relative to the illuminance in the finest
    /// year; empty for the finest year itself.
    pub errors: Vec<Errors>,
    /// Mean of the stated errors of the illuminances, relative to the mean illuminance of all hours.
    pub stated: f64,
    /// Annual figures with their errors.
    pub figures: Vec<YearFigure>,
}

impl YearRung {
    /// Returns the root mean square of the relative differences of the hourly illuminances from the finest year.
    pub fn rms(&self) -> f64 {
        (self.errors.iter().map(|e| e.real * e.real).sum::<f64>() / self.errors.len().max(1) as f64).sqrt()
    }

    /// Returns the largest relative difference of an hourly illuminance from the finest year.
    pub fn max(&self) -> f64 {
        self.errors.iter().map(|e| e.real).fold(0.0, f64::max)
    }

    /// Returns the reliability of the errors stated for the hourly illuminances; `None` for the finest year itself.
    pub fn coverage(&self) -> Option<Coverage> {
        (!self.errors.is_empty()).then(|| Coverage::of(&self.errors))
    }
}

/// Result of computing one year with rising effort.
#[derive(Debug, Clone, PartialEq)]
pub struct YearAccuracy {
    /// Annual simulations by rising effort; the last one is the reference of the others.
    pub rungs: Vec<YearRung>,
    /// Number of computed hours, and number of those with daylight.
    pub steps: [usize; 2],
    /// Number of sensors and observers together.
    pub places: usize,
    /// Number of threads with which the computing times were measured.
    pub threads: usize,
}

/// Progress of a single run, which only passes on cancellation; the steps are reported by the series of runs.
pub(super) struct Inner<'a>(pub &'a dyn Progress);

impl Progress for Inner<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

/// Computes the year of a scene with rising effort. Takes about as long as five years. `wanted`: steps of the year that
/// are computed.
///
/// # Errors
/// Returns the errors of [`crate::study::year::year`].
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
    let last = figures_with_uncertainty(finest);
    let rungs = years
        .iter()
        .zip(&targets)
        .enumerate()
        .map(|(k, ((year, seconds), &target))| YearRung {
            target,
            seconds: *seconds,
            stages: year.spent.iter().map(|(stage, time)| (*stage, time.as_secs_f64())).collect(),
            errors: if k + 1 == targets.len() { Vec::new() } else { errors(year, finest) },
            stated: year.light.errors.values().sum::<f64>()
                / year.light.values.values().sum::<f64>().max(f64::MIN_POSITIVE),
            figures: beside(figures_with_uncertainty(year), &last),
        })
        .collect();
    let steps = [finest.chosen.len(), finest.chosen.len() - finest.light.dark];
    Ok(YearAccuracy { rungs, steps, places: finest.light.places, threads: rayon::current_num_threads() })
}

/// Returns the error targets by rising effort. The scene's own target (`None` if it has none) is one of them.
pub(super) fn targets(own: Option<f64>) -> Vec<Option<f64>> {
    let mut targets: Vec<Option<f64>> = TARGETS.into_iter().map(Some).collect();
    if !targets.contains(&own) {
        let place = own.map_or(0, |own| TARGETS.iter().filter(|target| **target > own).count());
        // The last target is the reference of all.
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

/// Returns the errors of every illuminance that is not dark, by hour and by sensor or observer, relative to the finest
/// year. The states of systems are the same in both, since controls depend on outdoor conditions, except those that
/// read the room's sensors.
fn errors(year: &Year, finest: &Year) -> Vec<Errors> {
    let (own, last) = (&year.light, &finest.light);
    let lit = last.values.values().filter(|value| *value > 0.0).count();
    let least = DARK * last.values.values().sum::<f64>() / lit.max(1) as f64;
    let of = |((value, open), (own, stated)): ((f64, f64), (f64, f64))| {
        (value > least).then(|| Errors {
            stated: stated / value,
            real: (own - value).abs() / value,
            open: open / value,
        })
    };
    let [own, last] = [own, last].map(|light| light.values.values().zip(light.errors.values()));
    last.zip(own).filter_map(of).collect()
}

/// Returns the annual figures with the uncertainty that follows from the errors of the hourly illuminances.
fn figures_with_uncertainty(year: &Year) -> Vec<YearFigure> {
    let of = |entry: &Entry| {
        let Estimate { value, error } = entry.estimate()?;
        Some(YearFigure { key: entry.key(), value, stated: error, real: 0.0 })
    };
    metrics(year, &figures(year)).iter().filter(|entry| entry.metric.compared).filter_map(of).collect()
}

fn beside(mut own: Vec<YearFigure>, last: &[YearFigure]) -> Vec<YearFigure> {
    for figure in &mut own {
        let finest = last.iter().find(|other| other.key == figure.key);
        figure.real = finest.map_or(0.0, |finest| (figure.value - finest.value).abs());
    }
    own
}
