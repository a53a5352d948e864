//! What runs in jobs, and what jobs bring back.

use super::control::{CONTROLLED, Year};
use super::engine::{Engine, LidFigures, RoomFigures};
use super::goniophotometer::Finished;
use super::jobs::JobState;
use super::shelf::{Found, Shelf};
use super::state::{Daylight, Import, PathUse, Selection};
use crate::catalogue::{Gathered, Imported, Product, SYSTEMS, SourceFile, gather};
use crate::compute::angle::Bearing;
use crate::compute::btdf::Dataset;
use crate::compute::direction::Orientation;
use crate::compute::doctor::{Diagnosis, Repair, examine, repaired_all};
use crate::compute::estimate::Progress;
use crate::compute::lid::Facing;
use crate::formats::control_curve::read_control_curve;
use crate::formats::system_toml::is_system_file;
use crate::study::Library;
use crate::study::accuracy::Accuracy;
use crate::study::control::ControlQuestion;
use crate::study::scene_file::{ControlKeys, ControlMode, SceneFile};
use crate::study::sky::SkyKeyError;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Reads the datasets of a file: name and bytes.
pub type ReadDataset = fn(&str, &[u8]) -> Result<SourceFile, String>;

/// Files beyond this are refused before they are read. \[bytes\]
const LARGEST_FILE: u64 = 1 << 30;

/// What jobs bring back.
#[expect(clippy::large_enum_variant, reason = "a few a second, each moved once")]
pub enum Outcome {
    /// The catalogue is open.
    Opened(Result<Arc<dyn Shelf>, String>),
    /// A list.
    Found(Result<Found, String>),
    /// Product, state and dataset of the selection, and sky and sun.
    Scene(Result<Shelved, String>, Result<Daylight, SkyKeyError>),
    /// What control does over the year.
    Year(Result<Year, String>),
    /// The LID.
    Lid(Result<LidFigures, String>),
    /// The room.
    Room(Result<RoomFigures, String>),
    /// Error against run time.
    Accuracy(Result<Accuracy, String>),
    /// Files that the user chose.
    Chosen(Result<Vec<PathBuf>, String>),
    /// Where to write.
    Target(PathUse, Result<Option<PathBuf>, String>),
    /// Files were read.
    Read(Box<Import>),
    /// What was read, with repairs: the datasets, what is said about them, and the repairs; or why not.
    Mended(Result<Mended, String>),
    /// A system file was read: its text and folder.
    ReadSystem(Result<(String, PathBuf), String>),
    /// A state of a system was measured; the keys of all.
    Measured(Result<Box<(Vec<String>, Finished)>, String>),
    /// A scene was read.
    ReadScene(PathBuf, Result<Box<SceneFile>, String>),
    /// A control curve was read.
    ReadCurve(Result<Vec<[f64; 2]>, String>),
    /// An addition is in the catalogue.
    Added(usize, Result<String, String>),
    /// A package is in the catalogue.
    Imported(Result<Vec<Imported>, String>),
    /// Something else in the catalogue was changed.
    Stored(Result<(), String>),
    /// A built-in product is in the catalogue; how many are left.
    Builtin(Result<usize, String>),
    /// A file was written.
    Written(PathUse, Result<PathBuf, String>),
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

/// Computes and stores one built-in product; how many are left.
pub(super) fn fill_one(shelf: &dyn Shelf, progress: &JobState) -> Result<usize, String> {
    let Some((name, missing)) = shelf.next_builtin()? else { return Ok(0) };
    progress.advance("computing", SYSTEMS.len() - missing, SYSTEMS.len());
    // One core stays free for what the user is doing.
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads((cores - 1).max(1)).build();
    let compute =
        || crate::study::builtin::compute(name, &Library::default(), progress).map_err(|error| error.to_string());
    let (product, datasets) = pool.map_err(|error| error.to_string())?.install(compute)?;
    shelf.put_builtin(name, product, &datasets)?;
    Ok(missing - 1)
}

/// The selection's product, state and dataset.
pub(super) fn take_from_shelf(
    shelf: &dyn Shelf,
    selection: &Selection,
    scene: &SceneFile,
    daylight: Option<&Daylight>,
    (aperture, base): (usize, &Path),
) -> Result<Shelved, String> {
    let product = shelf.product(&selection.product)?;
    let state = if selection.state == CONTROLLED {
        let fixed = ControlKeys::of(ControlMode::Fixed);
        let keys = super::control::rule(scene, aperture).unwrap_or(&fixed);
        let daylight = daylight.ok_or_else(|| "no state is picked until sky and sun are right".to_owned())?;
        let facing = Facing {
            outside: &daylight.outside,
            sun: daylight.sun.as_ref(),
            orientation: Orientation::new(Bearing::from_degrees(scene.site.azimuth)),
            surface: super::control::surface_of(scene, aperture),
        };
        let hour = super::moment::of(scene).map(|time| f64::from(time.hour()) + f64::from(time.minute()) / 60.0);
        let asked = ControlQuestion { keys, base, hour, facing };
        shelf.controlled_state(&selection.product, &asked).map_err(|error| error.to_string())?
    } else if selection.state.is_empty() {
        product.states.first().map(|state| state.key.clone()).unwrap_or_default()
    } else {
        selection.state.clone()
    };
    let dataset = shelf.load(&selection.product, Some(&state))?;
    Ok(Shelved { product, state, dataset })
}

/// Reads files: one scene, system or control curve, or datasets.
pub fn read_files(paths: &[PathBuf], read: ReadDataset) -> Outcome {
    let text_of = |path: &Path, what: &str| {
        String::from_utf8(read_bytes(path)?).map_err(|e| {
            format!("{}: byte {} is not UTF-8; {what} is a text file", path.display(), e.utf8_error().valid_up_to())
        })
    };
    if let [path] = paths
        && is_system_file(&path.to_string_lossy())
    {
        let base = path.parent().map(PathBuf::from).unwrap_or_default();
        return Outcome::ReadSystem(text_of(path, "a system").map(|text| (text, base)));
    }
    if let [path] = paths
        && path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
    {
        let scene = text_of(path, "a scene").and_then(|text| {
            SceneFile::parse(&text).map(Box::new).map_err(|error| format!("{}: {error}", path.display()))
        });
        return Outcome::ReadScene(path.clone(), scene);
    }
    if let [path] = paths
        && path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"))
    {
        let told = |error: &dyn std::fmt::Display| format!("{}: as a control curve: {error}", path.display());
        let curve = read_bytes(path).and_then(|bytes| read_control_curve(&bytes).map_err(|error| told(&error)));
        return Outcome::ReadCurve(curve);
    }
    let mut import = Import::default();
    let mut sources = Vec::new();
    for path in paths {
        let name = path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into());
        match read_bytes(path).and_then(|bytes| read(&name, &bytes).map_err(|error| format!("{name}: {error}"))) {
            Ok(source) => sources.push(source),
            Err(error) => import.failures.push(error),
        }
        import.files.push(name);
    }
    let mut products = gather(sources, false).into_iter();
    if let Some(Gathered { meta, datasets, .. }) = products.next() {
        import.diagnoses = datasets.iter().map(examine).collect();
        import.datasets = datasets.into_iter().map(Arc::new).collect();
        import.originals = import.datasets.clone();
        import.name = meta.name;
        import.manufacturer = meta.manufacturer;
        import.kind = meta.kind;
        import.tags = meta.tags.join(", ");
        import.provenance = meta.provenance;
    }
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
    Outcome::Mended(mended.map_err(|error| error.to_string()).map(|datasets| Mended {
        diagnoses: datasets.iter().map(examine).collect(),
        datasets: datasets.into_iter().map(Arc::new).collect(),
        repairs,
    }))
}

