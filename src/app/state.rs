//! State of the window: the document, which undo covers; settings, which are stored; results and display states, which
//! are neither.

use super::compare::view::View;
use super::rank::board::{Figures, Pace};
use super::results::data_looks::{DataLook, FormResult, SchemesResult};
use super::scene::{Selection, first_scene, kept_scene, rule, selection_of};
use super::year::input::Calendar;
use crate::app::catalogue::shelf::{Found, Query, Sets, Shelf};
use crate::app::results::engine::{LidFigures, RoomFigures, SurfaceFigures};
use crate::app::scene::control::{Year, YearKey};
use crate::app::scene::outside::ObstructionEffects;
pub use crate::app::shell::settings::Settings;
use crate::catalogue::Product;
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
    /// Key of the tile in files and settings; not translated.
    pub title: &'static str,
    /// Name of the tile in the languages of the window.
    pub name: Text,
    /// Help text of the tile: one sentence on its content and the source of the definitions.
    pub help: Text,
}

/// Part of the window's state that undo and redo cover.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// Selected product and state.
    pub selection: Selection,
    /// Scene: site, date and time, sky, obstructions, room, apertures, sensor points.
    pub scene: SceneFile,
    /// Indices of the additions of this session that are currently in the catalogue.
    pub additions: Vec<usize>,
    /// Indices of the changes of this session to products that are in effect.
    pub changes: Vec<usize>,
    /// Indices of the changes in effect that affect no result: favourites, collections, subscriptions.
    pub marks: Vec<usize>,
    /// Indices of the imports that are currently discarded.
    pub discarded: Vec<usize>,
    /// Indices of the changes of an import's grouping that are in effect.
    pub arranged: Vec<usize>,
}

impl Document {
    /// Whether another document has the same results, i.e. the same selection, products and scene apart from the
    /// comparison.
    pub fn asks_the_same(&self, other: &Self) -> bool {
        (&self.selection, &self.additions, &self.changes) == (&other.selection, &other.additions, &other.changes)
            && same_question(&self.scene, &other.scene)
    }
}

/// Catalogue, or the state of opening it.
pub enum CatalogueState {
    /// Catalogue being opened.
    Opening,
    /// Catalogue ready to use.
    Ready(Arc<dyn Shelf>),
    /// Catalogue that could not be opened, with the reason.
    Failed(String),
}

/// Result of a computation, and whether it is outdated.
pub struct Shown<T> {
    /// Last valid result; `None` before there is one.
    pub value: Option<Arc<T>>,
    /// Whether input of the result has changed since it was computed.
    pub stale: bool,
    /// Reason why there is no newer result.
    pub error: Option<String>,
    /// Revision number, which changes whenever the result does, so that pictures of a result can be cached.
    pub revision: u64,
}

impl<T> Default for Shown<T> {
    fn default() -> Self {
        Self { value: None, stale: true, error: None, revision: 0 }
    }
}

impl<T> Shown<T> {
    /// Takes over a new result, or an error; after an error the last valid result remains.
    pub fn take(&mut self, result: Result<T, impl std::fmt::Display>) {
        match result {
            Ok(value) => self.put(Arc::new(value)),
            Err(error) => self.error = Some(error.to_string()),
        }
    }

    /// Takes over a valid result; the revision number changes unless it is the same result as before.
    pub fn put(&mut self, value: Arc<T>) {
        // Counted over all of them, so that a new one does not repeat a number of its own past. An address would not
        // do: the next value may lie where the last but one lay.
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let same = self.value.as_ref().is_some_and(|shown| Arc::ptr_eq(shown, &value));
        let revision = if same { self.revision } else { COUNT.fetch_add(1, Ordering::Relaxed) + 1 };
        *self = Self { value: Some(value), stale: false, error: None, revision };
    }
}

