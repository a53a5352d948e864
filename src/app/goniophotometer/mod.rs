//! The virtual goniophotometer of the window: scattering data computed from a description of geometry and materials.
//!
//! Every state is computed by a separate job, so that finished ones are shown at once and stay when the run is stopped.

pub mod examples;
pub mod run;

use super::shell::Shell;
use super::state::Sheet;
use crate::app::catalogue::shelf::Addition;
use crate::app::results::work::Outcome;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::Lane;
use crate::app::shell::safe_name::safe;
use crate::compute::system::SystemKind;
use crate::study::Library;
use crate::study::goniophotometer::{Base, Described};
use crate::texts::goniophotometer as texts;
use examples::EXAMPLES;
use run::{Finished, Run, Setup, next_state, product, targets};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// State of the virtual goniophotometer, not covered by undo.
#[derive(Debug, Default)]
pub struct Goniophotometer {
    /// Text of the system file, as typed.
    text: String,
    /// Folder to which file names in the text are relative.
    base: PathBuf,
    /// Described system that the text defines, or its error; `None` if the text is empty.
    described: Option<Result<Arc<Described>, AppError>>,
    /// Number of changes of the text so far, by which drawings are updated.
    revision: u64,
    /// Index of the state whose section is drawn.
    drawn: usize,
    /// Selected settings: bases and allowed error.
    setup: Setup,
    /// Last run, whether finished or not.
    run: Option<Run>,
    /// Reason why the last run ended early, if it did.
    failure: Option<String>,
}

/// Reads the text of a system file, and checks its geometry by creating an optical model.
fn check(text: &str, base: PathBuf) -> Result<Described, AppError> {
    let described = Described::from_text(text, Base::Folder(base))?;
    let system = &described.file.system;
    if !matches!(system.kind, SystemKind::Stack(_)) {
        let nothing_else = Library::default();
        for state in system.states() {
            described.optical_model(&state, &nothing_else)?;
        }
    }
    Ok(described)
}

impl Goniophotometer {
    /// Returns the text of the system file, as typed.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the folder to which file names in the text are relative.
    pub fn base(&self) -> &Path {
        &self.base
    }

    /// Returns the described system that the text defines, or its error; `None` if the text is empty.
    pub const fn described(&self) -> Option<&Result<Arc<Described>, AppError>> {
        self.described.as_ref()
    }

    /// Returns the number of changes of the text so far, by which drawings are updated.
    pub const fn revision(&self) -> u64 {
        self.revision
    }

    /// Returns the index of the state whose section is drawn.
    pub const fn drawn(&self) -> usize {
        self.drawn
    }

    /// Returns the selected settings: bases and allowed error.
    pub const fn setup(&self) -> Setup {
        self.setup
    }

    /// Returns the last run, whether finished or not.
    pub const fn run(&self) -> Option<&Run> {
        self.run.as_ref()
    }

    /// Returns the reason why the last run ended early, if it did.
    pub fn failure(&self) -> Option<&str> {
        self.failure.as_deref()
    }

    /// Returns the described system, if the text is valid.
    pub fn valid(&self) -> Option<&Arc<Described>> {
        self.described.as_ref()?.as_ref().ok()
    }

    /// Returns the keys of the states that can be drawn.
    pub fn states(&self) -> Vec<String> {
        self.valid().map(|described| described.file.system.states()).unwrap_or_default()
    }

    /// Whether a run belongs to the current text and settings.
    pub fn is_current(&self, run: &Run) -> bool {
        run.setup == self.setup && self.valid().is_some_and(|described| *described == run.described)
    }

    /// Returns the proposed name of the file of the computed states.
    pub fn file_name(&self) -> String {
        let described = self.run.as_ref().map(|run| &run.described.file);
        let name = described.map(|file| if file.key.is_empty() { &file.system.name } else { &file.key });
        let name = name.map(|name| safe(&name.to_lowercase())).filter(|name| !name.is_empty());
        format!("{}.cfsp", name.unwrap_or_else(|| "system".to_owned()))
    }

    /// Returns the paths of the files that an export of the computed states to `path` writes.
    pub fn targets(&self, path: &Path) -> Vec<PathBuf> {
        self.run.as_ref().map_or_else(|| vec![path.to_owned()], |run| targets(run, path))
    }

    /// Sets a new text of the system file and reads it.
    pub fn set_text(&mut self, text: String) {
        self.revision += 1;
        self.described = (!text.trim().is_empty()).then(|| check(&text, self.base.clone()).map(Arc::new));
        self.text = text;
        self.drawn = self.drawn.min(self.states().len().saturating_sub(1));
    }

