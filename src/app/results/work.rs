//! Work that is executed in jobs, and the results of jobs.

use crate::app::catalogue::changes::{Change, Looked, Reread};
use crate::app::catalogue::gallery::Made;
use crate::app::catalogue::shelf::{Found, Sets, Shelf};
use crate::app::compare::view::Part;
use crate::app::export::choices::Preview;
use crate::app::goniophotometer::run::Finished;
use crate::app::import::proposal::{Import, Proposed};
use crate::app::results::data_looks::{FormResult, SchemesResult};
use crate::app::results::engine::{LidFigures, RoomFigures, SurfaceFigures};
use crate::app::scene::control::Year;
use crate::app::scene::outside::ObstructionEffects;
use crate::app::scene::{Selection, rule};
use crate::app::shell::error::AppError;
use crate::app::state::{Daylight, PathUse, Tile};
use crate::app::year::input::Calendar;
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

pub use crate::study::intake::ReadDataset;

/// Picture for the clipboard: width and height \[px\], and red, green and blue of its pixels row by row.
pub type Pixels = (usize, usize, Vec<u8>);

/// Result of a job.
#[expect(clippy::large_enum_variant, reason = "a few a second, each moved once")]
pub enum Outcome {
    /// Catalogue that was opened.
    Opened(Result<Arc<dyn Shelf>, AppError>),
    /// Result of a search, for the list of products.
    Found(Result<Found, AppError>),
    /// Products of the catalogue that match the text of the command palette.
    Hits(Result<Found, AppError>),
    /// Product, state and dataset of the selection; and sky and sun.
    Scene(Result<LoadedSelection, AppError>, Result<Daylight, SkyKeyError>),
    /// State that the control rule chooses for every step of a year.
    Year(Result<Year, StudyError>),
    /// Annual simulation of the room.
    Annual(Result<Box<Annual>, AppError>),
    /// End of a ranking, whose results have been shown during the computation.
    Ranked(Result<(), AppError>),
    /// Calendar of the hours of a weather file.
    Weather(Result<Box<Calendar>, StudyError>),
    /// Path of a weather file that was opened.
    OpenedWeather(PathBuf),
    /// Luminous intensity distribution (LID) of the first aperture.
    Lid(Result<LidFigures, AppError>),
    /// Largest intensities of a LID, with this LID; `None` if their search was cancelled.
    Peaks(Arc<LidFigures>, Option<Peaks>),
    /// Illuminances at the sensor points in the room.
    Room(Result<RoomFigures, AppError>),
    /// Part of the results of a candidate of the comparison, by its number.
    Compared(u64, Box<Compared>),
    /// Illuminances on the room's surfaces.
    Surfaces(Result<SurfaceFigures, AppError>),
    /// Processed data (filtered or compressed) for one incident direction.
    DataForm(FormResult),
    /// Map of the interpolation scheme that applies at each incident direction between those of the data.
    Schemes(SchemesResult),
    /// Error of the results against computing time.
    Accuracy(Result<Accuracy, AppError>),
    /// Effects of the obstructions on the illuminance of the apertures.
    Obstructions(ObstructionEffects),
    /// Paths of files that the user chose to open.
    Chosen(Result<Vec<PathBuf>, AppError>),
    /// Path that the user chose for writing; `None` if the dialog was cancelled.
    Target(PathUse, Result<Option<PathBuf>, AppError>),
    /// Import of the files that were read.
    Read(Box<Import>),
    /// Import with another grouping of its files into products, and the former names of the products by their files.
    Rearranged(Box<Import>, Vec<(Vec<String>, String)>),
    /// Dataset, and the findings of the data check on it.
    Examined(Arc<Dataset>, Arc<Vec<Diagnosis>>),
    /// Several results, to be taken over in this order.
    Several(Vec<Outcome>),
    /// Identifiers of the files of an imported product, and this product with the requested repairs made, or the reason
    /// why they cannot be made.
    Repaired(Vec<String>, Result<Box<Proposed>, AppError>),
    /// System file that was read: its text and its folder.
    ReadSystem(Result<(String, PathBuf), AppError>),
    /// Keys of all states of a system, and one of them as computed by the virtual goniophotometer.
    Measured(Result<Box<(Vec<String>, Finished)>, AppError>),
    /// Scene that was read, with its path.
    ReadScene(PathBuf, Result<Box<SceneFile>, AppError>),
    /// Control curve that was read: points of profile angle \[°\] and value.
    ReadCurve(Result<Vec<[f64; 2]>, AppError>),
    /// Indices of additions of this session, and their stored products, each with whether it is new in the catalogue;
    /// or the reason why none was stored.
    Added(Vec<usize>, Result<Vec<(bool, Arc<Product>)>, AppError>),
    /// Product that was loaded to be selected.
    Choice(Result<Arc<Product>, AppError>),
    /// Index of a change of this session, whether it was made (`true`) or reverted in the catalogue, and the result of
    /// that.
    Changed(usize, bool, Result<(), AppError>),
    /// Product whose side panel is to be opened.
    Editing(Result<Looked, AppError>),
    /// Change that replaces the data of a state by those of a file that was read.
    ToReplace(Result<Change, AppError>),
    /// Differences found by reading the files of a product again.
    Reread(Result<Reread, AppError>),
    /// Report on reading the subscribed folders of packages.
    Synced(Result<Report, AppError>),
    /// Path of a folder of packages that the user chose for a subscription, or the reason why it is not valid.
    Folder(Result<String, String>),
    /// Collections and subscriptions.
    Sets(Result<Sets, AppError>),
    /// Pictures of products for the gallery.
    Pictures(Vec<Made>),
    /// Deleted products.
    Deleted(Result<Vec<Deleted>, AppError>),
    /// End of a change of the catalogue that is not one of the others.
    Stored(Result<(), AppError>),
    /// End of computing and storing the dataset of the selected state.
    Provided(Result<(), AppError>),
    /// Number of states of built-in products left to compute, after some were stored.
    Builtin(Result<usize, AppError>),
    /// Path that is to be written, and whether a file exists there.
    There(PathUse, PathBuf, bool),
    /// Preview of an export.
    Preview(Result<Preview, AppError>),
    /// Tile, and its picture for the clipboard.
    Copied(Tile, Result<Pixels, AppError>),
    /// Path of a file that was written.
    Written(PathUse, Result<PathBuf, AppError>),
    /// Warning about a file that was written.
    Warning(String),
    /// Fonts of the system by name, and characters missing in all of them.
    Fonts(Vec<(String, egui::FontData)>, Vec<char>),
}

