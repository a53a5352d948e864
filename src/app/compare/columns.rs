//! Candidates of the comparison with their results. Each candidate has a window state and results like a window, so
//! that every tile can draw it. Results are stored while the candidate's scene is unchanged; only visible ones are
//! computed.

use crate::app::compare::view::Part;
use crate::app::results::work::{Compared, LoadedSelection};
use crate::app::scene::control::YearKey;
use crate::app::scene::incidence::Incidence;
use crate::app::scene::room_look::RoomView;
use crate::app::scene::selection_of;
use crate::app::shell::error::AppError;
use crate::app::state::{CatalogueState, Daylight, Document, Results, Settings, Shown, State, Tile};
use crate::app::tiles::Bench;
use crate::app::views::Cache;
use crate::app::views::difference::{self, Picture};
use crate::compute::btdf::Dataset;
use crate::compute::direction::Incident;
use crate::drawing::plot::Plot;
use crate::report::TileKind;
use crate::study::comparison::{DataFacts, Facts, LidFacts, candidate, label, same_question};
use crate::study::scene_file::{CompareKeys, SceneFile};
use std::path::PathBuf;
use std::sync::Arc;

/// Candidate of the comparison with its results.
pub struct Column {
    /// Identity of the candidate, independent of its position in the list.
    pub id: u64,
    /// Entry of the candidate in the scene's list of candidates.
    pub keys: CompareKeys,
    /// Name of the candidate.
    pub name: String,
    /// State of a window that shows the candidate.
    pub state: State,
    /// Results computed for the candidate.
    pub results: Results,
    /// Tiles that draw the candidate.
    pub bench: Bench,
    /// State of the view that draws the difference from the reference.
    pub difference: difference::State,
    /// Whether the figures of the dataset were requested, and the figures if they are known.
    data: (bool, Option<DataFacts>),
}

/// Replaces an outdated result by an up-to-date one of another state.
fn adopt<T>(own: &mut Shown<T>, from: &Shown<T>) {
    if own.stale && !from.stale {
        *own = Shown { value: from.value.clone(), stale: false, error: None, revision: from.revision };
    }
}

/// Whether a result is to be computed: it is missing or outdated, and its computation has not failed.
fn due<T>(shown: &Shown<T>) -> bool {
    shown.stale && shown.error.is_none()
}

fn outdate<T>(shown: &mut Shown<T>) {
    (shown.stale, shown.error) = (true, None);
}

impl Column {
    fn new(id: u64, keys: CompareKeys, scene: SceneFile) -> Self {
        let mut state = State::new(Settings::default());
        state.document.scene = scene;
        state.document.selection = selection_of(&state.document.scene).unwrap_or_default();
        let name = label(&keys);
        Self {
            id,
            keys,
            name,
            state,
            results: Results::default(),
            bench: Bench::default(),
            difference: difference::State::default(),
            data: (false, None),
        }
    }

    /// Returns the scene of the candidate.
    pub fn scene(&self) -> &SceneFile {
        &self.state.document.scene
    }

    /// Whether a document (scene and selection) shows the same as the candidate.
    pub fn shows(&self, document: &Document) -> bool {
        same_question(self.scene(), &document.scene) && self.state.document.selection == document.selection
    }

    fn set_scene(&mut self, scene: SceneFile) {
        self.state.document.selection = selection_of(&scene).unwrap_or_default();
        self.state.document.scene = scene;
        outdate(&mut self.state.dataset);
        outdate(&mut self.state.daylight);
        outdate(&mut self.results.lid);
        outdate(&mut self.results.room);
        outdate(&mut self.results.surfaces);
        outdate(&mut self.results.year);
        self.data.0 = false;
    }

    /// Returns the key of all input of the annual shading control of the candidate's product; `None` without location
    /// and date.
    pub fn year_key(&self) -> Option<YearKey> {
        let product = self.state.product.as_ref().filter(|product| product.states.len() > 1)?;
        YearKey::new(self.scene(), &product.key, self.state.control_keys(), 0, self.state.base())
    }

    /// Whether results of this kind are to be computed for the candidate.
    pub fn lacks(&self, part: Part) -> bool {
        match part {
            Part::Shelf => due(&self.state.dataset) || due(&self.state.daylight),
            Part::Lid => due(&self.results.lid),
            Part::Room => due(&self.results.room),
            Part::Surfaces => self.state.settings.room.view == RoomView::Perspective && due(&self.results.surfaces),
            Part::Peaks => !self.results.lid.stale && self.results.lid_peaks().is_none(),
            Part::Year => !self.state.dataset.stale && due(&self.results.year) && self.year_key().is_some(),
            Part::Data => !self.data.0 && !self.state.dataset.stale,
        }
    }

    /// Returns the revision numbers of dataset, daylight, LID and room, which change with these results.
    pub fn revisions(&self) -> [u64; 4] {
        let (state, results) = (&self.state, &self.results);
        [state.dataset.revision, state.daylight.revision, results.lid.revision, results.room.revision]
    }

