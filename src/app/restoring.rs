//! Session of the window: restored at the start, stored continuously while the window is open, ended with the window.

use super::autosave::{Autosave, Found};
use super::clock;
use super::jobs::Lane;
use super::window::{App, fresh_undoer};
use crate::texts::shell;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Maximum time that a closing window waits for data that are still being stored.
const CLOSE_TIMEOUT: Duration = Duration::from_secs(60);

/// Returns the folder of the user's sessions: beside the catalogue, in the user's data folder.
pub fn sessions_folder() -> Option<PathBuf> {
    directories::ProjectDirs::from("", "", "cfs").map(|folders| folders.data_dir().join("sessions"))
}

impl App {
    /// Starts storing the session in a folder, and restores the session found there. `take_up`: whether to restore also
    /// the session of a window that was not closed properly, with a message. `folder`: `None` if the user has no such
    /// folder; then a warning is shown.
    pub fn begin_session(&mut self, folder: Option<&Path>, take_up: bool) {
        let Some(folder) = folder else {
            let _speaking = self.speak();
            self.toasts.warning(shell::NO_FOLDER);
            return;
        };
        match Autosave::begin(folder, take_up) {
            Ok((keeper, found)) => {
                self.autosave = Some(keeper);
                self.take_up(found, folder);
            }
            Err(error) => {
                let _speaking = self.speak();
                self.toasts.warning(shell::folder_not_kept(folder.display(), error));
            }
        }
    }

    /// Restores a session found in a folder, and reports problems with it.
    fn take_up(&mut self, found: Found, folder: &Path) {
        let put = found.kept.as_ref().map(|kept| kept.put_into(&mut self.state));
        // In the language that was kept.
        let _speaking = self.speak();
        for problem in &found.problems {
            self.toasts.warning(problem.to_string());
        }
        let (Some(kept), Some(put)) = (found.kept, put) else {
            // Whoever has never had a window open is offered the tour, once.
            self.state.tour_offered = found.problems.is_empty();
            return;
        };
        if let Err(error) = &put {
            self.toasts.warning(shell::last_scene(folder.display(), error));
        }
        self.undoer = fresh_undoer(&self.state.document);
        if let Some(import) = kept.import {
            self.read_again(import.paths.clone(), import.grouping, Some(import));
        }
        if found.lost && put.is_ok() {
            let at = clock::words(&kept.at);
            match kept.fault.and_then(|fault| fault.report) {
                Some(report) => self.toasts.fault(shell::restored_after_fault(at, report.display()), report),
                None => self.toasts.info(shell::restored(at)),
            }
        }
    }

    /// Passes the current session to the thread that stores it, if it has changed. Never waits.
    pub(super) fn keep_session(&mut self) {
        let Some(keeper) = &mut self.autosave else { return };
        keeper.keep(&self.state);
        if let Some(problem) = keeper.problem() {
            self.toasts.error(problem.to_string());
        }
    }

    /// Ends the window: waits until data being stored or written are complete, and leaves the session for the next
    /// start.
    pub fn close(&mut self) {
        let start = Instant::now();
        let storing = |app: &Self| app.jobs.busy(Lane::Store) || !app.pending_changes.is_empty() || app.writing;
        while storing(self) && self.state.shelf().is_some() && start.elapsed() < CLOSE_TIMEOUT {
            self.poll();
            self.write_exports();
            std::thread::sleep(Duration::from_millis(5));
        }
        if let Some(mut keeper) = self.autosave.take() {
            keeper.keep(&self.state);
            keeper.close();
        }
    }
}
