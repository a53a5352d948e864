//! State of the window: the document that undo covers, settings that are kept, and what is only shown.

use super::changes::{Change, Editing};
use super::choose::{Figures, Pace};
use super::compare::View;
use super::control::{Year, YearKey};
use super::data_looks::{DataLook, FormResult, SchemesResult};
use super::engine::{LidFigures, RoomFigures, SurfaceFigures};
use super::export_choices::ExportState;
use super::goniophotometer::Bench;
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

/// Tile of the tile area.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Tile {
    /// Key of the tile in files and settings.
    pub title: &'static str,
    /// Name of the tile, translated.
    pub name: Text,
    /// Help text: one sentence and its source.
    pub help: Text,
}

/// Part of the state that undo and redo cover.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// Selected product and state.
    pub selection: Selection,
    /// Scene: place, time, sky, room, sensor points.
    pub scene: SceneFile,
    /// Numbers of the additions that are in the catalogue now; see [`State::additions`].
    pub additions: Vec<usize>,
    /// Numbers of the changes to its products that are in effect; see [`State::changes`].
    pub changes: Vec<usize>,
    /// Numbers of those changes that affect no figure: stars, collections, subscriptions.
    pub marks: Vec<usize>,
    /// Numbers of the imports that are discarded now; see [`State::discarded`].
    pub discarded: Vec<usize>,
    /// Numbers of the arrangements of imports that are in effect; see [`State::arranged`].
    pub arranged: Vec<usize>,
}

impl Document {
    /// Whether another document requests the same figures. The comparison does not count.
    pub fn asks_the_same(&self, other: &Self) -> bool {
        (&self.selection, &self.additions, &self.changes) == (&other.selection, &other.additions, &other.changes)
            && same_question(&self.scene, &other.scene)
    }
}

/// Addition of this session, kept so that undo can remove it and redo restore it.
pub struct Added {
    /// Product that was stored.
    pub addition: Addition,
    /// Key in the catalogue; `None` while it is not there.
    pub key: Option<String>,
}

/// State of opening the catalogue.
pub enum CatalogueState {
    /// Catalogue being opened.
    Opening,
    /// Catalogue ready to use.
    Ready(Arc<dyn Shelf>),
    /// Catalogue that could not be opened, with the reason.
    Failed(String),
}

/// Result, and whether it is outdated.
pub struct Shown<T> {
    /// Last valid result.
    pub value: Option<Arc<T>>,
    /// Whether something that the result depends on has changed since.
    pub stale: bool,
    /// Reason why there is no newer result.
    pub error: Option<String>,
    /// Number that changes with every value: what is drawn from a value can be kept while it stays.
    pub revision: u64,
}

impl<T> Default for Shown<T> {
    fn default() -> Self {
        Self { value: None, stale: true, error: None, revision: 0 }
    }
}

impl<T> Shown<T> {
    /// Stores a new result; after a failure the last valid one stays, marked as outdated.
    pub fn take(&mut self, result: Result<T, impl std::fmt::Display>) {
        match result {
            Ok(value) => self.put(Arc::new(value)),
            Err(error) => self.error = Some(error.to_string()),
        }
    }

    /// Shows a value; one that is shown already keeps its revision.
    pub fn put(&mut self, value: Arc<T>) {
        // Counted over all of them, so that a new one does not repeat a number of its own past. An address would not
        // do: the next value may lie where the last but one lay.
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let same = self.value.as_ref().is_some_and(|shown| Arc::ptr_eq(shown, &value));
        let revision = if same { self.revision } else { COUNT.fetch_add(1, Ordering::Relaxed) + 1 };
        *self = Self { value: Some(value), stale: false, error: None, revision };
    }
}

/// Latest results.
#[derive(Default)]
pub struct Results {
    /// LID of the first aperture.
    pub lid: Shown<LidFigures>,
    /// Largest intensities of a LID, which take longer than the LID itself.
    pub peaks: Option<(Arc<LidFigures>, Peaks)>,
    /// Illuminances in the room.
    pub room: Shown<RoomFigures>,
    /// Illuminances of the room's surfaces; computed only while they are drawn.
    pub surfaces: Shown<SurfaceFigures>,
    /// Year of shading control.
    pub year: Shown<Year>,
    /// Annual simulation, with the scene that it was computed for.
    pub annual: Shown<Annual>,
    /// Results of the ranked products.
    pub rank: Shown<Figures>,
    /// Progress of a running ranking.
    pub rank_pace: Option<Pace>,
    /// Weather file that hours are picked from.
    pub weather: Shown<Calendar>,
    /// Data of one incident direction in another form than the original.
    pub form: Shown<FormResult>,
    /// Map of interpolation schemes between the directions of the data.
    pub schemes: Shown<SchemesResult>,
    /// Error against run time, with the scene that it was computed for.
    pub accuracy: Shown<Accuracy>,
    /// Effects of obstructions, with their scene.
    pub obstructions: Shown<ObstructionEffects>,
}