impl Outcome {
    /// Returns the result, followed by a warning if there is one.
    pub fn with_warning(self, warning: Option<String>) -> Self {
        match warning {
            Some(warning) => Self::Several(vec![self, Self::Warning(warning)]),
            None => self,
        }
    }
}

/// Part of the results of a candidate of the comparison.
#[expect(clippy::large_enum_variant, reason = "one at a time, boxed on its way")]
pub enum Compared {
    /// Product, state and dataset of the candidate; and sky and sun.
    Shelf(Result<LoadedSelection, AppError>, Result<Daylight, SkyKeyError>),
    /// State and dataset of a candidate that is not a product of the catalogue; and sky and sun.
    Own(Result<(String, Arc<Dataset>), AppError>, Result<Daylight, SkyKeyError>),
    /// Luminous intensity distribution (LID) of the first aperture.
    Lid(Result<LidFigures, AppError>),
    /// Largest intensities of the LID, with this LID.
    Peaks(Arc<LidFigures>, Peaks),
    /// Illuminances at the sensor points in the room.
    Room(Result<RoomFigures, AppError>),
    /// Illuminances on the room's surfaces.
    Surfaces(Result<SurfaceFigures, AppError>),
    /// State that the control rule chooses for every step of a year.
    Year(Result<Year, StudyError>),
    /// Figures of the dataset; `None` for a dataset without transmission.
    Data(Option<DataFacts>),
    /// Internal error in computing a part of the results.
    Failed(Part, String),
}

/// Product, state and dataset of the selection, loaded from the catalogue.
pub struct LoadedSelection {
    /// Selected product.
    pub product: Arc<Product>,
    /// Key of the state; if the selection is `controlled`, the one that the control rule of the scene chooses.
    pub state: String,
    /// Dataset of the state; `None` if it is still to be computed.
    pub dataset: Option<Arc<Dataset>>,
}

/// Returns sky and sun of a scene, the sky unobstructed and as seen from the first aperture. `base`: folder to which
/// paths in the scene are relative.
pub(in crate::app) fn daylight(
    scene: &SceneFile,
    base: &Path,
    progress: &dyn Progress,
) -> Result<Daylight, SkyKeyError> {
    let (outside, sun) = outside_from_keys(&scene.sky, &scene.site, base)?;
    // What is wrong with boxes the room's tile says; what was withdrawn nobody looks at.
    let seen = seen_by_first_aperture(scene, &outside, sun.as_ref(), progress).ok().flatten().map(Box::new);
    Ok(Daylight { outside, seen, sun })
}

/// Computes the effects of a scene's obstructions on the illuminance of its apertures. `base`: as in [`daylight`].
pub(in crate::app) fn obstructions(scene: SceneFile, base: &Path, progress: &dyn Progress) -> ObstructionEffects {
    let effects = obstruction_effects(&scene, base, progress).map_err(|error| error.to_string());
    (scene, effects)
}

/// Returns product, state and dataset of a selection from the catalogue. `aperture`: index of the aperture whose
/// control rule chooses the state; `base`: as in [`daylight`].
pub(in crate::app) fn take_from_shelf(
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
        let hour =
            crate::app::scene::moment::of(scene).map(|time| f64::from(time.hour()) + f64::from(time.minute()) / 60.0);
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
