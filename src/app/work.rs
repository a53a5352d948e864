//! Work that runs in jobs, and the results of jobs.

use super::changes::{Change, Looked, Reread};
use super::compare::Part;
use super::control::Year;
use super::data_looks::{FormResult, SchemesResult};
use super::disk::write_whole;
use super::engine::{Engine, LidFigures, RoomFigures, SurfaceFigures};
use super::error::AppError;
use super::export_choices::Preview;
use super::gallery::Made;
use super::goniophotometer::Finished;
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

/// Time for which data of built-in products are computed before their order is determined again.
const FILLING: Duration = Duration::from_millis(500);

/// Picture for the clipboard: width, height, and red, green and blue of its pixels row by row.
pub type Pixels = (usize, usize, Vec<u8>);

/// Result of a job.
#[expect(clippy::large_enum_variant, reason = "a few a second, each moved once")]
pub enum Outcome {
    /// Catalogue that was opened.
    Opened(Result<Arc<dyn Shelf>, AppError>),
    /// Product list.
    Found(Result<Found, AppError>),
    /// Products of the catalogue that match the palette's text.
    Hits(Result<Found, AppError>),
    /// Product, state and dataset of the selection, and sky and sun.
    Scene(Result<LoadedSelection, AppError>, Result<Daylight, SkyKeyError>),
    /// Year of shading control.
    Year(Result<Year, StudyError>),
    /// Annual simulation of the room.
    Annual(Result<Box<Annual>, AppError>),
    /// End of a ranking; its results were shown as they came.
    Ranked(Result<(), AppError>),
    /// Weather file that hours are picked from.
    Weather(Result<Box<Calendar>, StudyError>),
    /// Weather file that was opened.
    OpenedWeather(PathBuf),
    /// LID of the first aperture.
    Lid(Result<LidFigures, AppError>),
    /// Largest intensities of a LID.
    Peaks(Arc<LidFigures>, Peaks),
    /// Illuminances in the room.
    Room(Result<RoomFigures, AppError>),
    /// Part of the results of a candidate, by its number.
    Compared(u64, Box<Compared>),
    /// Illuminances of the room's surfaces.
    Surfaces(Result<SurfaceFigures, AppError>),
    /// Data of one incident direction in another form.
    DataForm(FormResult),
    /// Map of interpolation schemes between the directions of the data.
    Schemes(SchemesResult),
    /// Error against run time.
    Accuracy(Result<Accuracy, AppError>),
    /// Effects of obstructions.
    Obstructions(ObstructionEffects),
    /// Files that the user chose.
    Chosen(Result<Vec<PathBuf>, AppError>),
    /// Path to write to.
    Target(PathUse, Result<Option<PathBuf>, AppError>),
    /// Files that were read.
    Read(Box<Import>),
    /// Import with its files in another arrangement; names of the products before, by their files.
    Rearranged(Box<Import>, Vec<(Vec<String>, String)>),
    /// Findings of the data check about a dataset.
    Examined(Arc<Dataset>, Arc<Vec<Diagnosis>>),
    /// Several results, in order.
    Several(Vec<Outcome>),
    /// Imported product, identified by its files, with the requested repairs made: its datasets, their findings, and
    /// the repairs; or the reason why not.
    Repaired(Vec<String>, Result<Box<Proposed>, AppError>),
    /// System file that was read: its text and folder.
    ReadSystem(Result<(String, PathBuf), AppError>),
    /// Computed state of a system, with the keys of all its states.
    Measured(Result<Box<(Vec<String>, Finished)>, AppError>),
    /// Scene that was read.
    ReadScene(PathBuf, Result<Box<SceneFile>, AppError>),
    /// Control curve that was read.
    ReadCurve(Result<Vec<[f64; 2]>, AppError>),
    /// Stored additions with these numbers, each with whether it is new in the catalogue; or the reason why none is
    /// stored.
    Added(Vec<usize>, Result<Vec<(bool, Arc<Product>)>, AppError>),
    /// Product that was looked up to be selected.
    Choice(Result<Arc<Product>, AppError>),
    /// Change of this session that was made in the catalogue, or reverted.
    Changed(usize, bool, Result<(), AppError>),
    /// Product whose sheet is to be opened.
    Editing(Result<Looked, AppError>),
    /// Change that replaces the data of a state by a file that was read.
    ToReplace(Result<Change, AppError>),
    /// Differences found by reading the files of a product again.
    Reread(Result<Reread, AppError>),
    /// Report on reading the folders of packages that are subscribed to.
    Synced(Result<Report, AppError>),
    /// Path of a chosen folder of packages to subscribe to, or the reason why it is not one.
    Folder(Result<String, String>),
    /// Collections and subscriptions.
    Sets(Result<Sets, AppError>),
    /// Pictures of products.
    Pictures(Vec<Made>),
    /// Deleted products.
    Deleted(Result<Vec<Deleted>, AppError>),
    /// End of another change of the catalogue.
    Stored(Result<(), AppError>),
    /// End of storing the data of the chosen state in the catalogue.
    Provided(Result<(), AppError>),
    /// Number of built-in states left to compute, after some more were stored.
    Builtin(Result<usize, AppError>),
    /// Path that is to be written to, and whether a file exists there.
    There(PathUse, PathBuf, bool),
    /// Preview of an export.
    Preview(Result<Preview, AppError>),
    /// Picture of a tile for the clipboard.
    Copied(Tile, Result<Pixels, AppError>),
    /// File that was written.
    Written(PathUse, Result<PathBuf, AppError>),
    /// Warning about a file that was written.
    Warning(String),
    /// Fonts of the system by name, and characters that none of them has.
    Fonts(Vec<(String, egui::FontData)>, Vec<char>),
}