impl Results {
    /// Returns the largest intensities of the LID that is shown; `None` while they are being computed.
    pub fn lid_peaks(&self) -> Option<&Peaks> {
        let (of, peaks) = self.peaks.as_ref()?;
        self.lid.value.as_ref().is_some_and(|lid| Arc::ptr_eq(lid, of)).then_some(peaks)
    }
}

/// Sky and sun of the scene's moment.
pub struct Daylight {
    /// Sky, ground, skyline.
    pub outside: Outside,
    /// Sky, ground and skyline with the obstructions, as seen from the first aperture; `None` without obstructions.
    pub seen: Option<Box<Outside>>,
    /// Direct sun, if there is any.
    pub sun: Option<Sun>,
}

/// Sheet over the right edge of the tile area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sheet {
    /// Import of files.
    Import,
    /// Findings of the data check.
    Findings,
    /// List of all shortcuts.
    Keys,
    /// Error against run time.
    Accuracy,
    /// Data computed from a description of geometry and material.
    Goniophotometer,
    /// Name, maker, kind and tags of a product.
    Product,
    /// Deleted products.
    Deleted,
    /// Collections, and those of the selected product.
    Collections,
    /// Folders of packages that are subscribed to.
    Subscriptions,
    /// Messages of the window.
    Messages,
    /// Export: pictures, reports, luminaires, data.
    Export,
    /// Path to open or write.
    Path(PathUse),
}

/// Purpose of a typed path.
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
    /// Write the computed states of the goniophotometer.
    ExportMeasured,
    /// Read a file that replaces the data of a product's state.
    ReplaceState,
    /// Subscribe to a folder of packages.
    Subscribe,
    /// Write an export.
    Export,
}

impl PathUse {
    /// Returns the title of the dialog or sheet that asks for the path.
    pub const fn title(self) -> Text {
        match self {
            Self::Open => shell::OPEN,
            Self::SaveScene => shell::SAVE_THE_SCENE,
            Self::ExportLid => shell::EXPORT_THE_LID,
            Self::ExportTile(_) => shell::EXPORT_A_TILE,
            Self::ExportMeasured => shell::EXPORT_THE_DATA,
            Self::ReplaceState => shell::REPLACE_A_STATE,
            Self::Subscribe => subscribing::SUBSCRIBE_TITLE,
            Self::Export => shell::EXPORT_SHEET,
        }
    }
}

