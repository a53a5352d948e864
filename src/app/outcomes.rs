//! Starts jobs, and takes what they bring back into the window.

use super::apply::first_choice;
use super::command::Command;
use super::disk::read_bytes;
use super::engine::Question;
use super::error::AppError;
use super::jobs::Lane;
use super::scene::selection_of;
use super::shelf::{Addition, Shelf};
use super::state::{CatalogueState, Daylight, PathUse, Sheet, Shown};
use super::window::{App, fresh_undoer};
use super::work::{Outcome, Shelved, fill_some, take_from_shelf};
use crate::catalogue::{Imported, Product};
use crate::study::scene_file::{ControlKeys, ControlMode};
use crate::study::sky::{SkyKeyError, outside_from_keys};
use std::path::PathBuf;
use std::sync::Arc;

impl App {
    /// Opens the catalogue in a job.
    pub(super) fn open_catalogue(&mut self) {
        self.state.catalogue = CatalogueState::Opening;
        let open = self.services.open_catalogue.clone();
        self.start(Lane::Catalogue, move |_| Outcome::Opened(open()));
    }

    /// Looks the list up anew.
    pub(super) fn search(&mut self) {
        if let Some(shelf) = self.state.shelf() {
            let query = self.state.query.clone();
            self.start(Lane::Catalogue, move |_| Outcome::Found(shelf.search(&query)));
        }
    }

    /// Computes built-in products that are not stored yet, behind everything else. Stopped, it goes on when the catalogue
    /// is opened next.
    pub(super) fn fill_catalogue(&mut self) {
        let Some(shelf) = self.state.shelf() else { return };
        self.start(Lane::Builtin, move |progress| Outcome::Builtin(fill_some(&*shelf, progress)));
    }

    /// Changes the catalogue, one change after the other.
    pub(super) fn store(&mut self, change: impl FnOnce(&dyn Shelf) -> Result<(), AppError> + Send + 'static) {
        self.pending_changes.push_back(Box::new(move |shelf| Outcome::Stored(change(shelf))));
        self.start_pending_change();
    }

    /// Stores an addition of this session.
    pub(super) fn store_addition(&mut self, number: usize, addition: Addition) {
        self.pending_changes.push_back(Box::new(move |shelf| {
            Outcome::Added(number, shelf.add(&addition).and_then(|key| shelf.product(&key)))
        }));
        self.start_pending_change();
    }

    /// Looks a product up that is to be chosen, behind all changes: it may be what one of them stores.
    pub(super) fn look_up(&mut self, product: String) {
        self.pending_changes.push_back(Box::new(move |shelf| Outcome::Choice(shelf.product(&product))));
        self.start_pending_change();
    }

    /// Stores the products of a package.
    pub(super) fn import_package(&mut self, path: PathBuf) {
        self.pending_changes.push_back(Box::new(move |shelf| {
            let told = |error: AppError| error.about(path.display());
            Outcome::Imported(read_bytes(&path).and_then(|bytes| shelf.import_package(&bytes).map_err(told)))
        }));
        self.start_pending_change();
    }

    /// Changes must all happen, so they wait for each other instead of replacing each other.
    fn start_pending_change(&mut self) {
        if self.jobs.busy(Lane::Store) {
            return;
        }
        let Some(shelf) = self.state.shelf() else { return };
        if let Some(change) = self.pending_changes.pop_front() {
            self.start(Lane::Store, move |_| change(&*shelf));
        }
    }

    /// Takes in what jobs brought back. Never waits.
    pub fn poll(&mut self) {
        for finished in self.jobs.poll() {
            match finished.outcome {
                Ok(outcome) => self.take(outcome),
                Err(panic) => {
                    let text = format!("{}: {panic}", finished.lane.word());
                    self.toasts.error(text.clone());
                    match finished.lane {
                        Lane::Lid => self.results.lid.error = Some(text),
                        Lane::Room => self.results.room.error = Some(text),
                        Lane::Accuracy => self.results.accuracy.error = Some(text),
                        Lane::Goniophotometer => self.state.goniophotometer.failure = Some(text),
                        Lane::Year => self.results.year.error = Some(text),
                        Lane::Catalogue => self.state.search_error = Some(text),
                        _ => {}
                    }
                }
            }
            if finished.lane == Lane::Store {
                self.start_pending_change();
            }
        }
    }