    /// Returns the incident direction for which the candidate's tiles show the light distribution.
    pub fn incident(&self) -> Incident {
        Incidence::shown(self.state.incident, self.scene(), &self.state.base()).direction
    }

    /// Returns the reason why a result of the candidate is missing, if one is.
    pub fn error(&self) -> Option<&str> {
        let errors = [&self.state.dataset.error, &self.results.lid.error, &self.results.room.error];
        errors.into_iter().flatten().next().map(String::as_str)
    }

    /// Returns the results from which the candidate's figures are computed, those that are known and up to date.
    pub fn facts(&self) -> Facts {
        let lid = self.results.lid.value.as_ref().filter(|_| !self.results.lid.stale);
        let room = self.results.room.value.as_ref().filter(|_| !self.results.room.stale);
        Facts {
            data: self.data.1.filter(|_| self.data.0),
            lid: lid.map(|lid| LidFacts { flux: lid.flux, peaks: self.results.lid_peaks().copied() }),
            room: room.map(|room| room.totals().collect()),
        }
    }

    fn take_own(&mut self, own: Result<(String, Arc<Dataset>), AppError>, daylight: Result<Daylight, String>) {
        self.state.product = None;
        match own {
            Ok((state, dataset)) => {
                self.state.shown_state = state;
                self.state.dataset.put(dataset);
            }
            Err(error) => self.state.dataset.error = Some(error.to_string()),
        }
        self.state.daylight.take(daylight);
    }

    fn take_shelf(&mut self, loaded: Result<LoadedSelection, AppError>, daylight: Result<Daylight, String>) {
        match loaded {
            Ok(LoadedSelection { product, state, dataset }) => {
                self.state.product = Some(product);
                self.state.shown_state = state;
                match dataset {
                    Some(dataset) => self.state.dataset.put(dataset),
                    None => self.state.dataset = Shown::default(),
                }
            }
            Err(error) => self.state.dataset.error = Some(error.to_string()),
        }
        self.state.daylight.take(daylight);
    }

    /// Stores the result of a job for the candidate.
    pub fn take(&mut self, what: Compared) {
        match what {
            Compared::Shelf(loaded, daylight) => self.take_shelf(loaded, daylight.map_err(|error| error.to_string())),
            Compared::Own(own, daylight) => self.take_own(own, daylight.map_err(|error| error.to_string())),
            Compared::Surfaces(result) => self.results.surfaces.take(result),
            Compared::Lid(result) => self.results.lid.take(result),
            Compared::Peaks(of, peaks) => self.results.peaks = Some((of, peaks)),
            Compared::Room(result) => self.results.room.take(result),
            Compared::Year(result) => self.results.year.take(result),
            Compared::Data(facts) => self.data = (true, facts),
            Compared::Failed(part, error) => self.fail(part, error),
        }
    }

    fn fail(&mut self, part: Part, error: String) {
        match part {
            Part::Shelf => self.state.dataset.error = Some(error),
            Part::Lid | Part::Peaks => {
                self.results.lid.stale = true;
                self.results.lid.error = Some(error);
            }
            Part::Room => self.results.room.error = Some(error),
            Part::Surfaces => self.results.surfaces.error = Some(error),
            Part::Year => self.results.year.error = Some(error),
            Part::Data => self.data = (true, None),
        }
    }
}

