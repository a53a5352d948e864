//! What the window knows: the document that undo goes over, settings that are kept, and what is only shown.

use super::changes::{Change, Editing};
use super::choose::{Figures, Pace};
use super::compare::View;
use super::control::{Year, YearKey};
use super::data_looks::{DataLook, FormResult, SchemesResult};
use super::engine::{LidFigures, RoomFigures, SurfaceFigures};
use super::goniophotometer::Bench;
use super::hand_on::HandOn;
use super::import::{Arranged, Import, KeptImport};
use super::outside::ObstructionEffects;
use super::scene::{Selection, first_scene, kept_scene, rule, selection_of};
pub use super::settings::Settings;
use super::shelf::{Addition, Found, Hit, Query, Sets, Shelf};
use super::tour::Tour;
use super::year::Calendar;
use crate::catalogue::{Deleted, Product};
use crate::compute::btdf::Dataset;
use crate::compute::direction::Incident;
use crate::compute::doctor::Diagnosis;
use crate::compute::lid::c_gamma::Peaks;
use crate::compute::sky::{Outside, Sun};
use crate::study::accuracy::Accuracy;
use crate::study::comparison::same_question;
use crate::study::control::year::CONTROLLED;
use crate::study::inputs::inputs_of;
use crate::study::scene_file::{ControlKeys, ControlMode, SceneFile};
use crate::study::sky::SkyKeyError;
use crate::study::year::Annual;
use crate::texts::{Text, catalogue as subscribing, shell};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// A tile of the bench, by what it says of itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Tile {
    /// Its name in files and settings.
    pub title: &'static str,
    /// Its name for people.
    pub name: Text,
    /// One sentence and its source.
    pub help: Text,
}

/// What undo and redo go over.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// Product and state.
    pub selection: Selection,
    /// Place, time, sky, room, sensors.
    pub scene: SceneFile,
    /// Numbers of the additions that are in the catalogue now; see [`State::additions`].
    pub additions: Vec<usize>,
    /// Numbers of the changes to its products that hold now; see [`State::changes`].
    pub changes: Vec<usize>,
    /// Numbers of those changes that no figure hangs on: stars, collections, subscriptions.
    pub marks: Vec<usize>,
    /// Numbers of the imports that are discarded now; see [`State::discarded`].
    pub discarded: Vec<usize>,
    /// Numbers of the arrangements of imports that hold now; see [`State::arranged`].
    pub arranged: Vec<usize>,
}

impl Document {
    /// Does another document ask for the same figures? What is compared does not count.
    pub fn asks_the_same(&self, other: &Self) -> bool {
        (&self.selection, &self.additions, &self.changes) == (&other.selection, &other.additions, &other.changes)
            && same_question(&self.scene, &other.scene)
    }
}

/// An addition of this session: kept so that undo can take it out and redo put it back.
pub struct Added {
    /// What was stored.
    pub addition: Addition,
    /// Under which key; `None` while it is not in the catalogue.
    pub key: Option<String>,
}

/// Where the catalogue stands.
pub enum CatalogueState {
    /// Being opened.
    Opening,
    /// Ready.
    Ready(Arc<dyn Shelf>),
    /// Could not be opened: why.
    Failed(String),
}

/// A result with its age.
pub struct Shown<T> {
    /// The last good one.
    pub value: Option<Arc<T>>,
    /// Something that it depends on has changed since.
    pub stale: bool,
    /// Why there is no newer one.
    pub error: Option<String>,
    /// Another with every value: what is drawn from one is kept as long as this stays.
    pub revision: u64,
}

impl<T> Default for Shown<T> {
    fn default() -> Self {
        Self { value: None, stale: true, error: None, revision: 0 }
    }
}

impl<T> Shown<T> {
    /// Takes a new result; a failure keeps the last good one, marked stale.
    pub fn take(&mut self, result: Result<T, impl std::fmt::Display>) {
        match result {
            Ok(value) => self.put(Arc::new(value)),
            Err(error) => self.error = Some(error.to_string()),
        }
    }

