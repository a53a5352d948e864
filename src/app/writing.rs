//! Files of the window: asking for paths, reading what was chosen, writing scene, luminaire, tiles and computed data.

use super::disk::{ends_in, write_whole};
use super::export::png;
use super::goniophotometer;
use super::jobs::Lane;
use super::state::{PathUse, Sheet, Tile};
use super::window::App;
use super::work::{Outcome, export_lid, read_files, save_scene};
use std::path::PathBuf;

impl App {
    /// Asks for files: the path field at once, the desktop's dialog beside it.
    pub(super) fn ask_paths(&mut self) {
        self.state.path.clear();
        self.state.sheet = Some(Sheet::Path(PathUse::Open));
        let dialogs = self.services.dialogs.clone();
        self.start(Lane::Import, move |_| Outcome::Chosen(dialogs.open()));
    }

    pub(super) fn ask_target(&mut self, what: PathUse) {
        self.state.path = match (what, &self.state.scene_path) {
            (PathUse::SaveScene, Some(path)) => path.display().to_string(),
            _ => what.file_name(),
        };
        self.state.sheet = Some(Sheet::Path(what));
        let dialogs = self.services.dialogs.clone();
        self.start(Lane::Export, move |_| Outcome::Target(what, dialogs.save(what)));
    }

    pub(super) fn read_paths(&mut self, paths: Vec<PathBuf>) {
        if paths.is_empty() {
            return;
        }
        self.state.sheet = None;
        // A package is whole: it needs no questions, and goes where it came from.
        let (packages, paths): (Vec<_>, Vec<_>) = paths.into_iter().partition(|path| ends_in(path, "cfsp"));
        packages.into_iter().for_each(|path| self.import_package(path));
        if paths.is_empty() {
            return;
        }
        let read = self.services.read;
        self.start(Lane::Import, move |_| read_files(&paths, read));
    }

    pub(super) fn write(&mut self, what: PathUse, path: PathBuf) {
        self.state.sheet = None;
        match what {
            PathUse::Open => self.read_paths(vec![path]),
            PathUse::SaveScene => {
                let text = toml::to_string_pretty(&self.state.document.scene);
                self.start(Lane::Export, move |_| save_scene(&path, text));
            }
            PathUse::ExportTile(tile) => self.export_tile(tile, path),
            PathUse::ExportMeasured => {
                self.state.sheet = Some(Sheet::Goniophotometer);
                match self.state.goniophotometer.run.clone() {
                    Some(run) => {
                        self.start(Lane::Export, move |_| Outcome::Written(what, goniophotometer::export(&run, &path)));
                    }
                    None => drop(self.toasts.info("Compute the system first")),
                }
            }
            PathUse::ExportLid => {
                let (engine, lid) = (self.services.engine.clone(), self.results.lid.value.clone());
                self.start(Lane::Export, move |_| export_lid(&path, lid.as_deref(), &*engine));
            }
        }
    }

    fn export_tile(&mut self, tile: Tile, path: PathBuf) {
        match self.export.ask(tile, path) {
            Ok(()) => self.bring_up(tile),
            Err(error) => self.tell(&error),
        }
    }

    /// Asks a tile for its numbers, for the clipboard.
    pub(super) fn copy_tile(&mut self, tile: Tile) {
        self.export.ask_copy(tile);
        self.bring_up(tile);
    }

    /// A hidden tile is not drawn and so knows nothing.
    fn bring_up(&mut self, tile: Tile) {
        if self.state.maximised.is_some_and(|shown| shown != tile) {
            self.state.maximised = Some(tile);
        }
    }

    /// Writes what tiles and screen gave since the last frame.
    pub(super) fn write_exports(&mut self) {
        if self.jobs.busy(Lane::Export) {
            return;
        }
        if let Some((tile, path, text)) = self.export.next_numbers() {
            self.start(Lane::Export, move |_| {
                Outcome::Written(PathUse::ExportTile(tile), write_whole(&path, text.as_bytes()))
            });
            return;
        }
        if let Some((tile, path, picture)) = self.export.next_picture() {
            self.start(Lane::Export, move |_| {
                let written = png(&picture).and_then(|bytes| write_whole(&path, &bytes));
                Outcome::Written(PathUse::ExportTile(tile), written)
            });
        }
    }
}
