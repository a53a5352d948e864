//! Storing of the results of jobs in the window: each goes to the feature that asked for it.

use super::command::Command;
use super::export::take_copied;
use super::results::ask_scene;
use super::state::{CatalogueState, PathUse, Sheet};
use super::window::App;
use super::year::input::YearAct;
use super::year::weather_name;
use crate::app::results::work::Outcome;
use crate::app::scene::selection::{adopt_selection, choose_product, select_something};
use crate::app::shell::error::{AppError, JobError};
use crate::app::shell::jobs::Lane;
use crate::study::files;
use crate::study::scene_file::{ControlKeys, ControlMode};
use crate::texts::shell;
use crate::texts::year::weather_taken;
use std::path::PathBuf;
use std::sync::Arc;

impl App {
    /// Stores the results of finished jobs in the window, without waiting.
    pub fn poll(&mut self) {
        // Ended, or stopped.
        self.export.follow(&self.shell.jobs);
        for finished in self.shell.jobs.poll() {
            match finished.outcome {
                Ok(outcome) => self.take(outcome),
                Err(error) => self.take_failure(finished.lane, finished.stage, error),
            }
            if finished.lane == Lane::Store {
                self.shell.start_pending_change();
            }
        }
    }

    fn take(&mut self, outcome: Outcome) {
        match outcome {
            Outcome::Opened(Ok(shelf)) => {
                self.shell.state.catalogue = CatalogueState::Ready(shelf);
                self.shell.search();
                self.products.look_up_deleted(&mut self.shell);
                self.products.look_up_sets(&mut self.shell);
                self.products.sync_subscribed(&mut self.shell);
                self.built_in.owe();
                self.shell.ask_again();
                self.imports.start_waiting_files(&mut self.shell);
            }
            Outcome::Builtin(left) => self.built_in.take(&mut self.shell, left),
            Outcome::Provided(Ok(())) => {
                self.shell.state.computing = None;
                self.shell.show_new_pictures();
                // LID and room wait for the same data in their own lanes.
                ask_scene(&mut self.shell);
            }
            Outcome::Provided(Err(error)) => {
                self.shell.state.computing = None;
                self.shell.state.dataset.error = Some(error.to_string());
            }
            Outcome::Opened(Err(error)) => self.shell.state.catalogue = CatalogueState::Failed(error.to_string()),
            Outcome::Found(Ok(found)) => {
                self.shell.state.search_error = None;
                self.shell.state.found = Arc::new(found);
                select_something(&mut self.shell);
                self.products.choose_first(&mut self.shell);
            }
            Outcome::Found(Err(error)) => self.shell.state.search_error = Some(error.to_string()),
            Outcome::Hits(found) => self.palette.take(&mut self.shell, found),
            Outcome::Scene(loaded, daylight) => self.computations.take_scene(&mut self.shell, loaded, daylight),
            Outcome::Year(result) => self.shell.results.year.take(result),
            Outcome::Annual(result) => self.shell.results.annual.take(result.map(|annual| *annual)),
            Outcome::Ranked(result) => self.ranking.take(&mut self.shell, result),
            Outcome::Weather(result) => self.shell.results.weather.take(result.map(|calendar| *calendar)),
            Outcome::OpenedWeather(path) => {
                let name = weather_name(&self.shell.state, &path);
                self.shell.toasts.success(weather_taken(name.display()));
                self.apply(Command::Year(YearAct::Weather(name)));
            }
            Outcome::DataForm(made) => self.shell.results.form.put(Arc::new(made)),
            Outcome::Schemes(made) => self.shell.results.schemes.put(Arc::new(made)),
            Outcome::Accuracy(result) => self.shell.results.accuracy.take(result),
            Outcome::Obstructions(effects) => self.shell.results.obstructions.put(Arc::new(effects)),
            Outcome::Lid(result) => self.shell.results.lid.take(result),
            Outcome::Peaks(of, peaks) => self.shell.results.peaks = peaks.map(|peaks| (of, peaks)),
            Outcome::Room(result) => self.computations.take_room(&mut self.shell, result),
            Outcome::Surfaces(result) => self.shell.results.surfaces.take(result),
            Outcome::Compared(id, what) => self.compare.take(id, *what),
            Outcome::Chosen(Ok(paths)) => self.apply(Command::OpenPaths(paths)),
            // Who pressed a button for it sees nothing else.
            Outcome::Target(PathUse::Export, Err(error)) => self.shell.toasts.info(error.to_string()),
            // Without a dialog the sheet's path field is the way, and it is open already.
            Outcome::Chosen(Err(_)) | Outcome::Target(_, Err(_) | Ok(None)) => {}
            // Chosen, not yet written: the preview continues.
            Outcome::Target(PathUse::Export, Ok(Some(path))) => self.shell.state.path = path.display().to_string(),
            Outcome::Target(what, Ok(Some(path))) => self.apply(Command::Write(what, path)),
            Outcome::Several(list) => list.into_iter().for_each(|outcome| self.take(outcome)),
            Outcome::Rearranged(import, names) => self.imports.take_rearranged(&mut self.shell, *import, &names),
            Outcome::Examined(dataset, found) => self.shell.state.examined = Some((dataset, found)),
            Outcome::Read(import) => self.imports.take(&mut self.shell, *import),
            Outcome::Repaired(files, repaired) => self.imports.take_repaired(&mut self.shell, &files, repaired),
            Outcome::ReadScene(path, Ok(scene)) => {
                let document = &self.shell.state.document;
                // Until a product is selected the tiles are empty: nobody goes back to that.
                let is_first = document.selection.product.is_empty() && !self.shell.undoer.has_undo(document);
                self.shell.end_step();
                self.shell.state.document.scene = *scene;
                self.shell.state.scene_path = Some(path);
                adopt_selection(&mut self.shell);
                if is_first {
                    self.shell.begin_history();
                }
            }
            Outcome::ReadCurve(Ok(curve)) => {
                let keys = self.shell.state.control_keys().with_mode(ControlMode::Curve);
                let keys = ControlKeys { curve, curve_file: None, ..keys };
                self.apply(Command::ControlKeys(Box::new(keys)));
            }
            Outcome::ReadSystem(Ok((text, base))) => self.goniophotometer.open(&mut self.shell, text, base),
            Outcome::Measured(result) => self.goniophotometer.take(&mut self.shell, result),
            Outcome::ReadScene(_, Err(error)) | Outcome::ReadCurve(Err(error)) | Outcome::ReadSystem(Err(error)) => {
                self.shell.report_error(&error);
            }
            Outcome::Added(numbers, Ok(products)) => {
                self.imports.stored();
                self.products.take_added(&mut self.shell, &numbers, products);
            }
            Outcome::Added(numbers, Err(error)) => {
                self.imports.not_stored(&mut self.shell);
                self.products.take_not_added(&mut self.shell, &numbers, &error);
            }
            Outcome::Choice(Ok(product)) => choose_product(&mut self.shell, &product),
            Outcome::Choice(Err(error)) => self.shell.report_error(&error),
            Outcome::Changed(number, forth, result) => {
                self.products.take_changed(&mut self.shell, number, forth, result);
            }
            Outcome::Editing(looked) => self.products.take_editing(&mut self.shell, looked),
            Outcome::ToReplace(change) => self.products.take_replacement(&mut self.shell, change),
            Outcome::Reread(result) => self.products.take_reread(&mut self.shell, result),
            Outcome::Synced(result) => self.products.take_synced(&mut self.shell, result),
            Outcome::Folder(folder) => self.products.take_folder(&mut self.shell, folder),
            Outcome::Sets(sets) => self.products.take_sets(&mut self.shell, sets),
            Outcome::Pictures(made) => self.gallery.take(&self.shell.ctx, made),
            Outcome::Deleted(list) => self.products.take_deleted(&mut self.shell, list),
            Outcome::Stored(result) => {
                if let Err(error) = result {
                    self.shell.toasts.error(error.to_string());
                }
                self.shell.search();
            }
            Outcome::Preview(result) => {
                self.export.take_preview(result.map_err(|error| error.to_string()));
            }
            Outcome::Copied(tile, drawn) => take_copied(&mut self.shell, tile, drawn),
            Outcome::There(what, path, there) => self.take_there(what, path, there),
            Outcome::Written(what, Ok(path)) => {
                self.shell.remember_folder(&path);
                self.shell.toasts.success(shell::written(files::absolute(&path).display()));
                if what == PathUse::SaveScene {
                    self.shell.state.scene_path = Some(path);
                }
            }
            Outcome::Written(_, Err(error)) => self.shell.report_error(&error),
            Outcome::Warning(text) => self.shell.toasts.warning(text),
            Outcome::Fonts(fonts, missing) => self.fonts.take(&mut self.shell, fonts, missing),
        }
    }

