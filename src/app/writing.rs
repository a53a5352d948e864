//! Files of the window: requesting paths, and writing scene, luminaire file, tiles and computed data.

use super::catalogue_command::CatalogueCommand;
use super::disk::write_whole;
use super::exporting;
use super::goniophotometer;
use super::jobs::Lane;
use super::naming::start_path;
use super::state::{PathUse, Sheet, Tile};
use super::typed_path::with_ending;
use super::window::App;
use super::work::{Outcome, export_lid, save_scene};
use crate::texts::export as texts;
use std::path::{Path, PathBuf};

impl App {
    /// Requests files to open: shows the path field and the desktop's dialog.
    pub(super) fn ask_paths(&mut self) {
        self.state.path.clear();
        self.state.sheet = Some(Sheet::Path(PathUse::Open));
        let dialogs = self.services.dialogs.clone();
        self.start(Lane::Dialog, move |_| Outcome::Chosen(dialogs.open()));
    }

    /// Requests a folder to open: shows the path field and the desktop's dialog.
    pub(super) fn ask_folder(&mut self) {
        self.state.path.clear();
        self.state.sheet = Some(Sheet::Path(PathUse::Open));
        let dialogs = self.services.dialogs.clone();
        self.start(Lane::Dialog, move |_| Outcome::Chosen(dialogs.open_folder(crate::texts::shell::DIALOG_FOLDER)));
    }

    /// Requests a path to write to: shows the path field, with a proposed path, and the desktop's dialog.
    pub(super) fn ask_target(&mut self, what: PathUse) {
        let start = start_path(&self.state, what);
        self.state.path = start.display().to_string();
        self.state.replace = None;
        self.state.sheet = Some(Sheet::Path(what));
        let dialogs = self.services.dialogs.clone();
        self.start(Lane::Dialog, move |_| Outcome::Target(what, dialogs.save(what, &start)));
    }

    /// Writes to a path if there is no file yet; otherwise the user is asked whether to replace it.
    pub(super) fn write_new(&mut self, what: PathUse, path: PathBuf) {
        let path = with_ending(&self.state, what, path);
        if matches!(what, PathUse::Open | PathUse::ReplaceState | PathUse::Subscribe) {
            return self.write(what, path);
        }
        // Whoever saves the scene to where it came from means that file.
        if what == PathUse::SaveScene && self.state.scene_path.as_ref() == Some(&path) {
            return self.write(what, path);
        }
        let targets = match (what, &self.state.goniophotometer.run) {
            (PathUse::ExportMeasured, Some(run)) => goniophotometer::targets(run, &path),
            (PathUse::Export, _) => exporting::targets(&self.state, &path),
            _ => vec![path.clone()],
        };
        self.start(Lane::Export, move |_| {
            let there = targets.iter().any(|target| target.exists());
            Outcome::There(what, path, there)
        });
    }

    /// Writes to a path, or asks the user whether to replace the file that exists there (`there`).
    pub(super) fn take_there(&mut self, what: PathUse, path: PathBuf, there: bool) {
        if there {
            self.state.path = path.display().to_string();
            self.state.replace = Some(path);
            self.state.sheet = Some(if what == PathUse::Export { Sheet::Export } else { Sheet::Path(what) });
        } else {
            self.write(what, path);
        }
    }

    /// Stores the folder of a file that was read or written, so that the next dialog starts there.
    pub(super) fn remember_folder(&mut self, path: &Path) {
        if let Some(folder) = path.parent().filter(|folder| folder.is_absolute()) {
            self.state.settings.folder = Some(folder.to_owned());
        }
    }

    /// Starts a job that writes a file; a closing window waits until it is finished.
    fn start_writing(&mut self, work: impl FnOnce() -> Outcome + Send + 'static) {
        self.writing = true;
        self.start(Lane::Export, move |_| work());
    }

    /// Executes the purpose of a path that the user has given: opens, replaces, subscribes or starts writing.
    pub(super) fn write(&mut self, what: PathUse, path: PathBuf) {
        self.state.sheet = None;
        self.state.replace = None;
        match what {
            PathUse::Open => self.read_paths(vec![path]),
            PathUse::ReplaceState => self.replace_state(path),
            PathUse::Subscribe => self.apply_catalogue_command(CatalogueCommand::SubscribeTo(path)),
            PathUse::SaveScene => {
                let text = toml::to_string_pretty(&self.state.document.scene);
                let made_from = self.state.files_of_scene();
                self.start_writing(move || save_scene(&path, text, &made_from));
            }
            PathUse::ExportTile(tile) => self.export_tile(tile, path),
            PathUse::Export => self.start_export(path),
            PathUse::ExportMeasured => {
                self.state.sheet = Some(Sheet::Goniophotometer);
                match self.state.goniophotometer.run.clone() {
                    Some(run) => {
                        let made_from = self.state.made_from();
                        self.start_writing(move || {
                            Outcome::Written(what, goniophotometer::export(&run, &path, &made_from))
                        });
                    }
                    None => self.toasts.info(texts::COMPUTE_FIRST),
                }
            }
            PathUse::ExportLid => self.lid_to = Some(path),
        }
    }

    fn write_lid(&mut self, path: PathBuf) {
        let shown = &self.results.lid;
        if shown.stale && shown.value.is_some() {
            let why = shown.error.as_deref().unwrap_or(texts::OF_BEFORE.get());
            self.toasts.error(texts::lid_not_written(why));
            return;
        }
        let (engine, lid) = (self.services.engine.clone(), shown.value.clone());
        let made_from = self.state.made_from();
        self.start_writing(move || export_lid(&path, lid.as_deref(), &*engine, &made_from));
    }

    fn export_tile(&mut self, tile: Tile, path: PathBuf) {
        match self.export.ask(tile, path) {
            Ok(()) => self.bring_up(tile),
            Err(error) => self.report_error(&error),
        }
    }

    /// Requests the numbers of a tile for the clipboard, and shows the tile.
    pub(super) fn copy_tile(&mut self, tile: Tile) {
        self.export.ask_copy(tile);
        self.bring_up(tile);
    }

    /// Takes over the numbers that tiles have returned, and starts writing what is due.
    pub(super) fn write_exports(&mut self) {
        self.take_numbers();
        if self.jobs.busy(Lane::Export) {
            return;
        }
        // What is written is of what its name says: what is being computed is waited for.
        if self.lid_to.is_some()
            && self.standing()
            && let Some(path) = self.lid_to.take()
        {
            return self.write_lid(path);
        }
        if let Some((tile, path, text)) = self.export.next_numbers() {
            let made_from = self.state.made_from();
            self.start_writing(move || {
                Outcome::Written(PathUse::ExportTile(tile), write_whole(&path, text.as_bytes(), &made_from))
            });
        }
    }
}