/// State of the window.
pub struct State {
    /// Document that undo covers.
    pub document: Document,
    /// Settings that are kept.
    pub settings: Settings,
    /// Catalogue, or the state of opening it.
    pub catalogue: CatalogueState,
    /// Search as set by the search field and the chips.
    pub query: Query,
    /// Product list.
    pub found: Arc<Found>,
    /// Reason why the search failed.
    pub search_error: Option<String>,
    /// Tile that fills the tile area.
    pub maximised: Option<Tile>,
    /// Sheet that is open.
    pub sheet: Option<Sheet>,
    /// Text of a sheet's path field.
    pub path: String,
    /// Path that was to be written but exists; the user is asked whether to replace it.
    pub replace: Option<PathBuf>,
    /// Export dialog.
    pub export: ExportState,
    /// Import that is open.
    pub import: Option<Import>,
    /// Import in progress: being read from its files, or written to the catalogue.
    pub under_way: Option<KeptImport>,
    /// Import whose products are being stored, kept in case they cannot be.
    pub storing: Option<Import>,
    /// Drafts of imports.
    pub drafts: Vec<KeptImport>,
    /// Imports and drafts that were discarded in this session.
    pub discarded: Vec<KeptImport>,
    /// Steps from one arrangement of an import to another in this session.
    pub arranged: Vec<Arranged>,
    /// State of the goniophotometer's sheet.
    pub goniophotometer: Bench,
    /// Additions of this session.
    pub additions: Vec<Added>,
    /// Changes of this session to products of the catalogue.
    pub changes: Vec<Change>,
    /// Sheet of the product that is being edited.
    pub editing: Option<Editing>,
    /// Keys of a product and of its state whose data are to be replaced.
    pub replacing: Option<(String, String)>,
    /// Deleted products, as last looked up.
    pub deleted: Vec<Deleted>,
    /// Collections and subscriptions, as last looked up.
    pub sets: Sets,
    /// Name of a new collection, as typed.
    pub collection: String,
    /// Text of the command palette while it is open.
    pub palette: Option<String>,
    /// Row of the palette that Enter activates.
    pub palette_row: usize,
    /// Products of the catalogue that match the palette's text.
    pub palette_hits: Vec<Hit>,
    /// Text that `palette_hits` belongs to.
    pub palette_hits_of: String,
    /// Whether the search field is to get the keyboard.
    pub focus_search: bool,
    /// Whether the field of the opened sheet is to get the keyboard.
    pub wants_keyboard: bool,
    /// Whether the selected row of the list gets the keyboard in the next frame.
    pub focus_list: bool,
    /// Whether the first row is selected as soon as the list is that of the typed search.
    pub first_due: bool,
    /// Dataset of the selection.
    pub dataset: Shown<Dataset>,
    /// Findings of the data check, with their dataset.
    pub examined: Option<(Arc<Dataset>, Arc<Vec<Diagnosis>>)>,
    /// Computation that the dataset of the selection waits for, as text for the tiles' heads.
    pub computing: Option<String>,
    /// Selected product: states with their figures, control curve.
    pub product: Option<Arc<Product>>,
    /// Incident direction that the user chose; while `None`, the sun's if it is in front of the façade.
    pub incident: Option<Incident>,
    /// View of the BTDF tile on the data.
    pub data_look: DataLook,
    /// Key of the state that is shown: set by hand, or picked by control.
    pub shown_state: String,
    /// Sky and sun of the scene.
    pub daylight: Shown<Daylight>,
    /// Key of the scene that is wrong.
    pub scene_error: Option<SkyKeyError>,
    /// Path that the scene was opened from or saved to; its relative paths start there.
    pub scene_path: Option<PathBuf>,
    /// Aperture whose control is edited on its own; `None`: the control of the scene.
    pub control_of: Option<usize>,
    /// Display settings of the comparison.
    pub compare: View,
    /// Tour, while it is under way.
    pub tour: Option<Tour>,
    /// Whether the tour is offered, because the window was never open before.
    pub tour_offered: bool,
    /// Row of the list that the keyboard is on.
    pub row: usize,
    /// Key of the product that the list was last scrolled to.
    pub scrolled_to: String,
}

impl State {
    /// Creates the state at the start, before anything was read.
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
            export: ExportState::default(),
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

    /// Returns the mode of the control rule that picks the state.
    pub fn control_mode(&self) -> ControlMode {
        self.picking_rule().map_or(ControlMode::Fixed, |control| control.mode)
    }

    /// Returns the control rule with all its keys; a fixed one at the shown state if the state is set by hand.
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

    /// Returns the key that the control year of a product depends on; `None` without place and date.
    pub fn year_key(&self, product: &str) -> Option<YearKey> {
        let scene = &self.document.scene;
        YearKey::new(scene, product, self.control_keys(), self.control_aperture(), self.base())
    }

    /// Returns the aperture whose control is shown and edited, from 0: the chosen one, else the first.
    pub fn control_aperture(&self) -> usize {
        self.control_of.filter(|index| *index < self.document.scene.aperture.len()).unwrap_or(0)
    }

    /// Returns the folder that relative paths of the scene start from.
    pub fn base(&self) -> PathBuf {
        self.scene_path.as_deref().and_then(std::path::Path::parent).map(PathBuf::from).unwrap_or_default()
    }

    /// Returns the files that the scene names.
    pub fn files_of_scene(&self) -> Vec<PathBuf> {
        inputs_of(&self.document.scene, &self.base())
    }

    /// Returns the files that results are made from: the scene and the files that it names.
    pub fn made_from(&self) -> Vec<PathBuf> {
        self.scene_path.iter().cloned().chain(self.files_of_scene()).collect()
    }

    /// Returns the catalogue, once it is ready.
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
