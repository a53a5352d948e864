//! Starts the data check of the selected dataset while the sheet of findings is open.

use super::Examined;
use crate::app::results::work::Outcome;
use crate::app::shell::Shell;
use crate::app::shell::jobs::Lane;
use crate::app::state::Sheet;
use std::sync::Arc;

impl Examined {
    /// Starts the data check of the dataset of the current state, if the sheet of findings is open.
    pub fn ask(&self, shell: &mut Shell) {
        let Some(dataset) = shell.state.dataset.value.clone().filter(|_| shell.state.sheet == Some(Sheet::Findings))
        else {
            return;
        };
        let known = shell.state.examined.as_ref().is_some_and(|(of, _)| Arc::ptr_eq(of, &dataset));
        if known || shell.jobs.busy(Lane::Findings) {
            return;
        }
        let examined = self.clone();
        shell.start(Lane::Findings, move |_| {
            let found = examined.of(&dataset);
            Outcome::Examined(dataset, found)
        });
    }
}
