//! What runs in jobs, and what its results do to the window.

use super::App;
use super::control::{CONTROLLED, Year, YearKey};
use super::engine::{Engine, LidFigures, Question, RoomFigures};
use super::goniophotometer::Finished;
use super::jobs::{JobState, Lane};
use super::shelf::{Addition, Found, Shelf};
use super::state::{CatalogueState, Daylight, Import, PathUse, Selection, Sheet};
use crate::catalogue::{Gathered, Product, SYSTEMS, SourceFile, gather};
use crate::compute::angle::Bearing;
use crate::compute::btdf::Dataset;
use crate::compute::direction::Orientation;
use crate::compute::doctor::{Diagnosis, Repair, examine, repaired_all};
use crate::compute::estimate::Progress;
use crate::compute::lid::Facing;
use crate::formats::control_curve::read_control_curve;
use crate::formats::system_toml::is_system_file;
use crate::study::accuracy::Accuracy;
use crate::study::control::ControlQuestion;
use crate::study::scene_file::{ControlKeys, ControlMode, SceneFile};
use crate::study::sky::{SkyKeyError, outside_from_keys};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Reads the datasets of a file: name and bytes.
pub type ReadDataset = fn(&str, &[u8]) -> Result<SourceFile, String>;

/// Files beyond this are refused before they are read. \[bytes\]
const LARGEST_FILE: u64 = 1 << 30;

/// What jobs bring back.
#[expect(clippy::large_enum_variant, reason = "a few a second, each moved once")]
pub enum Outcome {
    /// The catalogue is open.
    Opened(Result<Arc<dyn Shelf>, String>),
    /// A list.
    Found(Result<Found, String>),
    /// Product, state and dataset of the selection, and sky and sun.
    Scene(Result<Shelved, String>, Result<Daylight, SkyKeyError>),
    /// What control does over the year.
    Year(Result<Year, String>),
    /// The LID.
    Lid(Result<LidFigures, String>),
    /// The room.
    Room(Result<RoomFigures, String>),
    /// Error against run time.
    Accuracy(Result<Accuracy, String>),
    /// Files that the user chose.
    Chosen(Result<Vec<PathBuf>, String>),
    /// Where to write.
    Target(PathUse, Result<Option<PathBuf>, String>),
    /// Files were read.
    Read(Box<Import>),
    /// What was read, with repairs: the datasets, what is said about them, and the repairs; or why not.
    Mended(Result<Mended, String>),
    /// A system file was read: its text and folder.
    ReadSystem(Result<(String, PathBuf), String>),
    /// A state of a system was measured; the keys of all.
    Measured(Result<Box<(Vec<String>, Finished)>, String>),
    /// A scene was read.
    ReadScene(PathBuf, Result<Box<SceneFile>, String>),
    /// A control curve was read.
    ReadCurve(Result<Vec<[f64; 2]>, String>),
    /// An addition is in the catalogue.
    Added(usize, Result<String, String>),
    /// Something else in the catalogue was changed.
    Stored(Result<(), String>),
    /// A built-in product is in the catalogue; how many are left.
    Builtin(Result<usize, String>),
    /// A file was written.
    Written(PathUse, Result<PathBuf, String>),
}

/// What the catalogue holds of the selection.
pub struct Shelved {
    /// Product.
    pub product: Arc<Product>,
    /// Key of the state, picked by the scene's control where it is left to it.
    pub state: String,
    /// Its dataset.
    pub dataset: Arc<Dataset>,
}

/// Computes and stores one built-in product; how many are left.
fn fill_one(shelf: &dyn Shelf, progress: &JobState) -> Result<usize, String> {
    let Some((name, missing)) = shelf.next_builtin()? else { return Ok(0) };
    progress.advance("computing", SYSTEMS.len() - missing, SYSTEMS.len());
    // One core stays free for what the user is doing.
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads((cores - 1).max(1)).build();
    let compute = || crate::study::builtin::compute(name, progress).map_err(|error| error.to_string());
    let (product, datasets) = pool.map_err(|error| error.to_string())?.install(compute)?;
    shelf.put_builtin(name, product, &datasets)?;
    Ok(missing - 1)
}

