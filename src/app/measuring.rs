//! Execution of commands about the sheet of the virtual goniophotometer: loads texts, computes state after state,
//! stores the results.

use super::error::AppError;
use super::examples::EXAMPLES;
use super::goniophotometer::{Finished, Run, next_state, product};
use super::jobs::Lane;
use super::shelf::Addition;
use super::state::Sheet;
use super::window::App;
use super::work::Outcome;
use crate::texts::goniophotometer as texts;
use std::path::PathBuf;

impl App {
    /// Opens the sheet of the virtual goniophotometer with the text of a system file; `base`: folder to which its file
    /// names are relative.
    pub(super) fn open_system(&mut self, text: String, base: PathBuf) {
        self.state.sheet = Some(Sheet::Goniophotometer);
        let bench = &mut self.state.goniophotometer;
        bench.base = base;
        bench.drawn = 0;
        bench.failure = None;
        bench.set_text(text);
    }

    /// Opens the sheet of the virtual goniophotometer with the example of the given number (from 0).
    pub(super) fn open_example(&mut self, number: usize) {
        if let Some(example) = EXAMPLES.get(number) {
            self.open_system(example.text.to_owned(), PathBuf::new());
        }
    }

    /// Starts the computation of the described system, or resumes a stopped run.
    pub(super) fn measure_system(&mut self) {
        self.state.sheet = Some(Sheet::Goniophotometer);
        if self.jobs.busy(Lane::Goniophotometer) {
            return;
        }
        let bench = &mut self.state.goniophotometer;
        let Some(described) = bench.valid().cloned() else {
            self.toasts.info(texts::DESCRIBE_FIRST_HOW);
            return;
        };
        bench.failure = None;
        let resumed = bench.run.take().filter(|run| bench.is_current(run) && !run.complete());
        let run = resumed.unwrap_or(Run { described, setup: bench.setup, states: None, finished: Vec::new() });
        bench.run = Some(run);
        self.measure_next_state();
    }

    fn measure_next_state(&mut self) {
        let Some(run) = self.state.goniophotometer.run.clone() else { return };
        let library = self.library.clone();
        self.start(Lane::Goniophotometer, move |job| Outcome::Measured(next_state(&run, &library, job).map(Box::new)));
    }

    /// Stores a finished state and continues with the next.
    pub(super) fn take_measured(&mut self, result: Result<Box<(Vec<String>, Finished)>, AppError>) {
        let bench = &mut self.state.goniophotometer;
        match (result, &mut bench.run) {
            (Ok(measured), Some(run)) => {
                run.states = Some(measured.0);
                run.finished.push(measured.1);
                if !run.complete() {
                    self.measure_next_state();
                }
            }
            (Ok(_), None) => {}
            (Err(error), _) => bench.failure = Some(error.to_string()),
        }
    }

    /// Stores all states of the run as a product in the catalogue; undo removes it again.
    pub(super) fn add_measured(&mut self) {
        let Some(run) = self.state.goniophotometer.run.as_ref().filter(|run| run.complete()) else {
            self.toasts.info(texts::COMPUTE_FIRST);
            return;
        };
        let datasets = run.finished.iter().map(|one| one.dataset.clone()).collect();
        let addition = Addition { datasets, product: product(run) };
        self.add_to_catalogue(vec![addition]);
    }
}
