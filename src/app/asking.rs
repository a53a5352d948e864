//! Starts computations as soon as their results are visible: for a tile that is hidden behind a tab or a maximised
//! tile, nothing is computed.

use super::due::Geometry;
use super::engine::{Question, RoomFigures};
use super::error::AppError;
use super::jobs::Lane;
use super::state::Sheet;
use super::window::App;
use super::work::Outcome;
use crate::study::scene_file::SceneFile;
use crate::texts::language;

/// Number of sensor points above which a grid is computed with half as many along both sides while room, apertures or
/// sensor points are being dragged.
const AT_ONCE: usize = 96;

/// Relative error allowed in the illuminances while dragging and in previews, which the coarsest mesh reaches.
const DRAGGED: f64 = 0.1;

impl App {
    /// Cancels the jobs for the old document after a change and marks all results as due.
    pub(super) fn owe_results(&mut self) {
        for lane in [Lane::Lid, Lane::Room, Lane::Surfaces] {
            // While something is dragged a coarse picture comes to its end: else none ever would.
            if !(lane == Lane::Room && self.due.coarse && self.held()) {
                self.jobs.cancel(lane);
            }
            self.due.owe(lane);
        }
        self.due.previewed = false;
        self.ask_due();
    }

    /// Whether all visible results are complete: no computation for them is running or still to be started.
    pub(super) fn standing(&self) -> bool {
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
        let nothing = self.state.shelf().is_none() || self.state.document.selection.product.is_empty();
        (nothing || self.asked_last() == Some(language()))
            && !LANES.into_iter().any(|lane| self.jobs.busy(lane))
            && !self.due.lanes.iter().any(|lane| self.is_wanted(*lane))
    }

    fn held(&self) -> bool {
        self.ctx.input(|input| input.pointer.any_down())
    }

    /// Starts the computations that are due and visible.
    pub(super) fn ask_due(&mut self) {
        if self.due.coarse && !self.held() {
            self.due.coarse = false;
            self.due.owe(Lane::Room);
            self.jobs.cancel(Lane::Room);
        }
        for lane in self.due.lanes.clone() {
            let waits = lane == Lane::Room && self.due.coarse && self.jobs.busy(lane);
            if !waits && self.is_wanted(lane) {
                self.due.lanes.remove(&lane);
                self.ask(lane);
            }
        }
    }

    /// Whether the result of a lane is needed, because a visible tile shows it or because a file is about to be
    /// written: files may contain results of all lanes but the surfaces.
    fn is_wanted(&self, lane: Lane) -> bool {
        let to_file = matches!(self.state.sheet, Some(Sheet::Path(_))) && lane != Lane::Surfaces;
        let lid_to_file = self.lid_to.is_some() && lane == Lane::Lid;
        to_file || lid_to_file || self.bench.shows(lane, self.state.maximised)
    }

    fn ask(&mut self, lane: Lane) {
        if lane == Lane::Year {
            return self.ask_year();
        }
        let Some(shelf) = self.state.shelf() else { return };
        let scene = self.state.document.scene.clone();
        let mut question = Question { scene, base: self.state.base(), shelf };
        let engine = self.services.engine.clone();
        match lane {
            Lane::Lid => self.start(lane, move |job| Outcome::Lid(engine.lid(&question, job))),
            Lane::Surfaces => self.start(lane, move |job| Outcome::Surfaces(engine.surfaces(&question, job))),
            _ => {
                let coarse = self.coarsen(&mut question.scene) || self.preview(&mut question.scene);
                self.start(Lane::Room, move |job| {
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
    fn coarsen(&mut self, scene: &mut SceneFile) -> bool {
        let geometry = Geometry::of(scene);
        let moved = self.due.geometry.as_ref().is_some_and(|old| *old != geometry);
        if let Some(plane) = scene.sensors.plane.as_mut().filter(|plane| plane.nx * plane.ny > AT_ONCE)
            && moved
            && self.held()
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
    pub(super) fn take_room(&mut self, result: Result<RoomFigures, AppError>) {
        let preview = result.as_ref().is_ok_and(|room| room.coarse) && !self.due.coarse;
        self.results.room.take(result);
        if self.due.owes(Lane::Room) {
            self.results.room.stale = true;
        } else if preview {
            self.due.previewed = true;
            self.due.owe(Lane::Room);
        }
    }
}
