//! What runs in jobs, and what jobs bring back.

use super::control::Year;
use super::disk::{ends_in, read_bytes, write_whole};
use super::engine::{Engine, LidFigures, RoomFigures};
use super::error::AppError;
use super::facing::surface_of;
use super::goniophotometer::Finished;
use super::jobs::JobState;
use super::scene::{Selection, rule};
use super::shelf::{Found, Shelf};
use super::state::{Daylight, Import, PathUse};
use crate::catalogue::{Gathered, Imported, Product, SYSTEMS, SourceFile, gather};
use crate::compute::angle::Bearing;
use crate::compute::btdf::Dataset;
use crate::compute::direction::Orientation;
use crate::compute::doctor::{Diagnosis, Repair, examine, repaired_all};
use crate::compute::estimate::Progress;
use crate::compute::lid::Facing;
use crate::formats::FormatError;
use crate::formats::control_curve::read_control_curve;
use crate::formats::system_toml::is_system_file;
use crate::study::accuracy::Accuracy;
use crate::study::control::ControlQuestion;
use crate::study::control::year::CONTROLLED;
use crate::study::scene_file::{ControlKeys, ControlMode, SceneFile};
use crate::study::sky::SkyKeyError;
use crate::study::{Library, StudyError};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Reads the datasets of a file: name and bytes.
pub type ReadDataset = fn(&str, &[u8]) -> Result<SourceFile, FormatError>;

/// How long built-in products are put in before the list is looked up anew.
const FILLING: Duration = Duration::from_millis(500);

/// What jobs bring back.
#[expect(clippy::large_enum_variant, reason = "a few a second, each moved once")]
pub enum Outcome {
    /// The catalogue is open.
    Opened(Result<Arc<dyn Shelf>, AppError>),
    /// A list.
    Found(Result<Found, AppError>),
    /// Product, state and dataset of the selection, and sky and sun.
    Scene(Result<Shelved, AppError>, Result<Daylight, SkyKeyError>),
    /// What control does over the year.
    Year(Result<Year, StudyError>),
    /// The LID.
    Lid(Result<LidFigures, AppError>),
    /// The room.
    Room(Result<RoomFigures, AppError>),
    /// Error against run time.
    Accuracy(Result<Accuracy, AppError>),
    /// Files that the user chose.
    Chosen(Result<Vec<PathBuf>, AppError>),
    /// Where to write.
    Target(PathUse, Result<Option<PathBuf>, AppError>),
    /// Files were read.
    Read(Box<Import>),
    /// What was read, with repairs: the datasets, what is said about them, and the repairs; or why not.
    Mended(Result<Mended, AppError>),
    /// A system file was read: its text and folder.
    ReadSystem(Result<(String, PathBuf), AppError>),
    /// A state of a system was measured; the keys of all.
    Measured(Result<Box<(Vec<String>, Finished)>, AppError>),
    /// A scene was read.
    ReadScene(PathBuf, Result<Box<SceneFile>, AppError>),
    /// A control curve was read.
    ReadCurve(Result<Vec<[f64; 2]>, AppError>),
    /// An addition is in the catalogue.
    Added(usize, Result<Arc<Product>, AppError>),
    /// A product to be chosen was looked up.
    Choice(Result<Arc<Product>, AppError>),
    /// A package is in the catalogue.
    Imported(Result<Vec<Imported>, AppError>),
    /// Something else in the catalogue was changed.
    Stored(Result<(), AppError>),
    /// Built-in products are in the catalogue; how many are left.
    Builtin(Result<usize, AppError>),
    /// A file was written.
    Written(PathUse, Result<PathBuf, AppError>),
}

/// What the catalogue holds of the selection.
pub struct Shelved {
    /// Product.
    pub product: Arc<Product>,
    /// Key of the state, picked by the scene's control where it is left to it.
    pub state: String,
    /// Its dataset.
    pub dataset: Arc<Dataset>,
}

/// Computes and stores built-in products one after the other, until the list is worth looking up anew; how many are left.
pub(super) fn fill_some(shelf: &dyn Shelf, progress: &JobState) -> Result<usize, AppError> {
    // Threads of its own, so that what is in sight never waits behind this; one core stays free for the window.
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads((cores - 1).max(1)).build()?;
    let start = Instant::now();
    while let Some((name, missing)) = shelf.next_builtin()? {
        progress.advance("computing", SYSTEMS.len() - missing, SYSTEMS.len());
        pool.install(|| -> Result<(), AppError> {
            let (product, datasets) = crate::study::builtin::compute(name, &Library::default(), progress)?;
            shelf.put_builtin(name, product, &datasets)
        })?;
        if start.elapsed() > FILLING {
            return Ok(missing - 1);
        }
    }
    Ok(0)
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
        let facing = Facing {
            outside: &daylight.outside,
            sun: daylight.sun.as_ref(),
            orientation: Orientation::new(Bearing::from_degrees(scene.site.azimuth)),
            surface: surface_of(scene, aperture),
        };
        let hour = super::moment::of(scene).map(|time| f64::from(time.hour()) + f64::from(time.minute()) / 60.0);
        let asked = ControlQuestion { keys, base, hour, facing };
        shelf.controlled_state(&selection.product, &asked)?
    } else if selection.state.is_empty() {
        product.states.get(product.representative().1).map(|state| state.key.clone()).unwrap_or_default()
    } else {
        selection.state.clone()
    };
    let dataset = shelf.load(&selection.product, Some(&state))?;
    Ok(Shelved { product, state, dataset })
}

