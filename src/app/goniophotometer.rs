//! The sheet of the numerical goniophotometer: the system file as typed, what is asked, the states that are finished.
//!
//! Every state is a job of its own, so that finished ones show at once and stay when the run is stopped.

use super::disk::{ends_in, write_several, write_whole};
use super::error::AppError;
use super::jobs::JobState;
use crate::catalogue::{Catalogue, CatalogueError, NewProduct};
use crate::compute::basis::{AzimuthMap, RingBasis};
use crate::compute::btdf::Dataset;
use crate::compute::system::SystemKind;
use crate::compute::system::measure::Quality;
use crate::formats::{Format, write_dataset};
use crate::study::Library;
use crate::study::compact::stored_by_default;
use crate::study::goniophotometer::{Base, Described, Request};
use crate::texts::{Text, goniophotometer as texts};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Seed of what is drawn at random.
const SEED: u64 = 1;
/// States on more emergent cells than this are held in compact form: a family at 1° would fill the memory.
const MOST_WHOLE_CELLS: usize = 1000;

/// Incident cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Incidence {
    /// LBNL/Klems Full.
    Klems,
    /// Tregenza's lattice on the façade.
    Tregenza,
}

/// Emergent cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Emergence {
    /// LBNL/Klems Full.
    Klems,
    /// Even cells of this width. \[°\]
    Even(u8),
}

impl Incidence {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Klems, Self::Tregenza];

    /// As listed.
    pub const fn word(self) -> Text {
        match self {
            Self::Klems => texts::KLEMS,
            Self::Tregenza => texts::TREGENZA,
        }
    }
}

impl Emergence {
    /// What is listed.
    pub const ALL: [Self; 4] = [Self::Klems, Self::Even(5), Self::Even(2), Self::Even(1)];

    /// As listed.
    pub fn word(self) -> String {
        match self {
            Self::Klems => texts::KLEMS.into(),
            Self::Even(degrees) => texts::cells(degrees),
        }
    }
}

/// On which cells, and how exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setup {
    /// Incident cells.
    pub incidence: Incidence,
    /// Emergent cells.
    pub emergence: Emergence,
    /// Absolute error allowed in τ and ρ of any incidence.
    pub error: f64,
}

impl Default for Setup {
    fn default() -> Self {
        Self { incidence: Incidence::Klems, emergence: Emergence::Klems, error: 0.01 }
    }
}

impl Setup {
    /// For the study.
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

/// A finished state.
#[derive(Debug, Clone)]
pub struct Finished {
    /// The four functions.
    pub dataset: Arc<Dataset>,
    /// Transmittance at normal incidence.
    pub tau_normal: f64,
    /// Balance, reciprocity, error.
    pub quality: Option<Quality>,
    /// Time it took. \[s\]
    pub seconds: f64,
}

/// A run of all states of one text.
#[derive(Debug, Clone)]
pub struct Run {
    /// What is measured.
    pub described: Arc<Described>,
    /// On which cells.
    pub setup: Setup,
    /// Keys of the states; `None` until the first job has found them.
    pub states: Option<Vec<String>>,
    /// Finished ones, in order.
    pub finished: Vec<Finished>,
}

impl Run {
    /// Are all states finished?
    pub fn complete(&self) -> bool {
        self.states.as_ref().is_some_and(|states| states.len() == self.finished.len())
    }
}

/// What the sheet holds. Not under undo: nothing of it is in the catalogue before it is added.
#[derive(Debug, Default)]
pub struct Bench {
    /// The system file as typed.
    pub text: String,
    /// What the text names other files relative to.
    pub base: PathBuf,
    /// The text as read, or what is wrong with it; `None` while there is none.
    pub described: Option<Result<Arc<Described>, AppError>>,
    /// Counts the texts.
    pub revision: u64,
    /// Number of the state that is drawn.
    pub drawn: usize,
    /// On which cells.
    pub setup: Setup,
    /// The last run.
    pub run: Option<Run>,
    /// Why the last run ended early.
    pub failure: Option<String>,
}

impl Bench {
    /// Takes a new text.
    pub fn set_text(&mut self, text: String) {
        self.revision += 1;
        self.described = (!text.trim().is_empty()).then(|| check(&text, self.base.clone()).map(Arc::new));
        self.text = text;
        self.drawn = self.drawn.min(self.states().len().saturating_sub(1));
    }

