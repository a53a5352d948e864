//! Run of the virtual goniophotometer over the states of a described system: its settings, its results, its files.

use crate::app::shell::disk::{ends_in, write_several, write_whole};
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::JobState;
use crate::catalogue::{Catalogue, CatalogueError, NewProduct};
use crate::compute::basis::{AzimuthMap, RingBasis};
use crate::compute::btdf::Dataset;
use crate::compute::system::measure::Quality;
use crate::formats::{Format, write_dataset};
use crate::study::Library;
use crate::study::compact::stored_by_default;
use crate::study::goniophotometer::{Described, Request};
use crate::texts::{Text, goniophotometer as texts};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Seed of random numbers.
const SEED: u64 = 1;
/// Number of emergent cells above which computed states are compressed by wavelets, since many states at 1° would fill
/// the memory.
const MOST_WHOLE_CELLS: usize = 1000;

/// Basis of the incident directions in a computation of the virtual goniophotometer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Incidence {
    /// Klems full basis (LBNL), 145 patches.
    Klems,
    /// 145 Tregenza patches about the façade's normal.
    Tregenza,
}

/// Basis of the emergent directions in a computation of the virtual goniophotometer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Emergence {
    /// Klems full basis (LBNL), 145 patches.
    Klems,
    /// Division into cells of uniform width. \[°\]
    Even(u8),
}

impl Incidence {
    /// All bases for the incident directions.
    pub const ALL: [Self; 2] = [Self::Klems, Self::Tregenza];

    /// Returns the label of the basis.
    pub const fn word(self) -> Text {
        match self {
            Self::Klems => texts::KLEMS,
            Self::Tregenza => texts::TREGENZA,
        }
    }
}

impl Emergence {
    /// Bases of the emergent directions that the sheet offers.
    pub const ALL: [Self; 4] = [Self::Klems, Self::Even(5), Self::Even(2), Self::Even(1)];

    /// Returns the label of the basis.
    pub fn word(self) -> String {
        match self {
            Self::Klems => texts::KLEMS.into(),
            Self::Even(degrees) => texts::cells(degrees),
        }
    }
}

/// Settings of a computation by the virtual goniophotometer: bases and allowed error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setup {
    /// Basis of the incident directions.
    pub incidence: Incidence,
    /// Basis of the emergent directions.
    pub emergence: Emergence,
    /// Absolute error allowed in τ and ρ of any incident direction.
    pub error: f64,
}

impl Default for Setup {
    fn default() -> Self {
        Self { incidence: Incidence::Klems, emergence: Emergence::Klems, error: 0.01 }
    }
}

impl Setup {
    /// Returns the request to the study with these settings.
    pub fn request(&self) -> Request {
        let klems = || RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        Request {
            incident: match self.incidence {
                Incidence::Klems => klems(),
                Incidence::Tregenza => RingBasis::tregenza(),
            },
            emergent: match self.emergence {
                Emergence::Klems => klems(),
                Emergence::Even(degrees) => RingBasis::even(f64::from(degrees).to_radians()),
            },
            error: self.error,
            seed: SEED,
        }
    }
}

/// Computed state of a described system.
#[derive(Debug, Clone)]
pub struct Finished {
    /// Dataset with the four functions of the state.
    pub dataset: Arc<Dataset>,
    /// Direct-hemispherical visible transmittance at normal incidence.
    pub tau_normal: f64,
    /// Energy balance, reciprocity and estimated error of the computed data.
    pub quality: Option<Quality>,
    /// Computing time of the state. \[s\]
    pub seconds: f64,
}

/// Run of the virtual goniophotometer over all states of a described system.
#[derive(Debug, Clone)]
pub struct Run {
    /// Described system that is computed.
    pub described: Arc<Described>,
    /// Bases and accuracy of the run.
    pub setup: Setup,
    /// Keys of the states; `None` until the first job has determined them.
    pub states: Option<Vec<String>>,
    /// Finished states, in the order of `states`.
    pub finished: Vec<Finished>,
}

impl Run {
    /// Whether all states are finished.
    pub fn complete(&self) -> bool {
        self.states.as_ref().is_some_and(|states| states.len() == self.finished.len())
    }
}

/// Computes the next state of a run after the finished ones. Returns the keys of all states, and the computed state.
pub fn next_state(run: &Run, library: &Library, job: &JobState) -> Result<(Vec<String>, Finished), AppError> {
    let states = match &run.states {
        Some(states) => states.clone(),
        None => run.described.states(library)?,
    };
    let state = states.get(run.finished.len()).ok_or(AppError::NoStates)?;
    let request = run.setup.request();
    let computed = run.described.measure(state, &request, library, None, job)?;
    let tau_normal = computed.dataset.transmission().map_or(0.0, crate::compute::btdf::Btdf::tau_normal);
    let dataset =
        if request.emergent.len() > MOST_WHOLE_CELLS { stored_by_default(&computed.dataset) } else { computed.dataset };
    let finished =
        Finished { dataset: Arc::new(dataset), tau_normal, quality: computed.quality, seconds: computed.seconds };
    Ok((states, finished))
}

/// Returns the product with name, kind and provenance as which the states of a run are stored.
pub fn product(run: &Run) -> NewProduct {
    // Names depend on the states alone, the description on what every state was computed from.
    let named = |finished: &Finished| Dataset {
        state: finished.dataset.state.clone(),
        described: finished.dataset.described.clone(),
        ..Dataset::default()
    };
    let names: Vec<Dataset> = run.finished.iter().map(named).collect();
    run.described.product(&run.setup.request(), &names)
}

fn package(run: &Run) -> Result<Vec<u8>, CatalogueError> {
    let datasets: Vec<Dataset> = run.finished.iter().map(|one| (*one.dataset).clone()).collect();
    let mut catalogue = Catalogue::empty_in_memory()?;
    let imported = catalogue.import(&datasets, product(run))?;
    catalogue.export_package(&[imported.key])
}

/// Returns the paths of the files that [`export`] writes.
pub fn targets(run: &Run, path: &Path) -> Vec<PathBuf> {
    if ends_in(path, "cfsp") || run.finished.len() < 2 {
        return vec![path.to_owned()];
    }
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let stem = Format::stem(&name);
    let of_state = |state: &str| path.with_file_name(format!("{stem}_{state}{}", &name[stem.len()..]));
    run.finished.iter().map(|one| of_state(&one.dataset.state)).collect()
}

/// Writes all states of a run: one package (.cfsp), or one file per state (.xml, .btdf.txt), with the state in its name
/// if there are several. `made_from`: input files, which are never overwritten.
pub fn export(run: &Run, path: &Path, made_from: &[PathBuf]) -> Result<PathBuf, AppError> {
    let about_path = |error: AppError| error.about(path.display());
    if ends_in(path, "cfsp") {
        return write_whole(path, &package(run).map_err(|error| about_path(error.into()))?, made_from);
    }
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let format = Format::from_name(&name).ok_or_else(|| about_path(AppError::MeasuredEnding))?;
    let mut files = Vec::new();
    for (one, path) in run.finished.iter().zip(targets(run, path)) {
        let written = write_dataset(format, std::slice::from_ref(&*one.dataset));
        files.push((path, written.map_err(|error| about_path(error.into()))?.bytes));
    }
    write_several(&files, made_from)?;
    Ok(path.to_owned())
}
