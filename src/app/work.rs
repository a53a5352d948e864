//! What runs in jobs, and what jobs bring back.

use super::changes::{Change, Looked, Reread};
use super::compare::Part;
use super::control::Year;
use super::data_looks::{FormResult, SchemesResult};
use super::disk::write_whole;
use super::engine::{Engine, LidFigures, RoomFigures, SurfaceFigures};
use super::error::AppError;
use super::gallery::Made;
use super::goniophotometer::Finished;
use super::hand_on::Preview;
use super::import::{Import, Proposed};
use super::jobs::JobState;
use super::outside::ObstructionEffects;
use super::scene::{Selection, rule};
use super::shelf::{Found, Sets, Shelf};
use super::state::{Daylight, PathUse, Tile};
use super::year::Calendar;
use crate::catalogue::{Deleted, Product};
use crate::compute::angle::Bearing;
use crate::compute::btdf::Dataset;
use crate::compute::direction::Orientation;
use crate::compute::doctor::Diagnosis;
use crate::compute::estimate::Progress;
use crate::compute::lid::Facing;
use crate::compute::lid::c_gamma::Peaks;
use crate::study::StudyError;
use crate::study::accuracy::Accuracy;
use crate::study::comparison::DataFacts;
use crate::study::control::ControlQuestion;
use crate::study::control::table::of_scene;
use crate::study::control::year::CONTROLLED;
use crate::study::facade::obstruction_effects;
use crate::study::scene::seen_by_first_aperture;
use crate::study::scene_file::{ControlKeys, ControlMode, SceneFile};
use crate::study::scene_places::opening;
use crate::study::sky::{SkyKeyError, outside_from_keys};
use crate::study::subscriptions::Report;
use crate::study::year::Annual;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

pub use crate::study::intake::ReadDataset;

/// How long data of built-in products are computed before it is asked anew which come first.
const FILLING: Duration = Duration::from_millis(500);

/// A picture on its way into the clipboard: width, height, and red, green and blue of its pixels row by row.
pub type Pixels = (usize, usize, Vec<u8>);

