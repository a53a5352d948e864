//! Starting of jobs, and storing of their results in the window.

use super::command::Command;
use super::engine::Question;
use super::error::AppError;
use super::first_choice::first_choice;
use super::jobs::Lane;
use super::scene::{Selection, own_system, selection_of};
use super::shelf::{Addition, Query, Shelf};
use super::state::{CatalogueState, Daylight, Document, PathUse, Sheet, Shown};
use super::tiles;
use super::title;
use super::window::{App, end_step, fresh_undoer};
use super::work::{LoadedSelection, Outcome, daylight, fill_some, obstructions, take_from_shelf};
use crate::catalogue::{Product, Stored};
use crate::compute::lid::c_gamma::Peaks;
use crate::study::files;
use crate::study::scene_file::{ControlKeys, ControlMode};
use crate::study::sky::SkyKeyError;
use crate::texts::{Language, language, shell};
use std::sync::Arc;

/// Number of failed computations after which built-in products are no longer computed in advance.
const FILL_FAILURES: usize = 5;

impl App {
    /// Opens the catalogue in a job.
    pub(super) fn open_catalogue(&mut self) {
        self.state.catalogue = CatalogueState::Opening;
        let open = self.services.open_catalogue.clone();
        self.start(Lane::Catalogue, move |_| Outcome::Opened(open()));
    }

    /// Starts a new search of the catalogue for the product list.
    pub(super) fn search(&mut self) {
        if let Some(shelf) = self.state.shelf() {
            let query = Query { shown: self.state.settings.recent.clone(), ..self.state.query.clone() };
            self.start(Lane::Catalogue, move |_| Outcome::Found(shelf.search(&query)));
        }
    }

    /// Starts computing data of built-in products in advance, while nothing else is computed: first those of the
    /// selected product, then the representative states of the listed products, then the rest. After a stop it resumes
    /// when another product is selected.
    pub(super) fn fill_catalogue(&mut self) {
        if !self.fill_due || !self.jobs.views().is_empty() {
            return;
        }
        let Some(shelf) = self.state.shelf() else { return };
        self.fill_due = false;
        if self.fill_failures >= FILL_FAILURES {
            return;
        }
        let chosen = std::iter::once(self.state.document.selection.product.clone());
        let order: Vec<String> = chosen.chain(self.state.found.entries.iter().map(|entry| entry.key.clone())).collect();
        self.start(Lane::Builtin, move |progress| Outcome::Builtin(fill_some(&*shelf, &order, progress)));
    }

    /// Starts computing the data of a selected state, which the catalogue does not contain yet.
    fn compute_state(&mut self, product: &Product, state: String) {
        let Some(shelf) = self.state.shelf() else { return };
        let label = product.states.iter().find(|one| one.key == state).map_or("", |one| one.label.as_str());
        let what = if label.is_empty() { shell::ITS_DATA.get() } else { label };
        self.state.computing = Some(shell::computing(what));
        let key = product.key.clone();
        self.start(Lane::Product, move |job| Outcome::Provided(shelf.provide(&key, Some(&state), job)));
    }

    /// Cancels the computation of the data of a state.
    pub(super) fn stop_computing(&mut self) {
        self.jobs.cancel(Lane::Product);
        self.state.computing = None;
    }

    /// Queues a change of the catalogue; changes are made one after the other.
    pub(super) fn store(&mut self, change: impl FnOnce(&dyn Shelf) -> Result<(), AppError> + Send + 'static) {
        self.pending_changes.push_back(Box::new(move |shelf| Outcome::Stored(change(shelf))));
        self.start_pending_change();
    }

    /// Queues the storing of additions, given with their numbers in this session: all are stored, or none.
    pub(super) fn store_additions(&mut self, additions: Vec<(usize, Addition)>) {
        self.adding.extend(additions.iter().map(|(number, _)| *number));
        self.queue(move |shelf| {
            let (numbers, additions): (Vec<_>, Vec<_>) = additions.into_iter().unzip();
            let look = |one: Stored| Ok((one.new, shelf.product(&one.imported.key)?));
            let stored = shelf.add_all(&additions).and_then(|list| list.into_iter().map(look).collect());
            Outcome::Added(numbers, stored)
        });
    }

    /// Queues the reading of a product that is to be selected, after all pending changes, one of which may store it.
    pub(super) fn look_up(&mut self, product: String) {
        self.queue(move |shelf| Outcome::Choice(shelf.product(&product)));
    }

    /// Queues a query or change of the catalogue after everything that was queued before.
    pub(super) fn queue(&mut self, change: impl FnOnce(&dyn Shelf) -> Outcome + Send + 'static) {
        self.pending_changes.push_back(Box::new(change));
        self.start_pending_change();
    }