    /// Shows a value; one that is shown already keeps its revision.
    pub fn put(&mut self, value: Arc<T>) {
        // Counted over all of them, so that one that begins anew does not meet a number of its own past. An address would
        // not do: the next value may lie where the last but one lay.
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let same = self.value.as_ref().is_some_and(|shown| Arc::ptr_eq(shown, &value));
        let revision = if same { self.revision } else { COUNT.fetch_add(1, Ordering::Relaxed) + 1 };
        *self = Self { value: Some(value), stale: false, error: None, revision };
    }
}

/// What was computed last.
#[derive(Default)]
pub struct Results {
    /// The first aperture as a luminaire.
    pub lid: Shown<LidFigures>,
    /// The largest intensities of a LID: they take longer than it.
    pub peaks: Option<(Arc<LidFigures>, Peaks)>,
    /// The room.
    pub room: Shown<RoomFigures>,
    /// The room's surfaces; asked for only while they are drawn.
    pub surfaces: Shown<SurfaceFigures>,
    /// What control does over the year.
    pub year: Shown<Year>,
    /// A year of weather in the room, of the scene that it was asked for.
    pub annual: Shown<Annual>,
    /// What is known of the products that are ranked.
    pub rank: Shown<Figures>,
    /// How far a ranking is that is under way.
    pub rank_pace: Option<Pace>,
    /// The weather that hours are picked from.
    pub weather: Shown<Calendar>,
    /// The data of one incidence in another form than as measured.
    pub form: Shown<FormResult>,
    /// How light is interpolated between the directions of the data.
    pub schemes: Shown<SchemesResult>,
    /// Error against run time, of the scene that it was asked for.
    pub accuracy: Shown<Accuracy>,
    /// Effects of obstructions, and of which scene.
    pub obstructions: Shown<ObstructionEffects>,
}

impl Results {
    /// The largest intensities of the LID that is shown; `None` while they are computed.
    pub fn lid_peaks(&self) -> Option<&Peaks> {
        let (of, peaks) = self.peaks.as_ref()?;
        self.lid.value.as_ref().is_some_and(|lid| Arc::ptr_eq(lid, of)).then_some(peaks)
    }
}

/// Sky and sun of the moment.
pub struct Daylight {
    /// Sky, ground, skyline.
    pub outside: Outside,
    /// The same with what stands before them, as the first aperture sees them; `None` where nothing does.
    pub seen: Option<Box<Outside>>,
    /// Beam, if there is any.
    pub sun: Option<Sun>,
}

/// The sheet over the right edge of the bench.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sheet {
    /// Files that were read.
    Import,
    /// What the dataset's checks say.
    Findings,
    /// All keys.
    Keys,
    /// Error against run time.
    Accuracy,
    /// Data computed from a description of geometry and material.
    Goniophotometer,
    /// Name, maker, kind and tags of a product.
    Product,
    /// Products out of sight.
    Deleted,
    /// Collections, and those of the selected product.
    Collections,
    /// Folders of packages that are subscribed to.
    Subscriptions,
    /// What the window said.
    Messages,
    /// Handing on: pictures, reports, luminaires, data.
    HandOn,
    /// A path to open or write.
    Path(PathUse),
}

/// What a typed path is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PathUse {
    /// Open datasets or a scene.
    Open,
    /// Save the scene.
    SaveScene,
    /// Write the LID as a luminaire file.
    ExportLid,
    /// Write a tile as numbers (.csv).
    ExportTile(Tile),
    /// Write what the goniophotometer computed.
    ExportMeasured,
    /// Read a file in place of that of a product's state.
    ReplaceState,
    /// Subscribe to a folder of packages.
    Subscribe,
    /// Write what is handed on.
    HandOn,
}

impl PathUse {
    /// Title of whatever asks for the path.
    pub const fn title(self) -> Text {
        match self {
            Self::Open => shell::OPEN,
            Self::SaveScene => shell::SAVE_THE_SCENE,
            Self::ExportLid => shell::EXPORT_THE_LID,
            Self::ExportTile(_) => shell::EXPORT_A_TILE,
            Self::ExportMeasured => shell::EXPORT_THE_DATA,
            Self::ReplaceState => shell::REPLACE_A_STATE,
            Self::Subscribe => subscribing::SUBSCRIBE_TITLE,
            Self::HandOn => shell::HAND_ON,
        }
    }
}