impl Outcome {
    /// Returns the outcome followed by a warning, if there is one.
    pub fn with_warning(self, warning: Option<String>) -> Self {
        match warning {
            Some(warning) => Self::Several(vec![self, Self::Warning(warning)]),
            None => self,
        }
    }
}

/// Part of the results of a candidate.
#[expect(clippy::large_enum_variant, reason = "one at a time, boxed on its way")]
pub enum Compared {
    /// Product, state and dataset, and sky and sun.
    Shelf(Result<LoadedSelection, AppError>, Result<Daylight, SkyKeyError>),
    /// State and dataset of a system that is not a product of the catalogue, and sky and sun.
    Own(Result<(String, Arc<Dataset>), AppError>, Result<Daylight, SkyKeyError>),
    /// LID of the first aperture.
    Lid(Result<LidFigures, AppError>),
    /// Largest intensities of the LID.
    Peaks(Arc<LidFigures>, Peaks),
    /// Illuminances in the room.
    Room(Result<RoomFigures, AppError>),
    /// Illuminances of the room's surfaces.
    Surfaces(Result<SurfaceFigures, AppError>),
    /// Year of shading control.
    Year(Result<Year, StudyError>),
    /// Figures of the dataset; `None` without a transmission.
    Data(Option<DataFacts>),
    /// Internal error.
    Failed(Part, String),
}

/// Product, state and dataset of the selection in the catalogue.
pub struct LoadedSelection {
    /// Selected product.
    pub product: Arc<Product>,
    /// Key of the state, picked by the scene's control if the state is controlled.
    pub state: String,
    /// Dataset of the state; `None` while it is still to be computed.
    pub dataset: Option<Arc<Dataset>>,
}

/// Computes data in advance, starting with the first of these products, until the order is to be determined again;
/// returns the number of states left.
pub(super) fn fill_some(shelf: &dyn Shelf, order: &[String], progress: &JobState) -> Result<usize, AppError> {
    // A separate thread pool, so that visible results never wait behind this; one core stays free for the window.
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

/// Returns sky and sun of a scene, as they are and as seen from its first aperture.
pub(super) fn daylight(scene: &SceneFile, base: &Path, progress: &dyn Progress) -> Result<Daylight, SkyKeyError> {
    let (outside, sun) = outside_from_keys(&scene.sky, &scene.site, base)?;
    // What is wrong with boxes the room's tile says; what was withdrawn nobody looks at.
    let seen = seen_by_first_aperture(scene, &outside, sun.as_ref(), progress).ok().flatten().map(Box::new);
    Ok(Daylight { outside, seen, sun })
}

/// Computes the effects of a scene's obstructions.
pub(super) fn obstructions(scene: SceneFile, base: &Path, progress: &dyn Progress) -> ObstructionEffects {
    let effects = obstruction_effects(&scene, base, progress).map_err(|error| error.to_string());
    (scene, effects)
}

/// Returns product, state and dataset of the selection.
pub(super) fn take_from_shelf(
    shelf: &dyn Shelf,
    selection: &Selection,
    scene: &SceneFile,
    daylight: Option<&Daylight>,
    (aperture, base): (usize, &Path),
) -> Result<LoadedSelection, AppError> {
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
    Ok(LoadedSelection { product, state, dataset })
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