pub(super) fn read_bytes(path: &Path) -> Result<Vec<u8>, String> {
    let told = |error: std::io::Error| format!("{}: cannot be read ({error}); check path and rights", path.display());
    let size = std::fs::metadata(path).map_err(told)?.len();
    if size > LARGEST_FILE {
        return Err(format!("{}: {size} bytes are more than the 1 GiB that is read", path.display()));
    }
    std::fs::read(path).map_err(told)
}

/// Writes beside the target first, so that a failure leaves nothing half-written.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<PathBuf, String> {
    let mut name = path
        .file_name()
        .map(std::ffi::OsStr::to_os_string)
        .ok_or_else(|| format!("{}: names no file; give a path that ends in a file name", path.display()))?;
    name.push(".part");
    let part = path.with_file_name(name);
    let told = |error: std::io::Error| format!("{}: cannot be written ({error})", path.display());
    let written = std::fs::write(&part, bytes).and_then(|()| std::fs::rename(&part, path));
    written.map_err(|error| {
        // Best effort: the part may never have come to be.
        drop(std::fs::remove_file(&part));
        told(error)
    })?;
    Ok(path.to_path_buf())
}

/// Saves the scene.
pub fn save_scene(path: &Path, text: Result<String, toml::ser::Error>) -> Outcome {
    let written = text
        .map_err(|error| format!("the scene cannot be written as text: {error}"))
        .and_then(|text| write_whole(path, text.as_bytes()));
    Outcome::Written(PathUse::SaveScene, written)
}

/// Writes the LID as a luminaire file.
pub fn export_lid(path: &Path, lid: Option<&LidFigures>, engine: &dyn Engine) -> Outcome {
    let written = lid
        .ok_or_else(|| "the LID is not computed yet: wait for its tile, then export again".to_owned())
        .and_then(|lid| engine.luminaire(lid, path))
        .and_then(|bytes| write_whole(path, &bytes));
    Outcome::Written(PathUse::ExportLid, written)
}