/// Key of a common colour scale: the tile, the revisions of the candidates' results, and their incident directions.
pub type ScaleKey = (&'static str, Vec<[u64; 4]>, Vec<Option<[u64; 3]>>);
/// Key of a picture of all candidates: the key of the colour scale, the position of the reference, and the names.
pub type PictureKey = (ScaleKey, usize, Vec<String>);

/// All candidates of the comparison.
#[derive(Default)]
pub struct Columns {
    /// Candidates in the order of the comparison.
    pub(super) list: Vec<Column>,
    /// Candidate (by its identity) and kind of results that are being computed.
    pub(super) running: Option<(u64, Part)>,
    /// Whether the user has stopped the computation, until something changes.
    pub(super) stopped: bool,
    /// Cache of the common colour scale, its lowest and highest value.
    pub(super) scale: Cache<ScaleKey, Option<[f64; 2]>>,
    /// Cache of the differences of all candidates from the reference.
    pub(super) differences: Cache<PictureKey, Vec<Option<Picture>>>,
    /// Cache of the plots of all candidates.
    pub(super) plots: Cache<PictureKey, Vec<Plot>>,
    next: u64,
    seen: Option<(SceneFile, PathBuf)>,
}

impl Columns {
    /// Updates the candidates from the scene's list; returns whether the running computation is no longer needed.
    pub fn follow(&mut self, state: &State, results: &Results) -> bool {
        let scene = &state.document.scene;
        let path = state.scene_path.clone().unwrap_or_default();
        if !self.seen.as_ref().is_some_and(|(seen, from)| seen == scene && *from == path) {
            self.seen = Some((scene.clone(), path));
            self.stopped = false;
            self.renew(scene);
        }
        for column in &mut self.list {
            let own = &mut column.state;
            (own.incident, own.computing) = (state.incident, None);
            own.scene_path.clone_from(&state.scene_path);
            own.settings.room = state.settings.room;
            // Surfaces have no scale in common: side by side the plan stands for them.
            if state.compare.open && own.settings.room.view == RoomView::Perspective {
                own.settings.room.view = RoomView::Plan;
            }
            if let CatalogueState::Ready(shelf) = &state.catalogue {
                own.catalogue = CatalogueState::Ready(shelf.clone());
            }
            if column.shows(&state.document) {
                column.adopt(state, results);
            }
        }
        let wanted = |(id, part): (u64, Part)| self.list.iter().any(|column| column.id == id && column.lacks(part));
        let gone = self.running.is_some_and(|running| !wanted(running));
        if gone {
            self.running = None;
        }
        gone
    }

    fn renew(&mut self, scene: &SceneFile) {
        let mut old = std::mem::take(&mut self.list);
        for keys in &scene.compare {
            let own = candidate(scene, keys);
            let bare = |keys: &CompareKeys| CompareKeys { name: String::new(), ..keys.clone() };
            let place = old.iter().position(|column| bare(&column.keys) == bare(keys));
            let column = match place.map(|place| old.remove(place)) {
                Some(mut column) => {
                    if !same_question(column.scene(), &own) {
                        column.set_scene(own);
                    }
                    Column { name: label(keys), keys: keys.clone(), ..column }
                }
                None => {
                    self.next += 1;
                    Column::new(self.next, keys.clone(), own)
                }
            };
            self.list.push(column);
        }
    }

    /// Returns the key of a picture of all candidates.
    pub fn key(&self, tile: &'static str) -> ScaleKey {
        let bits = |column: &Column| {
            (tile == TileKind::Btdf.title()).then(|| column.incident().0.vector().to_array().map(f64::to_bits))
        };
        (tile, self.list.iter().map(Column::revisions).collect(), self.list.iter().map(bits).collect())
    }

    /// Returns the first candidate of `columns` that lacks results of one of the kinds `parts`, and that kind.
    pub fn next(&self, columns: impl Iterator<Item = usize>, parts: &[Part]) -> Option<(&Column, Part)> {
        let columns: Vec<&Column> = columns.filter_map(|place| self.list.get(place)).collect();
        // Part by part: all have their first picture before one has its last figure.
        parts.iter().find_map(|part| columns.iter().find(|column| column.lacks(*part)).map(|column| (*column, *part)))
    }

    /// Returns the candidates in the order of the comparison.
    pub fn candidates(&self) -> &[Column] {
        &self.list
    }

    /// Whether the user has stopped the computation.
    pub const fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// Returns for every candidate whether the scale of a tile is logarithmic; empty if the tile has no such choice.
    pub fn logs(&mut self, tile: Tile) -> Vec<bool> {
        self.list.iter_mut().filter_map(|column| column.bench.log(tile).copied()).collect()
    }

    /// Returns the names of the candidates, each with its position so that no two are equal.
    pub fn names(&self) -> Vec<String> {
        self.list.iter().enumerate().map(|(at, column)| format!("{} {}", at + 1, column.name)).collect()
    }

    /// Returns lowest and highest value of the common colour scale of the tiles side by side, as drawn last.
    pub fn common_scale(&self) -> Option<[f64; 2]> {
        self.scale.last().copied().flatten()
    }

    /// Stores the result of a job for the candidate with this identity.
    pub fn take(&mut self, id: u64, what: Compared) {
        self.running = None;
        if let Some(column) = self.list.iter_mut().find(|column| column.id == id) {
            column.take(what);
        }
    }

    /// Records that the running job of the comparison ended with an internal error.
    pub fn fail(&mut self, error: String) {
        if let Some((id, part)) = self.running.take() {
            self.take(id, Compared::Failed(part, error));
        }
    }

    /// Stops the computation of candidates until something changes.
    pub fn stop(&mut self) {
        (self.stopped, self.running) = (true, None);
    }

    /// Returns the state and results that the tiles show: those of the swapped-in candidate, or those of the scene.
    pub fn shown<'a>(&'a self, state: &'a State, results: &'a Results) -> (&'a State, &'a Results) {
        let swapped = state.compare.swapped.and_then(|place| self.list.get(place));
        swapped.map_or((state, results), |column| (&column.state, &column.results))
    }
}

impl Column {
    /// Copies results that the window has already computed for the same scene.
    fn adopt(&mut self, state: &State, results: &Results) {
        if self.state.dataset.stale && !state.dataset.stale {
            self.state.product.clone_from(&state.product);
            self.state.shown_state.clone_from(&state.shown_state);
        }
        adopt(&mut self.state.dataset, &state.dataset);
        adopt(&mut self.state.daylight, &state.daylight);
        adopt(&mut self.results.lid, &results.lid);
        adopt(&mut self.results.room, &results.room);
        adopt(&mut self.results.surfaces, &results.surfaces);
        if self.results.lid_peaks().is_none() {
            self.results.peaks.clone_from(&results.peaks);
        }
    }
}