    /// Sets the text of a system file; `base`: folder to which its file names are relative.
    pub fn take_up(&mut self, text: String, base: PathBuf) {
        self.base = base;
        self.set_text(text);
    }

    /// Sets the settings: bases and allowed error.
    pub const fn set_up(&mut self, setup: Setup) {
        self.setup = setup;
    }

    /// Draws the section of the state with this index.
    pub const fn draw(&mut self, state: usize) {
        self.drawn = state;
    }

    /// Records that a run ended early, with the reason.
    pub fn fail(&mut self, reason: String) {
        self.failure = Some(reason);
    }

    /// Opens the sheet with the text of a system file; `base`: folder to which its file names are relative.
    pub fn open(&mut self, shell: &mut Shell, text: String, base: PathBuf) {
        shell.state.sheet = Some(Sheet::Goniophotometer);
        (self.drawn, self.failure) = (0, None);
        self.take_up(text, base);
    }

    /// Opens the sheet with the example of the given number (from 0).
    pub fn open_example(&mut self, shell: &mut Shell, number: usize) {
        if let Some(example) = EXAMPLES.get(number) {
            self.open(shell, example.text.to_owned(), PathBuf::new());
        }
    }

    /// Starts the computation of the described system, or resumes a stopped run.
    pub fn measure(&mut self, shell: &mut Shell) {
        shell.state.sheet = Some(Sheet::Goniophotometer);
        if shell.jobs.busy(Lane::Goniophotometer) {
            return;
        }
        let Some(described) = self.valid().cloned() else {
            shell.toasts.info(texts::DESCRIBE_FIRST_HOW);
            return;
        };
        self.failure = None;
        let resumed = self.run.take().filter(|run| self.is_current(run) && !run.complete());
        let new = || Run { described, setup: self.setup, states: None, finished: Vec::new() };
        self.run = Some(resumed.unwrap_or_else(new));
        self.measure_next_state(shell);
    }

    fn measure_next_state(&self, shell: &mut Shell) {
        let Some(run) = self.run.clone() else { return };
        let library = shell.library.clone();
        shell.start(Lane::Goniophotometer, move |job| Outcome::Measured(next_state(&run, &library, job).map(Box::new)));
    }

    /// Stores a finished state and continues with the next.
    pub fn take(&mut self, shell: &mut Shell, result: Result<Box<(Vec<String>, Finished)>, AppError>) {
        match (result, &mut self.run) {
            (Ok(measured), Some(run)) => {
                run.states = Some(measured.0);
                run.finished.push(measured.1);
                if !run.complete() {
                    self.measure_next_state(shell);
                }
            }
            (Ok(_), None) => {}
            (Err(error), _) => self.failure = Some(error.to_string()),
        }
    }

    /// Returns all states of the last run as an addition to the catalogue; says what is missing if it is not complete.
    pub fn addition(&self, shell: &mut Shell) -> Option<Addition> {
        let Some(run) = self.run.as_ref().filter(|run| run.complete()) else {
            shell.toasts.info(texts::COMPUTE_FIRST);
            return None;
        };
        let datasets = run.finished.iter().map(|one| one.dataset.clone()).collect();
        Some(Addition { datasets, product: product(run) })
    }

    /// Returns the writing of all states of the last run, to be executed in a job; `None` before there is one.
    /// `made_from`: input files, which are never overwritten.
    pub fn write_job(&self, path: PathBuf, made_from: Vec<PathBuf>) -> Option<impl FnOnce() -> Written + Send + use<>> {
        let run = self.run.clone()?;
        Some(move || run::export(&run, &path, &made_from))
    }
}

/// Path of a file that was written, or the reason why it was not.
type Written = Result<PathBuf, AppError>;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_named_by_the_system_it_holds() {
        let mut bench = Goniophotometer::default();
        assert_eq!(bench.file_name(), "system.cfsp");
        bench.set_text(EXAMPLES[0].text.to_owned());
        let described = bench.valid().unwrap().clone();
        bench.run = Some(Run { described, setup: bench.setup, states: None, finished: Vec::new() });
        assert_eq!(bench.file_name(), "venetian-blind-80-mm-curved.cfsp");
    }

    #[test]
    fn a_wrong_key_is_told_at_once() {
        let mut bench = Goniophotometer::default();
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