    /// Starts the next queued change of the catalogue, if none is running: changes wait for each other, since none may
    /// be replaced by a later one.
    fn start_pending_change(&mut self) {
        if self.jobs.busy(Lane::Store) {
            return;
        }
        let Some(shelf) = self.state.shelf() else { return };
        if let Some(change) = self.pending_changes.pop_front() {
            self.start(Lane::Store, move |_| change(&*shelf));
        }
    }

    /// Stores the results of finished jobs in the window, without waiting.
    pub fn poll(&mut self) {
        // Ended, or stopped.
        self.writing &= self.jobs.busy(Lane::Export);
        for finished in self.jobs.poll() {
            match finished.outcome {
                Ok(outcome) => self.take(outcome),
                Err(error) => self.take_failure(finished.lane, finished.stage, error),
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
                self.look_up_deleted();
                self.look_up_sets();
                self.sync_subscribed();
                self.fill_due = true;
                self.asked = None;
                self.start_waiting_files();
            }
            Outcome::Builtin(Ok(0)) => self.search(),
            Outcome::Builtin(Ok(_)) => {
                self.fill_due = true;
                // What was computed has a picture now.
                if self.state.settings.gallery {
                    self.search();
                }
            }
            Outcome::Provided(Ok(())) => {
                self.state.computing = None;
                // What was computed has a picture now.
                if self.state.settings.gallery {
                    self.search();
                }
                // LID and room wait for the same data in their own lanes.
                self.ask_scene();
            }
            Outcome::Provided(Err(error)) => {
                self.state.computing = None;
                self.state.dataset.error = Some(error.to_string());
            }
            Outcome::Builtin(Err(error)) => {
                self.toasts.warning(shell::builtin_failed(error));
                // Failed states are skipped from now on; a catalogue that cannot be written to fails permanently.
                self.fill_failures += 1;
                self.fill_due = true;
            }
            Outcome::Opened(Err(error)) => self.state.catalogue = CatalogueState::Failed(error.to_string()),
            Outcome::Found(Ok(found)) => {
                self.state.search_error = None;
                self.state.found = Arc::new(found);
                self.select_something();
                self.choose_first();
            }
            Outcome::Found(Err(error)) => self.state.search_error = Some(error.to_string()),
            Outcome::Hits(found) => self.take_hits(found),
            Outcome::Scene(loaded, daylight) => self.take_scene(loaded, daylight),
            Outcome::Year(result) => self.results.year.take(result),
            Outcome::Annual(result) => self.results.annual.take(result.map(|annual| *annual)),
            Outcome::Ranked(result) => self.take_ranked(result),
            Outcome::Weather(result) => self.results.weather.take(result.map(|calendar| *calendar)),
            Outcome::OpenedWeather(path) => self.take_weather_file(&path),
            Outcome::DataForm(made) => self.results.form.put(Arc::new(made)),
            Outcome::Schemes(made) => self.results.schemes.put(Arc::new(made)),
            Outcome::Accuracy(result) => self.results.accuracy.take(result),
            Outcome::Obstructions(effects) => self.results.obstructions.put(Arc::new(effects)),
            Outcome::Lid(result) => self.results.lid.take(result),
            Outcome::Peaks(of, peaks) => self.results.peaks = Some((of, peaks)),
            Outcome::Room(result) => self.take_room(result),
            Outcome::Surfaces(result) => self.results.surfaces.take(result),
            Outcome::Compared(id, what) => self.compare.take(id, *what),
            Outcome::Chosen(Ok(paths)) => self.apply(Command::OpenPaths(paths)),
            // Who pressed a button for it sees nothing else.
            Outcome::Target(PathUse::Export, Err(error)) => self.toasts.info(error.to_string()),
            // Without a dialog the sheet's path field is the way, and it is open already.
            Outcome::Chosen(Err(_)) | Outcome::Target(_, Err(_) | Ok(None)) => {}
            // Chosen, not yet written: the preview continues.
            Outcome::Target(PathUse::Export, Ok(Some(path))) => self.state.path = path.display().to_string(),
            Outcome::Target(what, Ok(Some(path))) => self.apply(Command::Write(what, path)),
            Outcome::Several(list) => list.into_iter().for_each(|outcome| self.take(outcome)),
            Outcome::Rearranged(import, names) => self.take_rearranged(*import, &names),
            Outcome::Examined(dataset, found) => self.state.examined = Some((dataset, found)),
            Outcome::Read(import) => self.take_import(*import),
            Outcome::Repaired(files, repaired) => self.take_repaired(&files, repaired),
            Outcome::ReadScene(path, Ok(scene)) => {
                end_step(&mut self.undoer, &self.state.document);
                self.state.document.scene = *scene;
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
                self.report_error(&error);
            }
            Outcome::Added(numbers, Ok(products)) => self.take_added(&numbers, products),
            Outcome::Added(numbers, Err(error)) => {
                self.state.under_way = None;
                self.take_not_added(&numbers, &error);
            }
            Outcome::Choice(Ok(product)) => self.choose_product(&product),
            Outcome::Choice(Err(error)) => self.report_error(&error),
            Outcome::Changed(number, forth, result) => self.take_changed(number, forth, result),
            Outcome::Editing(looked) => self.take_editing(looked),
            Outcome::ToReplace(change) => self.take_replacement(change),
            Outcome::Reread(result) => self.take_reread(result),
            Outcome::Synced(result) => self.take_synced(result),
            Outcome::Folder(folder) => self.take_folder(folder),
            Outcome::Sets(sets) => self.take_sets(sets),
            Outcome::Pictures(made) => self.take_pictures(made),
            Outcome::Deleted(list) => self.take_deleted(list),
            Outcome::Stored(result) => {
                if let Err(error) = result {
                    self.toasts.error(error.to_string());
                }
                self.search();
            }
            Outcome::Preview(result) => {
                self.state.export.revision += 1;
                self.state.export.shown = Some(result.map_err(|error| error.to_string()));
            }
            Outcome::Copied(tile, drawn) => self.take_copied(tile, drawn),
            Outcome::There(what, path, there) => self.take_there(what, path, there),
            Outcome::Written(what, Ok(path)) => {
                self.remember_folder(&path);
                self.toasts.success(shell::written(files::absolute(&path).display()));
                if what == PathUse::SaveScene {
                    self.state.scene_path = Some(path);
                }
            }
            Outcome::Written(_, Err(error)) => self.report_error(&error),
            Outcome::Warning(text) => self.toasts.warning(text),
            Outcome::Fonts(fonts, missing) => self.take_fonts(fonts, missing),
        }
    }