/// Everything.
pub struct State {
    /// Under undo.
    pub document: Document,
    /// Kept.
    pub settings: Settings,
    /// The catalogue.
    pub catalogue: CatalogueState,
    /// What the search field and chips say.
    pub query: Query,
    /// The list.
    pub found: Arc<Found>,
    /// Why the search failed.
    pub search_error: Option<String>,
    /// The tile that fills the bench.
    pub maximised: Option<Tile>,
    /// The sheet that is open.
    pub sheet: Option<Sheet>,
    /// What a sheet's path field says.
    pub path: String,
    /// The path that was to be written and exists already: to be replaced?
    pub replace: Option<PathBuf>,
    /// The dialog of handing on.
    pub hand_on: HandOn,
    /// Files that were read.
    pub import: Option<Import>,
    /// An import that is on its way: from its files, or into the catalogue.
    pub under_way: Option<KeptImport>,
    /// The import whose products are being stored, in case they cannot be.
    pub storing: Option<Import>,
    /// Imports left for later.
    pub drafts: Vec<KeptImport>,
    /// Imports and drafts that were discarded in this session.
    pub discarded: Vec<KeptImport>,
    /// Steps from one arrangement of an import to another in this session.
    pub arranged: Vec<Arranged>,
    /// The goniophotometer's sheet.
    pub goniophotometer: Bench,
    /// Additions of this session.
    pub additions: Vec<Added>,
    /// Changes of this session to products of the catalogue.
    pub changes: Vec<Change>,
    /// The product whose sheet is open.
    pub editing: Option<Editing>,
    /// Key of a product and of its state that is to get other data.
    pub replacing: Option<(String, String)>,
    /// Products out of sight, as last looked up.
    pub deleted: Vec<Deleted>,
    /// Collections and subscriptions, as last looked up.
    pub sets: Sets,
    /// Name of a new collection, as typed.
    pub collection: String,
    /// Command palette: its words while open.
    pub palette: Option<String>,
    /// The row of the palette that Enter takes.
    pub palette_row: usize,
    /// Products of the catalogue that the palette's words fit.
    pub palette_hits: Vec<Hit>,
    /// The words that they are of.
    pub palette_hits_of: String,
    /// The search field wants the keyboard, until it has it.
    pub focus_search: bool,
    /// The sheet that was opened wants the keyboard for the field to type in, until that has it.
    pub wants_keyboard: bool,
    /// Give the chosen row of the list the keyboard in the next frame.
    pub focus_list: bool,
    /// Choose the first row as soon as the list is that of what was typed.
    pub first_due: bool,
    /// Dataset of the selection.
    pub dataset: Shown<Dataset>,
    /// What the checks say, and about which dataset.
    pub examined: Option<(Arc<Dataset>, Arc<Vec<Diagnosis>>)>,
    /// What is being computed before there is a dataset of the selection, in words for the tiles' heads.
    pub computing: Option<String>,
    /// The selected product: states with their numbers, control curve.
    pub product: Option<Arc<Product>>,
    /// The incidence that the user chose; the sun's while `None` and the sun is before the façade.
    pub incident: Option<Incident>,
    /// How the BTDF tile looks at the data.
    pub data_look: DataLook,
    /// Key of the state that is shown: as set by hand, or as control picked it.
    pub shown_state: String,
    /// Sky and sun.
    pub daylight: Shown<Daylight>,
    /// The scene's key that is wrong.
    pub scene_error: Option<SkyKeyError>,
    /// Where the scene was opened from or saved to; its relative paths start there.
    pub scene_path: Option<PathBuf>,
    /// The aperture whose control is edited on its own; `None`: all follow the scene's.
    pub control_of: Option<usize>,
    /// How the comparison is looked at.
    pub compare: View,
    /// The tour, while it is under way.
    pub tour: Option<Tour>,
    /// The tour is offered: the window was never open before.
    pub tour_offered: bool,
    /// Row that the keyboard is on.
    pub row: usize,
    /// The product that the list was last scrolled to.
    pub scrolled_to: String,
}