/// Reads files: one scene, system or control curve, or datasets.
pub fn read_files(paths: &[PathBuf], read: ReadDataset) -> Outcome {
    let text_of = |path: &Path, what: &'static str| {
        let wrong = |byte| AppError::NotText(byte, what).about(path.display());
        String::from_utf8(read_bytes(path)?).map_err(|error| wrong(error.utf8_error().valid_up_to()))
    };
    // Its name ends like a scene's, so it is asked about first. Among several files neither is opened: those are taken
    // as states of a product, and what is no dataset is listed as a failure.
    if let [path] = paths
        && is_system_file(&path.to_string_lossy())
    {
        // Files that the system names are found from its own folder.
        let base = path.parent().map(PathBuf::from).unwrap_or_default();
        return Outcome::ReadSystem(text_of(path, "a system").map(|text| (text, base)));
    }
    if let [path] = paths
        && ends_in(path, "toml")
    {
        let scene = text_of(path, "a scene").and_then(|text| {
            SceneFile::parse(&text).map(Box::new).map_err(|error| AppError::from(error).about(path.display()))
        });
        return Outcome::ReadScene(path.clone(), scene);
    }
    if let [path] = paths
        && ends_in(path, "csv")
    {
        let curve = read_bytes(path)
            .and_then(|bytes| read_control_curve(&bytes).map_err(|error| AppError::from(error).about(path.display())));
        return Outcome::ReadCurve(curve);
    }
    let mut import = Import::default();
    let mut sources = Vec::new();
    for path in paths {
        let name = path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into());
        let source =
            read_bytes(path).and_then(|bytes| read(&name, &bytes).map_err(|error| AppError::from(error).about(&name)));
        match source {
            Ok(source) => sources.push(source),
            // One bad file among many does not stop the others: the sheet lists it.
            Err(error) => import.failures.push(error.to_string()),
        }
        import.files.push(name);
    }
    let mut products = gather(sources, false).into_iter();
    if let Some(Gathered { meta, datasets, .. }) = products.next() {
        import.diagnoses = datasets.iter().map(examine).collect();
        import.datasets = datasets.into_iter().map(Arc::new).collect();
        // Repairs always start from what the files hold, so that each can be taken back.
        import.originals = import.datasets.clone();
        import.name = meta.name;
        import.manufacturer = meta.manufacturer;
        import.kind = meta.kind;
        import.tags = meta.tags.join(", ");
        import.provenance = meta.provenance;
    }
    // The sheet asks for name and maker of one product; the others are not lost without a word.
    for other in products {
        let (name, files) = (other.meta.name, other.meta.provenance.source_file);
        import.failures.push(format!("{files}: another product (\"{name}\"); open it after this one"));
    }
    Outcome::Read(Box::new(import))
}

/// Datasets with repairs made.
#[derive(Debug)]
pub struct Mended {
    /// One a state.
    pub datasets: Vec<Arc<Dataset>>,
    /// What the data doctor says about each now.
    pub diagnoses: Vec<Vec<Diagnosis>>,
    /// The repairs.
    pub repairs: Vec<Repair>,
}

/// Makes repairs on all states and examines what comes of it.
pub(super) fn mend(originals: &[Arc<Dataset>], repairs: Vec<Repair>) -> Outcome {
    let mended: Result<Vec<Dataset>, _> = originals.iter().map(|dataset| repaired_all(dataset, &repairs)).collect();
    Outcome::Mended(mended.map_err(AppError::from).map(|datasets| Mended {
        diagnoses: datasets.iter().map(examine).collect(),
        datasets: datasets.into_iter().map(Arc::new).collect(),
        repairs,
    }))
}

/// Saves the scene.
pub fn save_scene(path: &Path, text: Result<String, toml::ser::Error>) -> Outcome {
    let written = text.map_err(AppError::from).and_then(|text| write_whole(path, text.as_bytes()));
    Outcome::Written(PathUse::SaveScene, written)
}

/// Writes the LID as a luminaire file.
pub fn export_lid(path: &Path, lid: Option<&LidFigures>, engine: &dyn Engine) -> Outcome {
    let written = lid
        .ok_or(AppError::NoLid)
        .and_then(|lid| engine.luminaire(lid, path))
        .and_then(|bytes| write_whole(path, &bytes));
    Outcome::Written(PathUse::ExportLid, written)
}
