//! Computations of the window: each starts as soon as its result is visible. For a tile that is hidden behind a tab or a
//! maximised tile, nothing is computed.

pub mod backend;
pub mod engine;
pub mod work;

pub mod data_looks;
mod due;
mod examined;
mod findings;
mod looking;

pub use examined::Examined;
pub use looking::DataForms;

use super::catalogue::built_in::BuiltIn;
use super::shell::Shell;
use super::state::{Daylight, Document, Sheet, Shown};
use super::tiles;
use crate::app::results::engine::{LidFigures, Question, RoomFigures};
use crate::app::results::work::{LoadedSelection, Outcome, daylight, obstructions, take_from_shelf};
use crate::app::scene::control::{self, YearKey};
use crate::app::scene::selection::note_shown;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::Lane;
use crate::catalogue::Product;
use crate::compute::lid::c_gamma::Peaks;
use crate::study::scene_file::SceneFile;
use crate::study::sky::SkyKeyError;
use crate::texts::{language, shell};
use due::{Due, Geometry};
use std::sync::Arc;

/// Number of sensor points above which a grid is computed with half as many along both sides while room, apertures or
/// sensor points are being dragged.
const AT_ONCE: usize = 96;

/// Relative error allowed in the illuminances while dragging and in previews, which the coarsest mesh reaches.
const DRAGGED: f64 = 0.1;

/// Computations of the window that are due or were requested.
#[derive(Default)]
pub struct Computations {
    /// Computations that are still to be started.
    due: Due,
    /// Key of the control over a year that was last requested.
    asked_year: Option<YearKey>,
    /// LID whose largest intensities were last requested.
    asked_peaks: Option<Arc<LidFigures>>,
}

fn held(shell: &Shell) -> bool {
    shell.ctx.input(|input| input.pointer.any_down())
}

/// Whether the result of a lane is needed, because a visible tile shows it or because a file is about to be
/// written: files may contain results of all lanes but the surfaces. `lid_to_file`: whether the LID is about to be written.
fn is_wanted(shell: &Shell, lane: Lane, lid_to_file: bool) -> bool {
    let to_file = matches!(shell.state.sheet, Some(Sheet::Path(_))) && lane != Lane::Surfaces;
    to_file || lid_to_file && lane == Lane::Lid || shell.bench.shows(lane, shell.state.maximised)
}

impl Computations {
    /// Marks the results that a change of the document since the last call affects as due, or those with texts in
    /// another language, and starts what all of them need.
    pub fn refresh(&mut self, shell: &mut Shell, built_in: &mut BuiltIn) {
        let document = &shell.state.document;
        let asked = shell.asked_last();
        if shell.state.shelf().is_none() || document.selection.product.is_empty() || asked == Some(language()) {
            return;
        }
        let chosen = |document: &Document| document.selection.product.clone();
        if shell.asked.as_ref().map(|(asked, _)| chosen(asked)) != Some(chosen(document)) {
            built_in.owe();
        }
        // What was measured holds in every language.
        shell.results.accuracy.stale |= asked.is_none();
        shell.asked = Some((document.clone(), language()));
        note_shown(&mut shell.state);
        // Visible results have the computer to themselves.
        if shell.jobs.cancel(Lane::Builtin) {
            built_in.owe();
        }
        stop_computing(shell);
        shell.state.dataset.stale = true;
        shell.state.daylight.stale = true;
        shell.results.lid.stale = true;
        shell.results.room.stale = true;
        shell.results.surfaces.stale = true;
        ask_scene(shell);
        self.owe_results(shell);
    }

    /// Cancels the jobs for the old document after a change and marks all results as due.
    fn owe_results(&mut self, shell: &mut Shell) {
        for lane in [Lane::Lid, Lane::Room, Lane::Surfaces] {
            // While something is dragged a coarse picture comes to its end: else none ever would.
            if !(lane == Lane::Room && self.due.coarse && held(shell)) {
                shell.jobs.cancel(lane);
            }
            self.due.owe(lane);
        }
        self.due.previewed = false;
    }

    /// Whether all visible results are complete: no computation for them is running or still to be started.
    pub fn is_complete(&self, shell: &Shell, lid_to_file: bool) -> bool {
        const LANES: [Lane; 8] = [
            Lane::Scene,
            Lane::Product,
            Lane::Lid,
            Lane::Room,
            Lane::Surfaces,
            Lane::Year,
            Lane::DataForm,
            Lane::Schemes,
        ];
        // Without a product nothing is asked for.
        let nothing = shell.state.shelf().is_none() || shell.state.document.selection.product.is_empty();
        (nothing || shell.asked_last() == Some(language()))
            && !LANES.into_iter().any(|lane| shell.jobs.busy(lane))
            && !self.due.lanes.iter().any(|lane| is_wanted(shell, *lane, lid_to_file))
    }