/// What jobs bring back.
#[expect(clippy::large_enum_variant, reason = "a few a second, each moved once")]
pub enum Outcome {
    /// The catalogue is open.
    Opened(Result<Arc<dyn Shelf>, AppError>),
    /// A list.
    Found(Result<Found, AppError>),
    /// What the palette's words fit in the catalogue.
    Hits(Result<Found, AppError>),
    /// Product, state and dataset of the selection, and sky and sun.
    Scene(Result<Shelved, AppError>, Result<Daylight, SkyKeyError>),
    /// What control does over the year.
    Year(Result<Year, StudyError>),
    /// A year of weather in the room.
    Annual(Result<Box<Annual>, AppError>),
    /// A ranking has come to its end; what it found was shown as it came.
    Ranked(Result<(), AppError>),
    /// The weather that hours are picked from.
    Weather(Result<Box<Calendar>, StudyError>),
    /// A weather file was opened.
    OpenedWeather(PathBuf),
    /// The LID.
    Lid(Result<LidFigures, AppError>),
    /// The largest intensities of a LID.
    Peaks(Arc<LidFigures>, Peaks),
    /// The room.
    Room(Result<RoomFigures, AppError>),
    /// A part of what is known of a candidate, by its number.
    Compared(u64, Box<Compared>),
    /// The room's surfaces.
    Surfaces(Result<SurfaceFigures, AppError>),
    /// The data of one incidence in another form.
    DataForm(FormResult),
    /// How light is interpolated between the directions of the data.
    Schemes(SchemesResult),
    /// Error against run time.
    Accuracy(Result<Accuracy, AppError>),
    /// Effects of obstructions.
    Obstructions(ObstructionEffects),
    /// Files that the user chose.
    Chosen(Result<Vec<PathBuf>, AppError>),
    /// Where to write.
    Target(PathUse, Result<Option<PathBuf>, AppError>),
    /// Files were read.
    Read(Box<Import>),
    /// The files of an import were arranged otherwise; names of the products before, by their files.
    Rearranged(Box<Import>, Vec<(Vec<String>, String)>),
    /// What the checks say about a dataset.
    Examined(Arc<Dataset>, Arc<Vec<Diagnosis>>),
    /// Several at once, in order.
    Several(Vec<Outcome>),
    /// A product that was read, known by its files, with the repairs that were wished: its datasets, what is said about
    /// them, and the repairs; or why not.
    Mended(Vec<String>, Result<Box<Proposed>, AppError>),
    /// A system file was read: its text and folder.
    ReadSystem(Result<(String, PathBuf), AppError>),
    /// A state of a system was measured; the keys of all.
    Measured(Result<Box<(Vec<String>, Finished)>, AppError>),
    /// A scene was read.
    ReadScene(PathBuf, Result<Box<SceneFile>, AppError>),
    /// A control curve was read.
    ReadCurve(Result<Vec<[f64; 2]>, AppError>),
    /// Additions of these numbers are in the catalogue, each with whether it is new there; or why none is.
    Added(Vec<usize>, Result<Vec<(bool, Arc<Product>)>, AppError>),
    /// A product to be chosen was looked up.
    Choice(Result<Arc<Product>, AppError>),
    /// A change of this session was made in the catalogue, or taken back.
    Changed(usize, bool, Result<(), AppError>),
    /// A product whose sheet is to be opened.
    Editing(Result<Looked, AppError>),
    /// A file was read that takes the place of a state's.
    ToReplace(Result<Change, AppError>),
    /// The files of a product were read again.
    Reread(Result<Reread, AppError>),
    /// The folders of packages that are subscribed to were read.
    Synced(Result<Report, AppError>),
    /// Whether what was chosen is a folder of packages to subscribe to: its path, or why not.
    Folder(Result<String, String>),
    /// Collections and subscriptions.
    Sets(Result<Sets, AppError>),
    /// Pictures of products.
    Pictures(Vec<Made>),
    /// Products out of sight.
    Deleted(Result<Vec<Deleted>, AppError>),
    /// Something else in the catalogue was changed.
    Stored(Result<(), AppError>),
    /// The data of the chosen state are in the catalogue.
    Provided(Result<(), AppError>),
    /// Some more data of built-in products are in the catalogue; how many states are left.
    Builtin(Result<usize, AppError>),
    /// A path that is to be written to: is a file there already?
    There(PathUse, PathBuf, bool),
    /// What would be handed on.
    Preview(Result<Preview, AppError>),
    /// A tile was drawn for the clipboard.
    Copied(Tile, Result<Pixels, AppError>),
    /// A file was written.
    Written(PathUse, Result<PathBuf, AppError>),
    /// A message about what was made.
    Warning(String),
    /// Fonts of the system by name, and characters that none of them has.
    Fonts(Vec<(String, egui::FontData)>, Vec<char>),
}

impl Outcome {
    /// Adds a warning, if there is one.
    pub fn with_warning(self, warning: Option<String>) -> Self {
        match warning {
            Some(warning) => Self::Several(vec![self, Self::Warning(warning)]),
            None => self,
        }
    }
}

/// A part of what is known of a candidate.
#[expect(clippy::large_enum_variant, reason = "one at a time, boxed on its way")]
pub enum Compared {
    /// Product, state and dataset, and sky and sun.
    Shelf(Result<Shelved, AppError>, Result<Daylight, SkyKeyError>),
    /// State and dataset of a system that is no product of the catalogue, and sky and sun.
    Own(Result<(String, Arc<Dataset>), AppError>, Result<Daylight, SkyKeyError>),
    /// The LID.
    Lid(Result<LidFigures, AppError>),
    /// Its largest intensities.
    Peaks(Arc<LidFigures>, Peaks),
    /// The room.
    Room(Result<RoomFigures, AppError>),
    /// The room's surfaces.
    Surfaces(Result<SurfaceFigures, AppError>),
    /// What control does over the year.
    Year(Result<Year, StudyError>),
    /// Figures of the dataset; `None` without a transmission.
    Data(Option<DataFacts>),
    /// A fault of the program.
    Failed(Part, String),
}

/// What the catalogue holds of the selection.
pub struct Shelved {
    /// Product.
    pub product: Arc<Product>,
    /// Key of the state, picked by the scene's control where it is left to it.
    pub state: String,
    /// Its dataset; `None` while it is still to be computed.
    pub dataset: Option<Arc<Dataset>>,
}

