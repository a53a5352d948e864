//! Session of the window: restored at the start, stored continuously while the window is open, ended with the window;
//! and reports on internal errors.

mod autosave;
mod error;
mod faults;
mod snapshot;
mod steps;

pub use error::SessionError;
pub use faults::copy_report;
pub use snapshot::{Content, ContentMut, Kept, Snapshot};

use super::command::Command;
use super::shell::Shell;
use crate::app::shell::clock;
use crate::app::shell::messages::Messages;
use crate::texts::shell;
use autosave::{Autosave, Found};
use std::path::{Path, PathBuf};
use steps::{Faults, Steps};

/// Session of the window, and what reports on internal errors need.
#[derive(Default)]
pub struct Session {
    /// Writer of the session on disk; `None` if the session is not stored.
    autosave: Option<Autosave>,
    /// History of the last commands, for reports on internal errors.
    steps: Steps,
    /// Internal errors that were reported.
    faults: Faults,
}

/// Returns the folder of the user's sessions: beside the catalogue, in the user's data folder.
pub fn sessions_folder() -> Option<PathBuf> {
    directories::ProjectDirs::from("", "", "cfs").map(|folders| folders.data_dir().join("sessions"))
}

impl Session {
    /// Starts storing the session in a folder, and returns the sessions found there. `take_up`: whether to find also
    /// the session of a window that was not closed properly. `folder`: `None` if the user has no such folder; then a
    /// warning is shown.
    pub fn begin(&mut self, shell: &mut Shell, folder: Option<&Path>, take_up: bool) -> Option<Found> {
        let _speaking = shell.speak();
        let Some(folder) = folder else {
            shell.toasts.warning(shell::NO_FOLDER);
            return None;
        };
        match Autosave::begin(folder, take_up) {
            Ok((keeper, found)) => {
                self.autosave = Some(keeper);
                Some(found)
            }
            Err(error) => {
                shell.toasts.warning(shell::folder_not_kept(folder.display(), error));
                None
            }
        }
    }

    /// Adds a command to the history for reports on internal errors.
    pub fn note(&mut self, command: &Command) {
        self.steps.keep(command);
    }

    /// Passes the current session to the thread that stores it, if it has changed. Never waits.
    pub fn keep(&mut self, content: Content<'_>, toasts: &mut Messages) {
        let Some(keeper) = &mut self.autosave else { return };
        keeper.keep(content);
        if let Some(problem) = keeper.problem() {
            toasts.error(problem.to_string());
        }
    }

    /// Saves the session at once; returns when it is on disk or cannot be written.
    pub fn save_now(&mut self, content: Content<'_>, toasts: &mut Messages) {
        self.keep(content, toasts);
        if let Some(keeper) = &self.autosave {
            keeper.write_now();
        }
    }

    /// Stores the session a last time, and leaves it for the next start.
    pub fn close(&mut self, content: Content<'_>) {
        if let Some(mut keeper) = self.autosave.take() {
            keeper.keep(content);
            keeper.close();
        }
    }
}

/// Says what a restored session is of. `put`: whether its scene could be read; `folder`: where it was found.
pub fn say_restored(toasts: &mut Messages, found: &Found, put: &Result<(), String>, folder: &Path) {
    let Some(kept) = &found.kept else { return };
    if let Err(error) = put {
        toasts.warning(shell::last_scene(folder.display(), error));
    }
    if found.lost && put.is_ok() {
        let at = clock::words(&kept.at);
        match kept.fault.as_ref().and_then(|fault| fault.report.clone()) {
            Some(report) => toasts.fault(shell::restored_after_fault(at, report.display()), report),
            None => toasts.info(shell::restored(at)),
        }
    }
}