    fn take(&mut self, outcome: Outcome) {
        match outcome {
            Outcome::Opened(Ok(shelf)) => {
                self.state.catalogue = CatalogueState::Ready(shelf);
                self.search();
                self.fill_catalogue();
                self.asked = None;
            }
            Outcome::Builtin(Ok(left)) => {
                self.search();
                if self.state.dataset.error.is_some() {
                    // It may be what the scene was waiting for.
                    self.asked = None;
                }
                if left > 0 {
                    self.fill_catalogue();
                }
            }
            Outcome::Builtin(Err(error)) => {
                self.toasts.warning(format!("Built-in products: {error}"));
            }
            Outcome::Opened(Err(error)) => self.state.catalogue = CatalogueState::Failed(error.to_string()),
            Outcome::Found(Ok(found)) => {
                self.state.search_error = None;
                self.state.found = Arc::new(found);
                self.select_something();
            }
            Outcome::Found(Err(error)) => self.state.search_error = Some(error.to_string()),
            Outcome::Scene(shelved, daylight) => self.take_scene(shelved, daylight),
            Outcome::Year(result) => self.results.year.take(result),
            Outcome::Accuracy(result) => {
                self.results.accuracy_revision += 1;
                self.results.accuracy.take(result);
            }
            Outcome::Lid(result) => self.results.lid.take(result),
            Outcome::Room(result) => self.results.room.take(result),
            Outcome::Chosen(Ok(paths)) => self.apply(Command::OpenPaths(paths)),
            // Without a dialog the sheet's path field is the way, and it is open already.
            Outcome::Chosen(Err(_)) | Outcome::Target(_, Err(_) | Ok(None)) => {}
            Outcome::Target(what, Ok(Some(path))) => self.apply(Command::Write(what, path)),
            Outcome::Read(import) => {
                self.state.import = Some(*import);
                self.state.sheet = Some(Sheet::Import);
            }
            Outcome::Mended(Ok(mended)) => {
                if let Some(import) = &mut self.state.import {
                    (import.datasets, import.diagnoses, import.repairs) =
                        (mended.datasets, mended.diagnoses, mended.repairs);
                }
            }
            Outcome::Mended(Err(error)) => {
                self.toasts.error(error.to_string());
            }
            Outcome::ReadScene(path, Ok(scene)) => {
                self.undoer.add_undo(&self.state.document);
                self.state.document.scene = *scene;
                self.state.document.daylight_follows = false;
                self.state.scene_path = Some(path);
                self.adopt_selection();
            }
            Outcome::ReadCurve(Ok(curve)) => {
                let keys = self.state.control_keys().with_mode(ControlMode::Curve);
                let keys = ControlKeys { curve, curve_file: None, ..keys };
                self.apply(Command::ControlKeys(Box::new(keys)));
            }
            Outcome::ReadSystem(Ok((text, base))) => self.open_system(text, base),
            Outcome::Measured(result) => self.take_measured(result),
            Outcome::ReadScene(_, Err(error)) | Outcome::ReadCurve(Err(error)) | Outcome::ReadSystem(Err(error)) => {
                self.tell(&error);
            }
            Outcome::Added(number, result) => self.take_added(number, result),
            Outcome::Choice(Ok(product)) => self.choose_product(&product),
            Outcome::Choice(Err(error)) => self.tell(&error),
            Outcome::Imported(result) => self.take_imported(result),
            Outcome::Stored(result) => {
                if let Err(error) = result {
                    self.toasts.error(error.to_string());
                }
                self.search();
            }
            Outcome::Written(what, Ok(path)) => {
                self.toasts.success(format!("Written: {}", path.display()));
                if what == PathUse::SaveScene {
                    self.state.scene_path = Some(path);
                }
            }
            Outcome::Written(_, Err(error)) => self.tell(&error),
        }
    }

    fn take_scene(&mut self, shelved: Result<Shelved, AppError>, daylight: Result<Daylight, SkyKeyError>) {
        match shelved {
            Ok(Shelved { product, state, dataset }) => {
                self.state.product = Some(product);
                self.state.shown_state = state;
                self.state.dataset.value = Some(dataset);
                self.state.dataset.stale = false;
                self.state.dataset.error = None;
                self.ask_year();
            }
            Err(error) => self.state.dataset.error = Some(error.to_string()),
        }
        self.state.scene_error = daylight.as_ref().err().cloned();
        self.state.daylight.take(daylight);
    }

    fn take_added(&mut self, number: usize, result: Result<Arc<Product>, AppError>) {
        match result {
            // Undone while it was being stored.
            Ok(product) if !self.state.document.additions.contains(&number) => {
                self.store(move |shelf| shelf.remove(&product.key));
            }
            Ok(product) => {
                self.toasts.success("Added to the catalogue; Ctrl+Z takes it out again");
                self.state.additions[number].key = Some(product.key.clone());
                // The step that added it also shows it.
                let (rule, place) = product.representative();
                let state = product.states.get(place).filter(|_| product.states.len() > 1);
                first_choice(
                    &mut self.state.document,
                    product.key.clone(),
                    rule,
                    state.map(|state| state.key.as_str()),
                );
                self.undoer.add_undo(&self.state.document);
            }
            Err(error) => {
                self.state.document.additions.retain(|&other| other != number);
                self.toasts.error(format!("Not added: {error}. The catalogue is unchanged.")).duration(None);
            }
        }
        self.search();
    }

