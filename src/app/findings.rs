//! Starts the data check of the selected dataset while the sheet of findings is open.

use super::jobs::Lane;
use super::state::Sheet;
use super::window::App;
use super::work::Outcome;
use std::sync::Arc;

impl App {
    /// Starts the data check of the dataset of the current state, if the sheet of findings is open.
    pub(super) fn ask_findings(&mut self) {
        let Some(dataset) = self.state.dataset.value.clone().filter(|_| self.state.sheet == Some(Sheet::Findings))
        else {
            return;
        };
        let known = self.state.examined.as_ref().is_some_and(|(of, _)| Arc::ptr_eq(of, &dataset));
        if known || self.jobs.busy(Lane::Findings) {
            return;
        }
        let examined = self.examined.clone();
        self.start(Lane::Findings, move |_| {
            let found = examined.of(&dataset);
            Outcome::Examined(dataset, found)
        });
    }
}