/// The selection's product, state and dataset.
fn take_from_shelf(
    shelf: &dyn Shelf,
    selection: &Selection,
    scene: &SceneFile,
    daylight: Option<&Daylight>,
    (aperture, base): (usize, &Path),
) -> Result<Shelved, String> {
    let product = shelf.product(&selection.product)?;
    let state = if selection.state == CONTROLLED {
        let fixed = ControlKeys::of(ControlMode::Fixed);
        let keys = super::control::rule(scene, aperture).unwrap_or(&fixed);
        let daylight = daylight.ok_or_else(|| "no state is picked until sky and sun are right".to_owned())?;
        let facing = Facing {
            outside: &daylight.outside,
            sun: daylight.sun.as_ref(),
            orientation: Orientation::new(Bearing::from_degrees(scene.site.azimuth)),
            surface: super::control::surface_of(scene, aperture),
        };
        let hour = super::moment::of(scene).map(|time| f64::from(time.hour()) + f64::from(time.minute()) / 60.0);
        let asked = ControlQuestion { keys, base, hour, facing };
        shelf.controlled_state(&selection.product, &asked).map_err(|error| error.to_string())?
    } else if selection.state.is_empty() {
        product.states.first().map(|state| state.key.clone()).unwrap_or_default()
    } else {
        selection.state.clone()
    };
    let dataset = shelf.load(&selection.product, Some(&state))?;
    Ok(Shelved { product, state, dataset })
}

/// Reads files: one scene, system or control curve, or datasets.
pub fn read_files(paths: &[PathBuf], read: ReadDataset) -> Outcome {
    let text_of = |path: &Path, what: &str| {
        String::from_utf8(read_bytes(path)?).map_err(|e| {
            format!("{}: byte {} is not UTF-8; {what} is a text file", path.display(), e.utf8_error().valid_up_to())
        })
    };
    if let [path] = paths
        && is_system_file(&path.to_string_lossy())
    {
        let base = path.parent().map(PathBuf::from).unwrap_or_default();
        return Outcome::ReadSystem(text_of(path, "a system").map(|text| (text, base)));
    }
    if let [path] = paths
        && path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
    {
        let scene = text_of(path, "a scene").and_then(|text| {
            SceneFile::parse(&text).map(Box::new).map_err(|error| format!("{}: {error}", path.display()))
        });
        return Outcome::ReadScene(path.clone(), scene);
    }
    if let [path] = paths
        && path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"))
    {
        let told = |error: &dyn std::fmt::Display| format!("{}: as a control curve: {error}", path.display());
        let curve = read_bytes(path).and_then(|bytes| read_control_curve(&bytes).map_err(|error| told(&error)));
        return Outcome::ReadCurve(curve);
    }
    let mut import = Import::default();
    let mut sources = Vec::new();
    for path in paths {
        let name = path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into());
        match read_bytes(path).and_then(|bytes| read(&name, &bytes).map_err(|error| format!("{name}: {error}"))) {
            Ok(source) => sources.push(source),
            Err(error) => import.failures.push(error),
        }
        import.files.push(name);
    }
    let mut products = gather(sources, false).into_iter();
    if let Some(Gathered { meta, datasets, .. }) = products.next() {
        import.diagnoses = datasets.iter().map(examine).collect();
        import.datasets = datasets.into_iter().map(Arc::new).collect();
        import.originals = import.datasets.clone();
        import.name = meta.name;
        import.manufacturer = meta.manufacturer;
        import.kind = meta.kind;
        import.tags = meta.tags.join(", ");
        import.provenance = meta.provenance;
    }
    for other in products {
        let (name, files) = (other.meta.name, other.meta.provenance.source_file);
        import.failures.push(format!("{files}: another product (\"{name}\"); open it after this one"));
    }
    Outcome::Read(Box::new(import))
}

/// Datasets with repairs made.
#[derive(Debug)]
pub struct Mended {
    /// One a state.
    pub datasets: Vec<Arc<Dataset>>,
    /// What the data doctor says about each now.
    pub diagnoses: Vec<Vec<Diagnosis>>,
    /// The repairs.
    pub repairs: Vec<Repair>,
}