    fn take_imported(&mut self, result: Result<Vec<Imported>, AppError>) {
        match result {
            Ok(list) => {
                let there = |one: &&Imported| one.same_content_as == [one.key.as_str()];
                let known = list.iter().filter(there).count();
                let products = |n: usize| if n == 1 { "1 product".to_owned() } else { format!("{n} products") };
                self.toasts.success(match (list.len() - known, known) {
                    (new, 0) => format!("Imported: {}", products(new)),
                    (0, _) => "Nothing new: all of it was there already".to_owned(),
                    (new, known) => format!("Imported: {}; there already: {known}", products(new)),
                });
                if let Some(first) = list.first() {
                    self.apply(Command::Select(first.key.clone()));
                }
            }
            Err(error) => self.tell(&error),
        }
        self.search();
    }

    /// After opening a scene the selection is what its first catalogue aperture holds.
    fn adopt_selection(&mut self) {
        if let Some(selection) = selection_of(&self.state.document.scene) {
            self.state.document.selection = selection;
        }
    }

    /// A first start shows something alive: a light-guiding product if there is one, else the first.
    fn select_something(&mut self) {
        let document = &self.state.document;
        if !document.selection.product.is_empty() || self.state.found.entries.is_empty() {
            return;
        }
        // Something that moves makes every tile alive; else something that guides light.
        const GUIDES: [&str; 3] = ["laser", "prism", "double"];
        let entries = &self.state.found.entries;
        let moving = entries.iter().find(|entry| entry.moves());
        let guiding =
            || GUIDES.iter().find_map(|word| entries.iter().find(|entry| entry.name.to_lowercase().contains(word)));
        let chosen = Arc::clone(moving.or_else(guiding).unwrap_or(&entries[0]));
        let state = Some(chosen.state()).filter(|_| chosen.moves());
        first_choice(&mut self.state.document, chosen.key.clone(), chosen.rule, state);
        self.undoer = fresh_undoer(&self.state.document);
    }

    /// Asks for the year of control anew when something that it hangs on has changed.
    fn ask_year(&mut self) {
        let state = &self.state;
        let Some(product) = state.product.clone() else { return };
        let key = state.year_key(&product.key);
        if key == self.asked_year {
            return;
        }
        self.asked_year.clone_from(&key);
        self.results.year.stale = true;
        match key.filter(|_| product.states.len() > 1) {
            Some(key) => self.start(Lane::Year, move |job| Outcome::Year(super::control::year(&product, key, job))),
            None => {
                self.jobs.cancel(Lane::Year);
                self.results.year = Shown::default();
            }
        }
    }

    /// Runs the ladder on the present scene and shows its sheet.
    pub(super) fn measure_accuracy(&mut self) {
        self.state.sheet = Some(Sheet::Accuracy);
        let Some(shelf) = self.state.shelf() else {
            self.toasts.info("The catalogue is not open yet");
            return;
        };
        let question = Question { scene: self.state.document.scene.clone(), base: self.state.base(), shelf };
        let engine = self.services.engine.clone();
        self.results.accuracy.error = None;
        self.start(Lane::Accuracy, move |job| Outcome::Accuracy(engine.accuracy(&question, job)));
    }

    /// Asks for everything that the document's change since the last call affects.
    pub fn refresh(&mut self) {
        if self.state.document.daylight_follows {
            super::daylight::follow(&mut self.state.document.scene);
        }
        let Some(shelf) = self.state.shelf() else { return };
        let document = &self.state.document;
        if document.selection.product.is_empty() || self.asked.as_ref() == Some(document) {
            return;
        }
        self.asked = Some(document.clone());
        let question = Question { scene: document.scene.clone(), base: self.state.base(), shelf: shelf.clone() };
        let selection = document.selection.clone();
        self.state.dataset.stale = true;
        self.state.daylight.stale = true;
        self.results.lid.stale = true;
        self.results.room.stale = true;
        self.results.accuracy.stale = true;
        let (scene, base) = (question.scene.clone(), question.base.clone());
        let aperture = self.state.control_aperture();
        self.start(Lane::Scene, move |_| {
            let daylight =
                outside_from_keys(&scene.sky, &scene.site, &base).map(|(outside, sun)| Daylight { outside, sun });
            let place = (aperture, base.as_path());
            Outcome::Scene(take_from_shelf(&*shelf, &selection, &scene, daylight.as_ref().ok(), place), daylight)
        });
        let (engine, asked) = (self.services.engine.clone(), question.clone());
        self.start(Lane::Lid, move |job| Outcome::Lid(engine.lid(&asked, job)));
        let engine = self.services.engine.clone();
        self.start(Lane::Room, move |job| Outcome::Room(engine.room(&question, job)));
    }
}