/// Latest results of the computations of the window.
#[derive(Default)]
pub struct Results {
    /// Luminous intensity distribution (LID) of the first aperture.
    pub lid: Shown<LidFigures>,
    /// Largest intensities of a LID, with this LID; they take longer to compute than the LID.
    pub peaks: Option<(Arc<LidFigures>, Peaks)>,
    /// Illuminances at the sensor points in the room.
    pub room: Shown<RoomFigures>,
    /// Illuminances on the surfaces of the room; computed only while they are drawn.
    pub surfaces: Shown<SurfaceFigures>,
    /// State that the control rule chooses for every step of a year.
    pub year: Shown<Year>,
    /// Annual simulation of the room, with its scene.
    pub annual: Shown<Annual>,
    /// Annual results of the ranked products.
    pub rank: Shown<Figures>,
    /// Progress of a ranking that is being computed; `None` if there is none.
    pub rank_pace: Option<Pace>,
    /// Calendar of the hours of the scene's weather data.
    pub weather: Shown<Calendar>,
    /// Processed scattering data (filtered or compressed) for one incident direction.
    pub form: Shown<FormResult>,
    /// Map of the interpolation scheme that applies at each incident direction between those of the data.
    pub schemes: Shown<SchemesResult>,
    /// Error of the results against computing time, with their scene.
    pub accuracy: Shown<Accuracy>,
    /// Effects of the obstructions on the illuminance of the apertures, with their scene.
    pub obstructions: Shown<ObstructionEffects>,
}

impl Results {
    /// Returns the result of the annual simulation, if it belongs to this scene.
    pub fn year_of(&self, scene: &SceneFile) -> Option<Arc<Annual>> {
        self.annual.value.clone().filter(|annual| annual.is_of(scene))
    }

    /// Returns the largest intensities of the LID shown; `None` while they are being computed.
    pub fn lid_peaks(&self) -> Option<&Peaks> {
        let (of, peaks) = self.peaks.as_ref()?;
        self.lid.value.as_ref().is_some_and(|lid| Arc::ptr_eq(lid, of)).then_some(peaks)
    }
}

/// Sky and sun of the scene at its date and time.
pub struct Daylight {
    /// Luminances of the unobstructed outside: sky, ground, skyline.
    pub outside: Outside,
    /// Luminances of sky, ground, skyline and obstructions as seen from the first aperture; `None` without
    /// obstructions.
    pub seen: Option<Box<Outside>>,
    /// Direct sun; `None` if it does not shine.
    pub sun: Option<Sun>,
}

/// Side panel at the right edge of the tile area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sheet {
    /// Import of files.
    Import,
    /// Findings of the data check.
    Findings,
    /// List of all keyboard shortcuts.
    Keys,
    /// Version of the program, and memory of the stored results.
    About,
    /// Plot of the error of results against computing time.
    Accuracy,
    /// Virtual goniophotometer: scattering data computed from a description of geometry and materials.
    Goniophotometer,
    /// Texts about a product: name, manufacturer, kind and tags.
    Product,
    /// Deleted products.
    Deleted,
    /// Collections of products, and those that contain the selected product.
    Collections,
    /// Subscribed folders of packages.
    Subscriptions,
    /// List of the messages of the window.
    Messages,
    /// Export: pictures, reports, luminaires, data.
    Export,
    /// Field for a path to open or write.
    Path(PathUse),
}

/// Purpose of a path that the user types or chooses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PathUse {
    /// Open datasets or a scene.
    Open,
    /// Save the scene.
    SaveScene,
    /// Write the luminous intensity distribution (LID) as a luminaire file.
    ExportLid,
    /// Write the numbers of a tile as a table (.csv).
    ExportTile(Tile),
    /// Write the states computed by the virtual goniophotometer.
    ExportMeasured,
    /// Read a file that replaces the data of a product's state.
    ReplaceState,
    /// Subscribe to a folder of packages.
    Subscribe,
    /// Write the export of the export panel.
    Export,
}