    /// Starts the computations that are due and visible.
    pub fn ask_due(&mut self, shell: &mut Shell, lid_to_file: bool) {
        if self.due.coarse && !held(shell) {
            self.due.coarse = false;
            self.due.owe(Lane::Room);
            shell.jobs.cancel(Lane::Room);
        }
        for lane in self.due.lanes.clone() {
            let waits = lane == Lane::Room && self.due.coarse && shell.jobs.busy(lane);
            if !waits && is_wanted(shell, lane, lid_to_file) {
                self.due.lanes.remove(&lane);
                self.ask(shell, lane);
            }
        }
    }

    fn ask(&mut self, shell: &mut Shell, lane: Lane) {
        if lane == Lane::Year {
            return self.ask_year(shell);
        }
        let Some(shelf) = shell.state.shelf() else { return };
        let scene = shell.state.document.scene.clone();
        let mut question = Question { scene, base: shell.state.base(), shelf };
        let engine = shell.services.engine.clone();
        match lane {
            Lane::Lid => shell.start(lane, move |job| Outcome::Lid(engine.lid(&question, job))),
            Lane::Surfaces => shell.start(lane, move |job| Outcome::Surfaces(engine.surfaces(&question, job))),
            _ => {
                let coarse = self.coarsen(shell, &mut question.scene) || self.preview(&mut question.scene);
                shell.start(Lane::Room, move |job| {
                    let room = engine.room(&question, job);
                    Outcome::Room(room.map(|mut figures| {
                        figures.coarse = coarse;
                        figures
                    }))
                });
            }
        }
    }

    /// Reduces the scene to fewer sensor points and a coarser mesh while geometry is dragged; returns `true` if it did.
    fn coarsen(&mut self, shell: &Shell, scene: &mut SceneFile) -> bool {
        let geometry = Geometry::of(scene);
        let moved = self.due.geometry.as_ref().is_some_and(|old| *old != geometry);
        if let Some(plane) = scene.sensors.plane.as_mut().filter(|plane| plane.nx * plane.ny > AT_ONCE)
            && moved
            && held(shell)
        {
            (plane.nx, plane.ny) = (plane.nx.div_ceil(2), plane.ny.div_ceil(2));
            scene.compute.error_target = Some(scene.compute.error_target.unwrap_or_default().max(DRAGGED));
            self.due.coarse = true;
            return true;
        }
        self.due.geometry = Some(geometry);
        false
    }

    /// Raises the allowed error of the scene for a first, fast result if there are obstructions; returns `true` if it
    /// did.
    fn preview(&self, scene: &mut SceneFile) -> bool {
        let exact = scene.compute.error_target.is_none_or(|target| target < DRAGGED);
        let first = scene.has_outside() && exact && !self.due.previewed;
        if first {
            scene.compute.error_target = Some(DRAGGED);
        }
        first
    }

    /// Stores the illuminances of the room; after a preview, the accurate computation becomes due.
    pub fn take_room(&mut self, shell: &mut Shell, result: Result<RoomFigures, AppError>) {
        let preview = result.as_ref().is_ok_and(|room| room.coarse) && !self.due.coarse;
        shell.results.room.take(result);
        if self.due.owes(Lane::Room) {
            shell.results.room.stale = true;
        } else if preview {
            self.due.previewed = true;
            self.due.owe(Lane::Room);
        }
    }

    /// Takes over product, state and dataset of the selection, and sky and sun.
    pub fn take_scene(
        &mut self,
        shell: &mut Shell,
        loaded: Result<LoadedSelection, AppError>,
        daylight: Result<Daylight, SkyKeyError>,
    ) {
        match loaded {
            Ok(LoadedSelection { product, state, dataset }) => {
                shell.state.product = Some(product.clone());
                shell.state.shown_state.clone_from(&state);
                shell.state.dataset.error = None;
                match dataset {
                    Some(dataset) => {
                        shell.state.dataset.put(dataset);
                        stop_computing(shell);
                    }
                    None => compute_state(shell, &product, state),
                }
                self.due.owe(Lane::Year);
            }
            Err(error) => shell.state.dataset.error = Some(error.to_string()),
        }
        shell.state.scene_error = daylight.as_ref().err().cloned();
        shell.state.daylight.take(daylight);
    }