    fn take_scene(&mut self, loaded: Result<LoadedSelection, AppError>, daylight: Result<Daylight, SkyKeyError>) {
        match loaded {
            Ok(LoadedSelection { product, state, dataset }) => {
                self.state.product = Some(product.clone());
                self.state.shown_state.clone_from(&state);
                self.state.dataset.error = None;
                match dataset {
                    Some(dataset) => {
                        self.state.dataset.put(dataset);
                        self.stop_computing();
                    }
                    None => self.compute_state(&product, state),
                }
                self.due.owe(Lane::Year);
            }
            Err(error) => self.state.dataset.error = Some(error.to_string()),
        }
        self.state.scene_error = daylight.as_ref().err().cloned();
        self.state.daylight.take(daylight);
    }

    fn take_added(&mut self, numbers: &[usize], products: Vec<(bool, Arc<Product>)>) {
        self.adding.retain(|number| !numbers.contains(number));
        (self.state.under_way, self.state.storing) = (None, None);
        let (mut added, mut there, mut undone) = (Vec::new(), 0, Vec::new());
        for (&number, (new, product)) in numbers.iter().zip(products) {
            if !new {
                // This import did not add it, so undo does not remove it.
                there += 1;
            } else if self.state.document.additions.contains(&number) {
                self.state.additions[number].key = Some(product.key.clone());
            } else {
                // Undone while it was being stored.
                undone.push(product.key.clone());
                continue;
            }
            added.push(product);
        }
        if !undone.is_empty() {
            self.store(move |shelf| shelf.remove_all(&undone));
        }
        // What was asked before they were there has failed.
        self.asked = None;
        if let Some(first) = added.first() {
            let what = match (added.len() - there, there) {
                (0, _) => shell::NOTHING_NEW.into(),
                (1, 0) => shell::ADDED.into(),
                (new, 0) => shell::added(new),
                (new, known) => shell::added_some(new, known),
            };
            self.toasts.success(what);
            // The step that added it also shows it.
            let (rule, place) = first.representative();
            let state = first.states.get(place).filter(|_| first.states.len() > 1);
            let state = state.map(|state| state.key.as_str());
            first_choice(&mut self.state.document, first.key.clone(), rule, state);
            end_step(&mut self.undoer, &self.state.document);
        }
        self.search();
    }

    /// Sets the selection to the product in the first aperture from the catalogue after a scene was opened. With a
    /// scene without products of the catalogue the selection stays.
    fn adopt_selection(&mut self) {
        if let Some(selection) = selection_of(&self.state.document.scene) {
            self.state.document.selection = selection;
        } else if !self.state.document.selection.product.is_empty() {
            self.report_own_system(title::product(&self.state));
        }
    }

    /// Shows a message if the scene's apertures contain another system than the product that the other tiles show.
    fn report_own_system(&mut self, product: String) {
        if let Some(system) = own_system(&self.state.document.scene) {
            self.toasts.info(shell::own_system(title::system(system), product));
        }
    }