impl PathUse {
    /// Returns the title of the dialog or side panel that requests the path.
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
    /// Document, the part of the state that undo covers.
    pub document: Document,
    /// Settings that are stored between starts.
    pub settings: Settings,
    /// Catalogue, or the state of opening it.
    pub catalogue: CatalogueState,
    /// Search of the catalogue, set by the search field and the filters.
    pub query: Query,
    /// Products found, shown as a list or gallery.
    pub found: Arc<Found>,
    /// Reason why the last search failed.
    pub search_error: Option<String>,
    /// Tile that fills the tile area; `None` if the tiles are arranged by the layout.
    pub maximised: Option<Tile>,
    /// Side panel that is open.
    pub sheet: Option<Sheet>,
    /// Text of the path field of a side panel.
    pub path: String,
    /// Path of an existing file that is to be written; the user is asked whether to replace it.
    pub replace: Option<PathBuf>,
    /// Text of the command palette while it is open.
    pub palette: Option<String>,
    /// Collections and subscriptions, found by the last look-up.
    pub sets: Sets,
    /// Whether the search field is to get the keyboard focus.
    pub focus_search: bool,
    /// Whether the field of the opened side panel is to get the keyboard focus.
    pub wants_keyboard: bool,
    /// Whether the selected entry of the catalogue is to get the keyboard focus in the next frame.
    pub focus_list: bool,
    /// Dataset of the selected product and state.
    pub dataset: Shown<Dataset>,
    /// Findings of the data check, with the dataset that was checked.
    pub examined: Option<(Arc<Dataset>, Arc<Vec<Diagnosis>>)>,
    /// Text for the heads of tiles on the computation that the selected dataset requires first; `None` without one.
    pub computing: Option<String>,
    /// Information about the selected product: states with their figures, control curve.
    pub product: Option<Arc<Product>>,
    /// Incident direction that the user chose for the BTDF tile; `None`: the direction of the sun, if it is in front of
    /// the façade.
    pub incident: Option<Incident>,
    /// Choice of the data that the BTDF tile shows.
    pub data_look: DataLook,
    /// Key of the state shown, which was set by hand or chosen by the control rule.
    pub shown_state: String,
    /// Sky and sun of the scene at its date and time.
    pub daylight: Shown<Daylight>,
    /// Error of a key of the scene; `None` if there is none.
    pub scene_error: Option<SkyKeyError>,
    /// Path from which the scene was opened or to which it was saved; relative paths in the scene start from its
    /// folder.
    pub scene_path: Option<PathBuf>,
    /// Index of the aperture whose separate control rule is edited; `None`: that of the scene.
    pub control_of: Option<usize>,
    /// Display settings of the comparison.
    pub compare: View,
    /// Index of the row of the catalogue that the keyboard has reached.
    pub row: usize,
    /// Key of the product to which the list was last scrolled.
    pub scrolled_to: String,
}

impl State {
    /// Creates the state of a new window, before anything has been read.
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
            palette: None,
            sets: Sets::default(),
            focus_search: false,
            wants_keyboard: false,
            focus_list: false,
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
            row: 0,
            scrolled_to: String::new(),
        }
    }

    /// Returns the mode of the control rule that chooses the state; `Fixed` if the state is set by hand.
    pub fn control_mode(&self) -> ControlMode {
        self.picking_rule().map_or(ControlMode::Fixed, |control| control.mode)
    }

    /// Returns the control rule that chooses the state; if the state is set by hand, a rule that is fixed at the state
    /// shown.
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

    /// Returns the key of all input of a product's control over a year; `None` if the scene has no site or date.
    pub fn year_key(&self, product: &str) -> Option<YearKey> {
        let scene = &self.document.scene;
        YearKey::new(scene, product, self.control_keys(), self.control_aperture(), self.base())
    }

    /// Returns the index of the aperture whose control is shown and edited: the chosen one, else the first.
    pub fn control_aperture(&self) -> usize {
        self.control_of.filter(|index| *index < self.document.scene.aperture.len()).unwrap_or(0)
    }

    /// Returns the folder from which relative paths in the scene start; empty for the working folder.
    pub fn base(&self) -> PathBuf {
        self.scene_path.as_deref().and_then(std::path::Path::parent).map(PathBuf::from).unwrap_or_default()
    }

    /// Returns the paths of all files that the scene names.
    pub fn files_of_scene(&self) -> Vec<PathBuf> {
        inputs_of(&self.document.scene, &self.base())
    }

    /// Returns the paths of all input files of the results: the scene file and the files that it names.
    pub fn made_from(&self) -> Vec<PathBuf> {
        self.scene_path.iter().cloned().chain(self.files_of_scene()).collect()
    }

    /// Returns the catalogue; `None` until it is ready.
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