/// Makes repairs on all states and examines what comes of it.
pub(super) fn mend(originals: &[Arc<Dataset>], repairs: Vec<Repair>) -> Outcome {
    let mended: Result<Vec<Dataset>, _> = originals.iter().map(|dataset| repaired_all(dataset, &repairs)).collect();
    Outcome::Mended(mended.map_err(|error| error.to_string()).map(|datasets| Mended {
        diagnoses: datasets.iter().map(examine).collect(),
        datasets: datasets.into_iter().map(Arc::new).collect(),
        repairs,
    }))
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, String> {
    let told = |error: std::io::Error| format!("{}: cannot be read ({error}); check path and rights", path.display());
    let size = std::fs::metadata(path).map_err(told)?.len();
    if size > LARGEST_FILE {
        return Err(format!("{}: {size} bytes are more than the 1 GiB that is read", path.display()));
    }
    std::fs::read(path).map_err(told)
}

/// Writes beside the target first, so that a failure leaves nothing half-written.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<PathBuf, String> {
    let mut name = path
        .file_name()
        .map(std::ffi::OsStr::to_os_string)
        .ok_or_else(|| format!("{}: names no file; give a path that ends in a file name", path.display()))?;
    name.push(".part");
    let part = path.with_file_name(name);
    let told = |error: std::io::Error| format!("{}: cannot be written ({error})", path.display());
    let written = std::fs::write(&part, bytes).and_then(|()| std::fs::rename(&part, path));
    written.map_err(|error| {
        // Best effort: the part may never have come to be.
        drop(std::fs::remove_file(&part));
        told(error)
    })?;
    Ok(path.to_path_buf())
}

/// Saves the scene.
pub fn save_scene(path: &Path, text: Result<String, toml::ser::Error>) -> Outcome {
    let written = text
        .map_err(|error| format!("the scene cannot be written as text: {error}"))
        .and_then(|text| write_whole(path, text.as_bytes()));
    Outcome::Written(PathUse::SaveScene, written)
}

/// Writes the LID as a luminaire file.
pub fn export_lid(path: &Path, lid: Option<&LidFigures>, engine: &dyn Engine) -> Outcome {
    let written = lid
        .ok_or_else(|| "the LID is not computed yet: wait for its tile, then export again".to_owned())
        .and_then(|lid| engine.luminaire(lid, path))
        .and_then(|bytes| write_whole(path, &bytes));
    Outcome::Written(PathUse::ExportLid, written)
}

impl App {
    /// Starts a job that wakes the window when it ends.
    pub(super) fn start(&mut self, lane: Lane, work: impl FnOnce(&JobState) -> Outcome + Send + 'static) {
        let ctx = self.ctx.clone();
        self.jobs.start(lane, move || ctx.request_repaint(), work);
    }

    /// Looks the list up anew.
    pub(super) fn search(&mut self) {
        if let Some(shelf) = self.state.shelf() {
            let query = self.state.query.clone();
            self.start(Lane::Catalogue, move |_| Outcome::Found(shelf.search(&query)));
        }
    }

    /// Computes the next built-in product that is not stored yet, beside everything else. Stopped, it goes on when the
    /// catalogue is opened next.
    pub(super) fn fill_catalogue(&mut self) {
        let Some(shelf) = self.state.shelf() else { return };
        self.start(Lane::Builtin, move |progress| Outcome::Builtin(fill_one(&*shelf, progress)));
    }

    /// Changes the catalogue, one change after the other.
    pub(super) fn store(&mut self, change: impl FnOnce(&dyn Shelf) -> Result<(), String> + Send + 'static) {
        self.pending_changes.push_back(Box::new(move |shelf| Outcome::Stored(change(shelf))));
        self.start_pending_change();
    }

