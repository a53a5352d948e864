//! Library from which programs load the systems of scenes: ideal systems, dataset files (stored as long as they do not
//! change), descriptions, and the catalogue.

use super::builtin;
use super::by_description::system_model_from_text;
use super::control::{ControlQuestion, Device, pick_state};
use super::error::StudyError;
use super::files;
use super::goniophotometer::{Described, LayerLibrary};
use super::outside::LitObstructions;
use super::recent::Recent;
use super::scene_file::{FamilyState, SystemKeys};
use super::system::{Need, System, SystemLibrary, SystemModel, ideal};
use crate::catalogue::{Catalogue, CatalogueError, Found, Product, Query};
use crate::compute::btdf::{Btdf, Dataset, DescribedState};
use crate::compute::estimate::Silent;
use crate::formats::read_dataset;
use crate::formats::system_toml::is_system_file;
use std::collections::HashMap;
use std::convert::Infallible;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;

/// Hemispherical transmittance above which the values of a dataset are assumed to be in another unit, because no
/// measuring error is as large.
const OTHER_UNIT: f64 = 1.5;

/// Library of systems: dataset and description files, ideal systems, and a catalogue that is opened when first needed.
pub struct Library {
    files: Mutex<HashMap<PathBuf, Loaded>>,
    catalogue_path: Option<PathBuf>,
    catalogue: Mutex<Option<Catalogue>>,
    /// Systems of description files, by the hash of their input, their state, and the extent of their data.
    described: Recent<(String, Option<String>, Need), Arc<System>>,
    /// Optical models of the descriptions that datasets carry; `None` for descriptions without a model.
    models: Recent<DescribedState, Option<SystemModel>>,
    obstructions: LitObstructions,
}

impl Default for Library {
    fn default() -> Self {
        Self::with_catalogue(None)
    }
}

/// Systems of a dataset file, valid as long as time and length of the file do not change.
type Loaded = ((SystemTime, u64), Vec<Arc<System>>);

impl Library {
    /// Creates a library with the catalogue at a path; `None`: the catalogue of the user.
    pub fn with_catalogue(path: Option<&Path>) -> Self {
        Self {
            files: Mutex::default(),
            catalogue_path: path.map(Path::to_owned),
            catalogue: Mutex::default(),
            described: Recent::new(|system| system.model.as_ref().map_or(0, SystemModel::bytes)),
            models: Recent::new(|model| model.as_ref().map_or(0, SystemModel::bytes)),
            obstructions: LitObstructions::default(),
        }
    }

    /// Calls a function with the catalogue, which is opened if it is not open yet.
    fn in_catalogue<T>(&self, ask: impl FnOnce(&mut Catalogue) -> Result<T, CatalogueError>) -> Result<T, StudyError> {
        let mut open = self.catalogue.lock().unwrap_or_else(PoisonError::into_inner);
        let catalogue_error = |error: CatalogueError| StudyError::Catalogue(error.to_string());
        let mut catalogue = match open.take() {
            Some(catalogue) => catalogue,
            None => self
                .catalogue_path
                .as_deref()
                .map_or_else(Catalogue::open_default, Catalogue::open)
                .map_err(catalogue_error)?,
        };
        let answer = ask(&mut catalogue).map_err(catalogue_error);
        *open = Some(catalogue);
        answer
    }

    /// Returns the products that match search words, by the same rules as the window (without words all products), and
    /// the result of the search with its notes on words and damaged products.
    ///
    /// # Errors
    /// Returns an error if the catalogue cannot be read.
    pub fn search(&self, words: &str) -> Result<(Vec<Product>, Found), StudyError> {
        self.in_catalogue(|catalogue| {
            let found = catalogue.find(&Query { text: words.to_owned(), ..Query::default() })?;
            let products = found.entries.iter().map(|row| catalogue.product(&row.key)).collect::<Result<_, _>>()?;
            Ok((products, found))
        })
    }

    /// Computes and stores the data of a built-in product's state if the catalogue does not contain them yet.
    fn provide(&self, product: &str, state: Option<&str>) -> Result<(), StudyError> {
        let Some(state) = self.in_catalogue(|catalogue| catalogue.to_compute(product, state))? else { return Ok(()) };
        let product = self.in_catalogue(|catalogue| catalogue.product(product))?;
        let dataset = builtin::compute(&product, &state, self, &Silent)?;
        self.in_catalogue(|catalogue| catalogue.keep_state(&product, &dataset))
    }
}

impl Library {
    /// Returns a state of the system in a description file; it is computed once, as long as the description does not
    /// change.
    fn load_description(&self, path: &Path, state: Option<&str>, need: Need) -> Result<Arc<System>, StudyError> {
        let described = Described::read(path)?;
        let key = (described.fingerprint(self)?, state.map(str::to_owned), need);
        self.described.get(&key, || Ok(Arc::new(described.system(state, need, self)?)))
    }

    /// Returns the optical model for the description that a dataset carries; it is stored, together with its solutions.
    /// `None` if there is no description, or if it names layers that are not available, so that only the data are
    /// known.
    pub fn model_of(&self, dataset: &Dataset) -> Option<SystemModel> {
        let described = dataset.described.as_ref()?;
        let Ok(model) = self
            .models
            .get::<Infallible>(described, || Ok(system_model_from_text(&described.text, &described.state, self)));
        model
    }
}

impl LayerLibrary for Library {
    fn product(&self, key: &str) -> Result<Product, StudyError> {
        self.in_catalogue(|catalogue| catalogue.product(key))
    }