    /// Selects a product at the first start: a light-guiding product if there is one, else the first. A scene with
    /// other systems is not changed.
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
        if own_system(&self.state.document.scene).is_some() {
            let state = state.unwrap_or_default().to_owned();
            self.state.document.selection = Selection { product: chosen.key.clone(), state };
            self.report_own_system(chosen.name.clone());
        } else {
            first_choice(&mut self.state.document, chosen.key.clone(), chosen.rule, state);
        }
        self.undoer = fresh_undoer(&self.state.document);
    }

    /// Starts the computation of the annual shading control again if its input has changed.
    pub(super) fn ask_year(&mut self) {
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

    /// Starts the search for the peak intensities of the current LID, once it no longer changes: this takes longer than
    /// the LID itself, and while dragging the next LID would follow before it is finished.
    pub(super) fn ask_peaks(&mut self) {
        let lid = &self.results.lid;
        let Some(figures) = lid.value.as_ref().filter(|_| !lid.stale) else { return };
        let asked = self.asked_peaks.as_ref().is_some_and(|asked| Arc::ptr_eq(asked, figures));
        // A table of all directions takes seconds: not before the pictures are there.
        let sooner = [Lane::Scene, Lane::Product, Lane::Lid, Lane::Room].into_iter().any(|lane| self.jobs.busy(lane));
        let hidden = !self.bench.visible_tiles(self.state.maximised).contains(&tiles::LID);
        if asked || sooner || hidden || self.ctx.input(|input| input.pointer.any_down()) {
            return;
        }
        let figures = figures.clone();
        self.asked_peaks = Some(figures.clone());
        self.start(Lane::Lid, move |_| {
            let peaks = Peaks::of(&figures.lid);
            Outcome::Peaks(figures, peaks)
        });
    }

    /// Starts the runs of the current scene with rising effort (error against computing time) and opens their sheet.
    pub(super) fn measure_accuracy(&mut self) {
        self.state.sheet = Some(Sheet::Accuracy);
        let Some(shelf) = self.state.shelf() else {
            self.toasts.info(shell::CATALOGUE_NOT_OPEN);
            return;
        };
        let question = Question { scene: self.state.document.scene.clone(), base: self.state.base(), shelf };
        let engine = self.services.engine.clone();
        self.results.accuracy.error = None;
        self.start(Lane::Accuracy, move |job| Outcome::Accuracy(engine.accuracy(&question, job)));
    }

    /// Starts computing the effect of every obstruction of the current scene on the illuminance of the apertures.
    pub(super) fn weigh_obstructions(&mut self) {
        let (scene, base) = (self.state.document.scene.clone(), self.state.base());
        self.results.obstructions.error = None;
        self.start(Lane::Obstructions, move |job| Outcome::Obstructions(obstructions(scene, &base, job)));
    }

    /// Starts reading product, state and dataset of the selection, and computing sky and sun.
    fn ask_scene(&mut self) {
        let Some(shelf) = self.state.shelf() else { return };
        let document = &self.state.document;
        let (scene, selection, base) = (document.scene.clone(), document.selection.clone(), self.state.base());
        let aperture = self.state.control_aperture();
        self.start(Lane::Scene, move |job| {
            let daylight = daylight(&scene, &base, job);
            let place = (aperture, base.as_path());
            Outcome::Scene(take_from_shelf(&*shelf, &selection, &scene, daylight.as_ref().ok(), place), daylight)
        });
    }

    /// Returns the language in which results of the current document were last requested; `None` if those of another
    /// document were, or none.
    pub(super) fn asked_last(&self) -> Option<Language> {
        let (asked, language) = self.asked.as_ref()?;
        asked.asks_the_same(&self.state.document).then_some(*language)
    }

    /// Starts all computations that a change of the document since the last call affects, and those of results with
    /// texts in another language.
    pub fn refresh(&mut self) {
        let document = &self.state.document;
        let asked = self.asked_last();
        if self.state.shelf().is_none() || document.selection.product.is_empty() || asked == Some(language()) {
            return;
        }
        let chosen = |document: &Document| document.selection.product.clone();
        self.fill_due |= self.asked.as_ref().map(|(asked, _)| chosen(asked)) != Some(chosen(document));
        // What was measured holds in every language.
        self.results.accuracy.stale |= asked.is_none();
        self.asked = Some((document.clone(), language()));
        self.note_shown();
        // Visible results have the computer to themselves.
        self.fill_due |= self.jobs.cancel(Lane::Builtin);
        self.stop_computing();
        self.state.dataset.stale = true;
        self.state.daylight.stale = true;
        self.results.lid.stale = true;
        self.results.room.stale = true;
        self.results.surfaces.stale = true;
        self.ask_scene();
        self.owe_results();
    }
}
