//! What the window knows: the document that undo goes over, settings that are kept, and what is only shown.

use super::control::{Year, YearKey};
use super::engine::{LidFigures, RoomFigures};
use super::facing::surface_of;
use super::goniophotometer::Bench;
use super::scene::{Selection, first_scene, kept_scene, rule, selection_of};
use super::shelf::{Addition, Found, Query, Shelf};
use super::theme::ThemeChoice;
use crate::catalogue::{Product, Provenance};
use crate::compute::btdf::Dataset;
use crate::compute::direction::Incident;
use crate::compute::doctor::{Diagnosis, Repair};
use crate::compute::sky::{Outside, Sun};
use crate::study::accuracy::Accuracy;
use crate::study::control::year::CONTROLLED;
use crate::study::scene_file::{ControlKeys, ControlMode, SceneFile};
use crate::study::sky::SkyKeyError;
use std::path::PathBuf;
use std::sync::Arc;

/// A tile of the bench, by what it says of itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Tile {
    /// Title, and its name elsewhere.
    pub title: &'static str,
    /// One sentence and its source.
    pub help: &'static str,
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
}

/// An addition of this session: kept so that undo can take it out and redo put it back.
pub struct Added {
    /// What was stored.
    pub addition: Addition,
    /// Under which key; `None` while it is not in the catalogue.
    pub key: Option<String>,
}

/// Kept from one start to the next.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Light, dark or as the desktop.
    pub theme: ThemeChoice,
    /// Catalogue panel open?
    pub catalogue_open: bool,
    /// Scene panel open?
    pub scene_open: bool,
    /// The scene as it was left, in TOML.
    pub last_scene: Option<String>,
}

impl Default for Settings {
    fn default() -> Self {
        Self { theme: ThemeChoice::System, catalogue_open: true, scene_open: true, last_scene: None }
    }
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
}

impl<T> Default for Shown<T> {
    fn default() -> Self {
        Self { value: None, stale: true, error: None }
    }
}

impl<T> Shown<T> {
    /// Takes a new result; a failure keeps the last good one, marked stale.
    pub fn take(&mut self, result: Result<T, impl std::fmt::Display>) {
        match result {
            Ok(value) => *self = Self { value: Some(Arc::new(value)), stale: false, error: None },
            Err(error) => self.error = Some(error.to_string()),
        }
    }
}

/// What was computed last.
#[derive(Default)]
pub struct Results {
    /// The first aperture as a luminaire.
    pub lid: Shown<LidFigures>,
    /// The room.
    pub room: Shown<RoomFigures>,
    /// What control does over the year.
    pub year: Shown<Year>,
    /// Error against run time, of the scene that it was asked for.
    pub accuracy: Shown<Accuracy>,
    /// Counts the ladders that came in.
    pub accuracy_revision: u64,
}

/// Sky and sun of the moment.
pub struct Daylight {
    /// Sky, ground, skyline.
    pub outside: Outside,
    /// Beam, if there is any.
    pub sun: Option<Sun>,
}

/// Which files were read and are not stored yet.
#[derive(Debug, Clone, Default)]
pub struct Import {
    /// File names.
    pub files: Vec<String>,
    /// What was recognised, one a state, with the repairs made.
    pub datasets: Vec<Arc<Dataset>>,
    /// The same as the files hold it.
    pub originals: Vec<Arc<Dataset>>,
    /// What the data doctor says about each.
    pub diagnoses: Vec<Vec<Diagnosis>>,
    /// Repairs made, in order; recorded when the product is stored.
    pub repairs: Vec<Repair>,
    /// Files that could not be read: file, place, what, what would be right.
    pub failures: Vec<String>,
    /// Fields for the user to fill in.
    pub name: String,
    /// Maker.
    pub manufacturer: String,
    /// Kind of system.
    pub kind: String,
    /// Words to find it by, separated by commas.
    pub tags: String,
    /// Where the data come from, as the files tell.
    pub provenance: Provenance,
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
    /// Write a tile as numbers (.csv) or as a picture (.png).
    ExportTile(Tile),
    /// Write what the goniophotometer computed.
    ExportMeasured,
}

impl PathUse {
    /// Title of whatever asks for the path.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Open => "Open",
            Self::SaveScene => "Save the scene",
            Self::ExportLid => "Export the LID",
            Self::ExportTile(_) => "Export a tile",
            Self::ExportMeasured => "Export the computed data",
        }
    }

    /// A name to start from.
    pub fn file_name(self) -> String {
        match self {
            Self::Open | Self::SaveScene => "scene.toml".to_owned(),
            Self::ExportLid => "window.ldt".to_owned(),
            Self::ExportTile(tile) => format!("{}.csv", tile.title.to_lowercase()),
            Self::ExportMeasured => "system.cfsp".to_owned(),
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
    /// Files that were read.
    pub import: Option<Import>,
    /// The goniophotometer's sheet.
    pub goniophotometer: Bench,
    /// Additions of this session.
    pub additions: Vec<Added>,
    /// Command palette: its words while open.
    pub palette: Option<String>,
    /// Focus the search field in the next frame.
    pub focus_search: bool,
    /// Dataset of the selection.
    pub dataset: Shown<Dataset>,
    /// The selected product: states with their numbers, control curve.
    pub product: Option<Arc<Product>>,
    /// The incidence that the user chose; the sun's while `None` and the sun is before the façade.
    pub incident: Option<Incident>,
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
            document: Document { selection: selection_of(&scene).unwrap_or_default(), scene, additions: Vec::new() },
            settings,
            catalogue: CatalogueState::Opening,
            query: Query::default(),
            found: Arc::default(),
            search_error: None,
            maximised: None,
            sheet: None,
            path: String::new(),
            import: None,
            goniophotometer: Bench::default(),
            additions: Vec::new(),
            palette: None,
            focus_search: false,
            dataset: Shown::default(),
            product: None,
            incident: None,
            shown_state: String::new(),
            daylight: Shown::default(),
            scene_error: None,
            scene_path: None,
            control_of: None,
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
        let surface = surface_of(scene, self.control_aperture());
        YearKey::new(scene, product, self.control_keys(), surface, self.base())
    }

    /// The aperture whose control is shown and edited, from 0: the chosen one, else the first.
    pub fn control_aperture(&self) -> usize {
        self.control_of.filter(|index| *index < self.document.scene.aperture.len()).unwrap_or(0)
    }

    /// What relative paths of the scene start from.
    pub fn base(&self) -> PathBuf {
        self.scene_path.as_deref().and_then(std::path::Path::parent).map(PathBuf::from).unwrap_or_default()
    }

    /// The catalogue, once it is ready.
    pub fn shelf(&self) -> Option<Arc<dyn Shelf>> {
        match &self.catalogue {
            CatalogueState::Ready(shelf) => Some(shelf.clone()),
            _ => None,
        }
    }
}