    /// Writes to a path, or asks the user whether to replace the file that exists there (`there`).
    fn take_there(&mut self, what: PathUse, path: PathBuf, there: bool) {
        if there {
            self.shell.state.path = path.display().to_string();
            self.shell.state.replace = Some(path);
            self.shell.state.sheet = Some(if what == PathUse::Export { Sheet::Export } else { Sheet::Path(what) });
        } else {
            self.write(what, path);
        }
    }

    /// Shows a message about a job that ended without a result because of an internal error, and writes a report.
    /// `stage`: stage of the job at its end.
    fn take_failure(&mut self, lane: Lane, stage: &'static str, error: JobError) {
        let text = format!("{}: {error}", lane.word());
        match &error {
            JobError::Panic(fault) => {
                let (session, toasts, content) = self.session_with_content();
                session.save_now(content, toasts);
                match session.report(fault, &format!("{}, {stage}", lane.word().english()), content) {
                    Some(Ok(path)) => self.shell.toasts.fault(shell::reported(&text, path.display()), path),
                    Some(Err(error)) => self.shell.toasts.error(shell::not_reported(&text, error)),
                    None => self.shell.toasts.error(text.clone()),
                }
            }
            JobError::NoThread(_) => self.shell.toasts.error(text.clone()),
        }
        match lane {
            Lane::Lid => self.shell.results.lid.error = Some(text),
            Lane::Room => self.shell.results.room.error = Some(text),
            Lane::Surfaces => self.shell.results.surfaces.error = Some(text),
            Lane::DataForm => self.shell.results.form.error = Some(text),
            Lane::Schemes => self.shell.results.schemes.error = Some(text),
            Lane::Accuracy => self.shell.results.accuracy.error = Some(text),
            Lane::Obstructions => self.shell.results.obstructions.error = Some(text),
            Lane::Goniophotometer => self.goniophotometer.fail(text),
            Lane::Year => self.shell.results.year.error = Some(text),
            Lane::Catalogue => self.shell.state.search_error = Some(text),
            Lane::Scene => self.shell.state.dataset.error = Some(text),
            Lane::Product => {
                self.shell.state.computing = None;
                self.shell.state.dataset.error = Some(text);
            }
            Lane::Compare => self.compare.fail(text),
            Lane::Arrange => self.imports.stop_arranging(),
            Lane::Import => self.imports.not_read(),
            Lane::Preview => self.export.take_preview(Err(text)),
            // Only where nothing else waits is it sure whose fault it was.
            Lane::Store if !self.shell.has_pending_changes() => {
                self.imports.not_read();
                let numbers = self.products.being_added();
                if !numbers.is_empty() {
                    self.imports.not_stored(&mut self.shell);
                    self.products.take_not_added(&mut self.shell, &numbers, &AppError::Job(error));
                }
            }
            // What asks in every frame would fail in every frame.
            Lane::Findings => self.shell.state.sheet = None,
            Lane::Gallery => self.shell.state.settings.gallery = false,
            _ => {}
        }
    }
}