    /// Stores an addition of this session.
    pub(super) fn store_addition(&mut self, number: usize, addition: Addition) {
        self.pending_changes.push_back(Box::new(move |shelf| Outcome::Added(number, shelf.add(&addition))));
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
                if left > 0 {
                    self.fill_catalogue();
                }
            }
            Outcome::Builtin(Err(error)) => {
                self.toasts.warning(format!("Built-in products: {error}"));
            }
            Outcome::Opened(Err(error)) => self.state.catalogue = CatalogueState::Failed(error),
            Outcome::Found(Ok(found)) => {
                self.state.search_error = None;
                self.state.found = Arc::new(found);
                self.select_something();
            }
            Outcome::Found(Err(error)) => self.state.search_error = Some(error),
            Outcome::Scene(shelved, daylight) => self.take_scene(shelved, daylight),
            Outcome::Year(result) => self.results.year.take(result),
            Outcome::Accuracy(result) => {
                self.results.accuracy_revision += 1;
                self.results.accuracy.take(result);
            }
            Outcome::Lid(result) => self.results.lid.take(result),
            Outcome::Room(result) => self.results.room.take(result),
            Outcome::Chosen(Ok(paths)) => self.apply(super::command::Command::OpenPaths(paths)),
            // Without a dialog the sheet's path field is the way, and it is open already.
            Outcome::Chosen(Err(_)) | Outcome::Target(_, Err(_) | Ok(None)) => {}
            Outcome::Target(what, Ok(Some(path))) => self.apply(super::command::Command::Write(what, path)),
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
                self.toasts.error(error);
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
                self.apply(super::command::Command::ControlKeys(Box::new(keys)));
            }
            Outcome::ReadSystem(Ok((text, base))) => self.open_system(text, base),
            Outcome::Measured(result) => self.take_measured(result),
            Outcome::ReadScene(_, Err(error)) | Outcome::ReadCurve(Err(error)) | Outcome::ReadSystem(Err(error)) => {
                self.toasts.error(error).duration(None);
            }
            Outcome::Added(number, result) => self.take_added(number, result),
            Outcome::Stored(result) => {
                if let Err(error) = result {
                    self.toasts.error(error);
                }
                self.search();
            }
            Outcome::Written(what, Ok(path)) => {
                self.toasts.success(format!("Written: {}", path.display()));
                if what == PathUse::SaveScene {
                    self.state.scene_path = Some(path);
                }
            }
            Outcome::Written(_, Err(error)) => {
                self.toasts.error(error).duration(None);
            }
        }
    }

    fn take_scene(&mut self, shelved: Result<Shelved, String>, daylight: Result<Daylight, SkyKeyError>) {
        self.results.revision += 1;
        match shelved {
            Ok(Shelved { product, state, dataset }) => {
                self.state.product = Some(product);
                self.state.shown_state = state;
                self.state.dataset.value = Some(dataset);
                self.state.dataset.stale = false;
                self.state.dataset.error = None;
                self.ask_year();
            }
            Err(error) => self.state.dataset.error = Some(error),
        }
        match daylight {
            Ok(daylight) => {
                self.state.scene_error = None;
                self.state.daylight.take(Ok(daylight));
            }
            Err(error) => {
                self.state.daylight.error = Some(error.to_string());
                self.state.scene_error = Some(error);
            }
        }
    }

    fn take_added(&mut self, number: usize, result: Result<String, String>) {
        match result {
            // Undone while it was being stored.
            Ok(key) if !self.state.document.additions.contains(&number) => self.store(move |shelf| shelf.remove(&key)),
            Ok(key) => {
                self.toasts.success("Added to the catalogue; Ctrl+Z takes it out again");
                self.state.additions[number].key = Some(key.clone());
                // The step that added it also shows it.
                self.state.document.selection = Selection { product: key, state: String::new() };
                super::apply::fill(&mut self.state.document.scene, &self.state.document.selection);
                self.undoer.add_undo(&self.state.document);
            }
            Err(error) => {
                self.state.document.additions.retain(|&other| other != number);
                self.toasts.error(format!("Not added: {error}. The catalogue is unchanged.")).duration(None);
            }
        }
        self.search();
    }

    /// After opening a scene the selection is what its first catalogue aperture holds.
    fn adopt_selection(&mut self) {
        if let Some(selection) = super::state::selection_of(&self.state.document.scene) {
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
        let moving = entries.iter().find(|entry| entry.states.len() > 1);
        let guiding =
            || GUIDES.iter().find_map(|word| entries.iter().find(|entry| entry.name.to_lowercase().contains(word)));
        let chosen = moving.or_else(guiding).unwrap_or(&entries[0]);
        self.state.document.selection = Selection { product: chosen.key.clone(), state: String::new() };
        super::apply::fill(&mut self.state.document.scene, &self.state.document.selection);
        self.undoer = super::fresh_undoer(&self.state.document);
    }

    /// Asks for the year of control anew when something that it hangs on has changed.
    fn ask_year(&mut self) {
        let state = &self.state;
        let Some(product) = state.product.clone() else { return };
        let key = YearKey::new(state, &product.key);
        if key == self.asked_year {
            return;
        }
        self.asked_year.clone_from(&key);
        self.results.year.stale = true;
        match key.filter(|_| product.states.len() > 1) {
            Some(key) => self.start(Lane::Year, move |job| Outcome::Year(super::control::year(&product, key, job))),
            None => {
                self.jobs.cancel(Lane::Year);
                self.results.year = super::state::Shown::default();
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