    /// The text as read, if it is right.
    pub fn valid(&self) -> Option<&Arc<Described>> {
        self.described.as_ref()?.as_ref().ok()
    }

    /// Keys of the states that can be drawn.
    pub fn states(&self) -> Vec<String> {
        self.valid().map(|described| described.file.system.states()).unwrap_or_default()
    }

    /// Does the last run belong to what is asked now?
    pub fn is_current(&self, run: &Run) -> bool {
        run.setup == self.setup && self.valid().is_some_and(|described| *described == run.described)
    }
}

/// Reads a text and tries its geometry, which only building the system shows to be possible.
fn check(text: &str, base: PathBuf) -> Result<Described, AppError> {
    let described = Described::from_text(text, Base::Folder(base))?;
    let system = &described.file.system;
    if !matches!(system.kind, SystemKind::Stack(_)) {
        let nothing_else = Library::default();
        for state in system.states() {
            described.specimen(&state, &nothing_else)?;
        }
    }
    Ok(described)
}

/// Measures the state after those that are finished.
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

/// What is stored with the states.
pub fn product(run: &Run) -> NewProduct {
    // Names hang on the states alone, the description on what every state was computed from.
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

/// The files that [`export`] writes for a path.
pub fn targets(run: &Run, path: &Path) -> Vec<PathBuf> {
    if ends_in(path, "cfsp") || run.finished.len() < 2 {
        return vec![path.to_owned()];
    }
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let stem = Format::stem(&name);
    let of_state = |state: &str| path.with_file_name(format!("{stem}_{state}{}", &name[stem.len()..]));
    run.finished.iter().map(|one| of_state(&one.dataset.state)).collect()
}

/// Writes all states: one package (.cfsp), or a file a state (.xml, .btdf.txt), named by the states if there are several.
pub fn export(run: &Run, path: &Path, made_from: &[PathBuf]) -> Result<PathBuf, AppError> {
    let told = |error: AppError| error.about(path.display());
    if ends_in(path, "cfsp") {
        return write_whole(path, &package(run).map_err(|error| told(error.into()))?, made_from);
    }
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let format = Format::from_name(&name).ok_or_else(|| told(AppError::MeasuredEnding))?;
    let mut files = Vec::new();
    for (one, path) in run.finished.iter().zip(targets(run, path)) {
        let written = write_dataset(format, std::slice::from_ref(&*one.dataset));
        files.push((path, written.map_err(|error| told(error.into()))?.bytes));
    }
    write_several(&files, made_from)?;
    Ok(path.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::examples::EXAMPLES;

    #[test]
    fn a_wrong_key_is_told_at_once() {
        let mut bench = Bench::default();
        bench.set_text(EXAMPLES[0].text.to_owned());
        assert_eq!(bench.states().len(), 8);
        bench.drawn = 7;
        bench.set_text(EXAMPLES[0].text.replace("step = 15", "step = 35"));
        assert_eq!((bench.states().len(), bench.drawn), (4, 3));
        bench.set_text(EXAMPLES[0].text.replace("reflectance = 0.50", "reflectance = 5"));
        let error = bench.described.as_ref().unwrap().as_ref().unwrap_err().to_string();
        assert!(error.contains("venetian.lower.reflectance: 5; expected 0 to 1"), "{error}");
        // Keys that are right one by one, and a slat that cannot be.
        bench.set_text(EXAMPLES[0].text.replace("spacing = 0.072", "spacing = 900"));
        let error = bench.described.as_ref().unwrap().as_ref().unwrap_err().to_string();
        assert!(error.contains("spacing"), "{error}");
        bench.set_text("  \n".to_owned());
        assert!(bench.described.is_none() && bench.states().is_empty());
    }
}