    /// Starts the computation of the annual shading control again if its input has changed.
    fn ask_year(&mut self, shell: &mut Shell) {
        let state = &shell.state;
        let Some(product) = state.product.clone() else { return };
        let key = state.year_key(&product.key);
        if key == self.asked_year {
            return;
        }
        self.asked_year.clone_from(&key);
        shell.results.year.stale = true;
        match key.filter(|_| product.states.len() > 1) {
            Some(key) => shell.start(Lane::Year, move |job| Outcome::Year(control::year(&product, key, job))),
            None => {
                shell.jobs.cancel(Lane::Year);
                shell.results.year = Shown::default();
            }
        }
    }

    /// Starts the search for the peak intensities of the current LID, once it no longer changes: this takes longer than
    /// the LID itself, and while dragging the next LID would follow before it is finished.
    pub fn ask_peaks(&mut self, shell: &mut Shell) {
        let lid = &shell.results.lid;
        let Some(figures) = lid.value.as_ref().filter(|_| !lid.stale) else { return };
        let asked = self.asked_peaks.as_ref().is_some_and(|asked| Arc::ptr_eq(asked, figures));
        // A table of all directions takes seconds: not before the pictures are there.
        let sooner = [Lane::Scene, Lane::Product, Lane::Lid, Lane::Room].into_iter().any(|lane| shell.jobs.busy(lane));
        let hidden = !shell.sees(tiles::LID);
        if asked || sooner || hidden || shell.ctx.input(|input| input.pointer.any_down()) {
            return;
        }
        let figures = figures.clone();
        self.asked_peaks = Some(figures.clone());
        shell.start(Lane::Lid, move |job| {
            let peaks = Peaks::of(&figures.lid, job).ok();
            Outcome::Peaks(figures, peaks)
        });
    }
}

/// Starts reading product, state and dataset of the selection, and computing sky and sun.
pub fn ask_scene(shell: &mut Shell) {
    let Some(shelf) = shell.state.shelf() else { return };
    let document = &shell.state.document;
    let (scene, selection, base) = (document.scene.clone(), document.selection.clone(), shell.state.base());
    let aperture = shell.state.control_aperture();
    shell.start(Lane::Scene, move |job| {
        let daylight = daylight(&scene, &base, job);
        let place = (aperture, base.as_path());
        Outcome::Scene(take_from_shelf(&*shelf, &selection, &scene, daylight.as_ref().ok(), place), daylight)
    });
}

/// Starts computing the data of a selected state, which the catalogue does not contain yet.
fn compute_state(shell: &mut Shell, product: &Product, state: String) {
    let Some(shelf) = shell.state.shelf() else { return };
    let label = product.states.iter().find(|one| one.key == state).map_or("", |one| one.label.as_str());
    let what = if label.is_empty() { shell::ITS_DATA.get() } else { label };
    shell.state.computing = Some(shell::computing(what));
    let key = product.key.clone();
    shell.start(Lane::Product, move |job| Outcome::Provided(shelf.provide(&key, Some(&state), job)));
}

/// Cancels the computation of the data of a state.
pub fn stop_computing(shell: &mut Shell) {
    shell.jobs.cancel(Lane::Product);
    shell.state.computing = None;
}

/// Starts the runs of the current scene with rising effort (error against computing time) and opens their sheet.
pub fn measure_accuracy(shell: &mut Shell) {
    shell.state.sheet = Some(Sheet::Accuracy);
    let Some(shelf) = shell.state.shelf() else {
        shell.toasts.info(shell::CATALOGUE_NOT_OPEN);
        return;
    };
    let question = Question { scene: shell.state.document.scene.clone(), base: shell.state.base(), shelf };
    let engine = shell.services.engine.clone();
    shell.results.accuracy.error = None;
    shell.start(Lane::Accuracy, move |job| Outcome::Accuracy(engine.accuracy(&question, job)));
}

/// Starts computing the effect of every obstruction of the current scene on the illuminance of the apertures.
pub fn weigh_obstructions(shell: &mut Shell) {
    let (scene, base) = (shell.state.document.scene.clone(), shell.state.base());
    shell.results.obstructions.error = None;
    shell.start(Lane::Obstructions, move |job| Outcome::Obstructions(obstructions(scene, &base, job)));
}