/// Computes data that nobody has asked for yet, those of the first of these products first, until it is time to ask anew
/// which come first; how many states are left.
pub(super) fn fill_some(shelf: &dyn Shelf, order: &[String], progress: &JobState) -> Result<usize, AppError> {
    // Threads of its own, so that what is in sight never waits behind this; one core stays free for the window.
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads((cores - 1).max(1)).build()?;
    let start = Instant::now();
    loop {
        let [left, all] = pool.install(|| shelf.fill_one(order, progress))?;
        progress.advance("computing", all.saturating_sub(left), all);
        if left == 0 || start.elapsed() > FILLING {
            return Ok(left);
        }
    }
}

/// Sky and sun of a scene, as they are and as its first aperture sees them.
pub(super) fn daylight(scene: &SceneFile, base: &Path, progress: &dyn Progress) -> Result<Daylight, SkyKeyError> {
    let (outside, sun) = outside_from_keys(&scene.sky, &scene.site, base)?;
    // What is wrong with boxes the room's tile says; what was withdrawn nobody looks at.
    let seen = seen_by_first_aperture(scene, &outside, sun.as_ref(), progress).ok().flatten().map(Box::new);
    Ok(Daylight { outside, seen, sun })
}

/// Effects of a scene's obstructions.
pub(super) fn obstructions(scene: SceneFile, base: &Path, progress: &dyn Progress) -> ObstructionEffects {
    let effects = obstruction_effects(&scene, base, progress).map_err(|error| error.to_string());
    (scene, effects)
}

/// The selection's product, state and dataset.
pub(super) fn take_from_shelf(
    shelf: &dyn Shelf,
    selection: &Selection,
    scene: &SceneFile,
    daylight: Option<&Daylight>,
    (aperture, base): (usize, &Path),
) -> Result<Shelved, AppError> {
    let product = shelf.product(&selection.product)?;
    let state = if selection.state == CONTROLLED {
        let fixed = ControlKeys::of(ControlMode::Fixed);
        let keys = rule(scene, aperture).unwrap_or(&fixed);
        let daylight = daylight.ok_or(AppError::NoDaylight)?;
        let opening = opening(scene, aperture)?.ok_or(AppError::NoDaylight)?;
        let facing = Facing {
            outside: daylight.seen.as_deref().unwrap_or(&daylight.outside),
            sun: daylight.sun.as_ref(),
            orientation: Orientation::new(Bearing::from_degrees(scene.site.azimuth)),
            surface: opening.surface,
        };
        let hour = super::moment::of(scene).map(|time| f64::from(time.hour()) + f64::from(time.minute()) / 60.0);
        let asked = ControlQuestion { keys, base, hour, of_year: of_scene(scene), facing, aperture: opening };
        shelf.controlled_state(&selection.product, &asked)?
    } else if selection.state.is_empty() {
        product.states.get(product.representative().1).map(|state| state.key.clone()).unwrap_or_default()
    } else {
        selection.state.clone()
    };
    // What has to be computed is not waited for: sky, names and states are shown at once.
    let ready = shelf.is_ready(&selection.product, Some(&state))?;
    let dataset = if ready { Some(shelf.load(&selection.product, Some(&state))?) } else { None };
    Ok(Shelved { product, state, dataset })
}

/// Saves the scene.
pub fn save_scene(path: &Path, text: Result<String, toml::ser::Error>, made_from: &[PathBuf]) -> Outcome {
    let written = text.map_err(AppError::from).and_then(|text| write_whole(path, text.as_bytes(), made_from));
    Outcome::Written(PathUse::SaveScene, written)
}

/// Writes the LID as a luminaire file.
pub fn export_lid(path: &Path, lid: Option<&LidFigures>, engine: &dyn Engine, made_from: &[PathBuf]) -> Outcome {
    let written = lid
        .ok_or(AppError::NoLid)
        .and_then(|lid| engine.luminaire(lid, path))
        .and_then(|bytes| write_whole(path, &bytes, made_from));
    Outcome::Written(PathUse::ExportLid, written)
}