impl State {
    /// At the start, before anything was read.
    pub fn new(settings: Settings) -> Self {
        let scene = settings.last_scene.as_deref().and_then(kept_scene);
        let scene = scene.unwrap_or_else(first_scene);
        Self {
            document: Document {
                selection: selection_of(&scene).unwrap_or_default(),
                scene,
                additions: Vec::new(),
                changes: Vec::new(),
                marks: Vec::new(),
                discarded: Vec::new(),
                arranged: Vec::new(),
            },
            settings,
            catalogue: CatalogueState::Opening,
            query: Query::default(),
            found: Arc::default(),
            search_error: None,
            maximised: None,
            sheet: None,
            path: String::new(),
            replace: None,
            hand_on: HandOn::default(),
            import: None,
            under_way: None,
            storing: None,
            drafts: Vec::new(),
            discarded: Vec::new(),
            arranged: Vec::new(),
            goniophotometer: Bench::default(),
            additions: Vec::new(),
            changes: Vec::new(),
            editing: None,
            replacing: None,
            deleted: Vec::new(),
            sets: Sets::default(),
            collection: String::new(),
            palette: None,
            palette_row: 0,
            palette_hits: Vec::new(),
            palette_hits_of: String::new(),
            focus_search: false,
            wants_keyboard: false,
            focus_list: false,
            first_due: false,
            dataset: Shown::default(),
            examined: None,
            computing: None,
            product: None,
            incident: None,
            data_look: DataLook::default(),
            shown_state: String::new(),
            daylight: Shown::default(),
            scene_error: None,
            scene_path: None,
            control_of: None,
            compare: View::default(),
            tour: None,
            tour_offered: false,
            row: 0,
            scrolled_to: String::new(),
        }
    }

    /// The rule that picks the state.
    pub fn control_mode(&self) -> ControlMode {
        self.picking_rule().map_or(ControlMode::Fixed, |control| control.mode)
    }

    /// The same with all its keys; "fixed" at the state that is set by hand.
    pub fn control_keys(&self) -> ControlKeys {
        self.picking_rule().cloned().unwrap_or_else(|| ControlKeys {
            state: Some(self.shown_state.clone()).filter(|key| !key.is_empty()),
            ..ControlKeys::of(ControlMode::Fixed)
        })
    }

    fn picking_rule(&self) -> Option<&ControlKeys> {
        let document = &self.document;
        let controlled = document.selection.state == CONTROLLED;
        rule(&document.scene, self.control_aperture()).filter(|_| controlled)
    }

    /// What the year of a product hangs on; `None` without place and date.
    pub fn year_key(&self, product: &str) -> Option<YearKey> {
        let scene = &self.document.scene;
        YearKey::new(scene, product, self.control_keys(), self.control_aperture(), self.base())
    }

    /// The aperture whose control is shown and edited, from 0: the chosen one, else the first.
    pub fn control_aperture(&self) -> usize {
        self.control_of.filter(|index| *index < self.document.scene.aperture.len()).unwrap_or(0)
    }

    /// What relative paths of the scene start from.
    pub fn base(&self) -> PathBuf {
        self.scene_path.as_deref().and_then(std::path::Path::parent).map(PathBuf::from).unwrap_or_default()
    }

    /// The files that the scene names.
    pub fn files_of_scene(&self) -> Vec<PathBuf> {
        inputs_of(&self.document.scene, &self.base())
    }

    /// What results are made from: the scene and the files that it names.
    pub fn made_from(&self) -> Vec<PathBuf> {
        self.scene_path.iter().cloned().chain(self.files_of_scene()).collect()
    }

    /// The catalogue, once it is ready.
    pub fn shelf(&self) -> Option<Arc<dyn Shelf>> {
        match &self.catalogue {
            CatalogueState::Ready(shelf) => Some(shelf.clone()),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_values_in_turn_have_the_same_revision() {
        let mut shown = Shown::<usize>::default();
        let mut seen = vec![shown.revision];
        for value in 0..100 {
            // The one before it is freed: the next but one may lie in its place.
            shown.take(Ok::<_, String>(value));
            seen.push(shown.revision);
        }
        let same = shown.value.clone().unwrap();
        shown.put(same);
        assert_eq!(seen.last(), Some(&shown.revision), "nothing new");
        shown = Shown::default();
        shown.take(Ok::<_, String>(0));
        seen.push(shown.revision);
        let all = seen.len();
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), all);
    }
}
