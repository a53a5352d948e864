//! Requests for paths, in the path field of a side panel and in the dialogs of the desktop.

use crate::app::results::work::Outcome;
use crate::app::shell::Shell;
use crate::app::shell::jobs::Lane;
use crate::app::state::{PathUse, Sheet};
use crate::texts::shell;
use std::path::Path;

/// Requests files to open: shows the path field and the desktop's dialog.
pub fn ask_paths(shell: &mut Shell) {
    shell.state.path.clear();
    shell.state.sheet = Some(Sheet::Path(PathUse::Open));
    let dialogs = shell.services.dialogs.clone();
    shell.start(Lane::Dialog, move |_| Outcome::Chosen(dialogs.open()));
}

/// Requests a folder to open: shows the path field and the desktop's dialog.
pub fn ask_folder(shell: &mut Shell) {
    shell.state.path.clear();
    shell.state.sheet = Some(Sheet::Path(PathUse::Open));
    let dialogs = shell.services.dialogs.clone();
    shell.start(Lane::Dialog, move |_| Outcome::Chosen(dialogs.open_folder(shell::DIALOG_FOLDER)));
}

/// Requests a path to write to: shows the path field, `start` as proposal, and the desktop's dialog.
pub fn ask_target(shell: &mut Shell, what: PathUse, start: &Path) {
    let start = start.to_owned();
    shell.state.path = start.display().to_string();
    shell.state.replace = None;
    shell.state.sheet = Some(Sheet::Path(what));
    let dialogs = shell.services.dialogs.clone();
    shell.start(Lane::Dialog, move |_| Outcome::Target(what, dialogs.save(what, &start)));
}