    fn load_file(&self, path: &Path) -> Result<Vec<Arc<System>>, StudyError> {
        let error = |message: String| StudyError::File { path: path.to_owned(), message };
        let meta = std::fs::metadata(path).map_err(|e| error(format!("cannot be read: {e}")))?;
        let stamp = (meta.modified().unwrap_or(SystemTime::UNIX_EPOCH), meta.len());
        let mut known = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((then, systems)) = known.get(path)
            && *then == stamp
        {
            return Ok(systems.clone());
        }
        let bytes = files::read(path)?;
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let datasets = read_dataset(&name, &bytes).map_err(|e| error(e.to_string()))?;
        // Readers accept per cent so that the data can be repaired; a room would be a hundred times too bright.
        let passed = |one: &Dataset| one.transmission().map_or(0.0, Btdf::tau_hemispherical);
        if let Some(sum) = datasets.iter().map(passed).find(|sum| *sum > OTHER_UNIT) {
            return Err(error(format!(
                "its transmission lets {sum:.4} times the diffuse light through that comes; expected at most 1: numbers in \
                 percent are repaired by `cfs repair`"
            )));
        }
        let systems: Vec<Arc<System>> = datasets
            .into_iter()
            .map(|dataset| {
                let label = if dataset.name.is_empty() { name.clone() } else { dataset.name.clone() };
                Arc::new(System { label, state: dataset.state.clone(), dataset: Arc::new(dataset), model: None })
            })
            .collect();
        known.insert(path.to_owned(), (stamp, systems.clone()));
        Ok(systems)
    }
}

impl SystemLibrary for Library {
    fn load(&self, keys: &SystemKeys, base: &Path, need: Need) -> Result<Arc<System>, StudyError> {
        match keys {
            SystemKeys::Ideal { kind, transmittance } => ideal(*kind, *transmittance),
            SystemKeys::Ranked => Err(StudyError::ranked("system")),
            SystemKeys::Luminaires { index, .. } => Err(StudyError::key(
                "system.luminaires",
                format!("{}: luminaire files hold no dataset", index.display()),
            )),
            SystemKeys::File { path, state } if is_system_file(&path.to_string_lossy()) => {
                self.load_description(&base.join(path), state.as_deref(), need)
            }
            SystemKeys::File { path, state } => {
                let systems = self.load_file(&base.join(path))?;
                let found = pick(&systems, state.as_deref(), &path.display().to_string())?;
                let model = self.model_of(&found.dataset);
                Ok(if model.is_some() { Arc::new(System { model, ..System::clone(&found) }) } else { found })
            }
            SystemKeys::Family { states, state } => {
                let path = &family_state(states, state.as_deref())?.file;
                let system = self.load(&SystemKeys::File { path: path.clone(), state: None }, base, need)?;
                let state = state.clone().unwrap_or_else(|| states[0].state.clone());
                Ok(Arc::new(System { state, ..System::clone(&system) }))
            }
            SystemKeys::Catalogue { key, state } => {
                self.provide(key, state.as_deref())?;
                let (dataset, label) = self.in_catalogue(|catalogue| {
                    Ok((catalogue.dataset(key, state.as_deref())?, catalogue.product(key)?.name))
                })?;
                let model = self.model_of(&dataset);
                Ok(Arc::new(System { label, state: dataset.state.clone(), dataset, model }))
            }
        }
    }

    fn controlled_state(&self, product: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
        pick_state(&Device::of(&self.product(product)?)?, asked)
    }

    fn device(&self, keys: &SystemKeys, base: &Path) -> Result<Device, StudyError> {
        match keys {
            SystemKeys::Catalogue { key, .. } => Device::of(&self.product(key)?),
            SystemKeys::Family { states, .. } => Ok(Device::of_family(states)),
            SystemKeys::File { path, .. } if is_system_file(&path.to_string_lossy()) => {
                let described = Described::read(&base.join(path))?;
                let states = described.states(self)?;
                Ok(Device::described(&described.file, &described.text, states))
            }
            SystemKeys::Ranked => Err(StudyError::ranked("system")),
            SystemKeys::File { .. } | SystemKeys::Ideal { .. } | SystemKeys::Luminaires { .. } => Err(StudyError::key(
                "system.state",
                "\"controlled\" needs a product, a description or a family of files",
            )),
        }
    }

    fn controlled_description(&self, path: &Path, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
        let described = Described::read(path)?;
        let states = described.states(self)?;
        pick_state(&Device::described(&described.file, &described.text, states), asked)
    }

    fn lit_obstructions(&self) -> Option<&LitObstructions> {
        Some(&self.obstructions)
    }
}

/// Returns the state of a family with a key, or the first one if no key is given.
fn family_state<'a>(states: &'a [FamilyState], state: Option<&str>) -> Result<&'a FamilyState, StudyError> {
    let found = match state {
        None => states.first(),
        Some(key) => states.iter().find(|one| one.state == key),
    };
    found.ok_or_else(|| {
        let keys: Vec<&str> = states.iter().map(|one| one.state.as_str()).collect();
        let message = format!("no state '{}'; the family has: {}", state.unwrap_or_default(), keys.join(", "));
        StudyError::key("system.state", message)
    })
}

fn pick(systems: &[Arc<System>], state: Option<&str>, name: &str) -> Result<Arc<System>, StudyError> {
    let found = match state {
        None => systems.first(),
        Some(state) => systems.iter().find(|system| system.state == state),
    };
    found.cloned().ok_or_else(|| {
        let states: Vec<&str> = systems.iter().map(|system| system.state.as_str()).collect();
        StudyError::key(
            "system.state",
            format!("{name} has no state '{}'; it has: {}", state.unwrap_or_default(), states.join(", ")),
        )
    })
}
