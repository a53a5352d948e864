//! Virtual goniophotometer: computes BSDF datasets from a system description, state by state, with indicators of their
//! quality. Finished states can be stored, so that an interrupted run can be resumed.

use super::error::StudyError;
use super::files;
use super::system::{System, SystemLibrary};
use crate::catalogue::{METHODS, NewProduct, Product, builtin_system, described_dataset, method, product_of};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{Band, BandName, Dataset, SolarSource};
use crate::compute::estimate::Progress;
use crate::compute::system::SystemKind;
use crate::compute::system::measure::directions::measured_at_directions;
use crate::compute::system::measure::{Quality, Setting};
use crate::compute::system::stack::LayerSource;
use crate::formats::dataset_blob;
use crate::formats::encoding::decode;
use crate::formats::system_toml::{self, MOST_NESTED, SystemFile, is_system_file};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// System description, with the location from which relative file names in it start.
#[derive(Debug, Clone, PartialEq)]
pub struct Described {
    /// Parsed content of the description.
    pub file: SystemFile,
    /// Text of the description: all input of the computation except the files of layers.
    pub text: String,
    /// Location from which relative file names in the description start.
    pub base: Base,
}

/// Location from which relative file names in a system description start.
#[derive(Debug, Clone, PartialEq)]
pub enum Base {
    /// Folder on disk.
    Folder(PathBuf),
    /// Built-in descriptions of the program.
    Builtin,
}

/// Bases and accuracy requested for a computed dataset.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Basis of incident directions.
    pub incident: RingBasis,
    /// Basis of emergent directions.
    pub emergent: RingBasis,
    /// Error target: absolute error of τ and ρ for any incident direction.
    pub error: f64,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Request {
    /// Whether data are computed for single incident directions, like the 145 of a goniophotometer; for Klems patches
    /// they are means over the patch.
    pub fn at_directions(&self) -> bool {
        self.incident == RingBasis::tregenza()
    }
}

/// Dataset computed for one state, with its quality.
#[derive(Debug, Clone, PartialEq)]
pub struct Computed {
    /// Dataset with four functions: transmission and reflection of both sides.
    pub dataset: Dataset,
    /// Energy balance, reciprocity and error of the data; `None` for a state that an earlier run stored.
    pub quality: Option<Quality>,
    /// Computing time; 0 for a stored state. \[s\]
    pub seconds: f64,
}

/// Source of the layers of a stack: products of the catalogue and dataset files.
pub trait LayerLibrary: SystemLibrary {
    /// Returns a product of the catalogue without its datasets.
    fn product(&self, key: &str) -> Result<Product, StudyError>;

    /// Returns all states of a dataset file.
    fn load_file(&self, path: &Path) -> Result<Vec<Arc<System>>, StudyError>;
}

impl Described {
    /// Reads a system description from its file. Errors name the file.
    pub fn read(path: &Path) -> Result<Self, StudyError> {
        let error = |message: String| StudyError::File { path: path.to_owned(), message };
        let bytes = files::read(path)?;
        let base = Base::Folder(files::folder(path).to_owned());
        let text = decode(&bytes).map_err(|e| error(e.to_string()))?;
        Self::from_text(&text, base).map_err(|e| error(e.to_string()))
    }

    /// Returns a built-in description by the name of its file; `None` if there is no such file.
    pub fn builtin(name: &str) -> Option<Self> {
        let (file, text) = builtin_system(name)?;
        Some(Self { file, text: text.to_owned(), base: Base::Builtin })
    }

    /// Reads another system description, in a file that this one names.
    pub(super) fn other(&self, name: &str) -> Result<Self, StudyError> {
        match &self.base {
            Base::Folder(folder) => Self::read(&folder.join(name)),
            Base::Builtin => Self::builtin(name).ok_or_else(|| {
                StudyError::key(
                    "stack.layers",
                    format!("no built-in description {name}; save this one beside its layers"),
                )
            }),
        }
    }

    /// Reads the description of a layer that is contained in the text of this one.
    pub(super) fn within(&self, text: &str) -> Result<Self, StudyError> {
        let layer_error = |error: crate::formats::FormatError| StudyError::key("stack.layers", error.to_string());
        Self::from_text(text, self.base.clone()).map_err(layer_error)
    }

    /// Returns the folder from which the description names dataset files.
    pub(super) fn folder(&self) -> &Path {
        match &self.base {
            Base::Folder(folder) => folder,
            Base::Builtin => Path::new("."),
        }
    }

    /// Creates a description from the text of a system file. `base`: location from which relative file names in it
    /// start.
    ///
    /// # Errors
    /// Returns an error that describes what is wrong with the text.
    pub fn from_text(text: &str, base: Base) -> Result<Self, crate::formats::FormatError> {
        Ok(Self { file: system_toml::read(text.as_bytes())?, text: text.to_owned(), base })
    }

    /// Computes the dataset of one state. `keep`: folder from which stored states are read, and in which finished ones
    /// are stored.
    pub fn measure(
        &self,
        state: &str,
        request: &Request,
        library: &dyn LayerLibrary,
        keep: Option<&Path>,
        progress: &dyn Progress,
    ) -> Result<Computed, StudyError> {
        let kept = keep.map(|folder| self.kept_name(state, request, library).map(|name| folder.join(name)));
        let kept = kept.transpose()?;
        if let Some(path) = &kept
            && let Ok(bytes) = std::fs::read(path)
            && let Ok(mut dataset) = dataset_blob::decode(&bytes)
        {
            dataset.described = self.described(state, library);
            return Ok(Computed { dataset, quality: None, seconds: 0.0 });
        }
        let start = Instant::now();
        let (visible, mut quality) = self.band(BandName::Visible, state, request, library, progress)?;
        // Without solar properties only the visible band is computed.
        let materials = self.materials(state, library)?;
        let mut solar = None;
        if SolarSource::of(materials) != SolarSource::Visible {
            let (band, of_band) = self.band(BandName::Solar, state, request, library, progress)?;
            (solar, quality) = (Some(band), quality.worse(of_band));
        }
        let mut dataset = described_dataset(&self.file, state.to_owned(), visible, &quality, request.error);
        dataset.solar = solar;
        if SolarSource::of(materials) == SolarSource::Partly {
            dataset.mark_partly_visible(materials);
        }
        dataset.described = self.described(state, library);
        if let Some(path) = &kept {
            // A state that cannot be stored is computed again next time: nothing is lost.
            drop(files::write_at_once(path, &dataset_blob::encode(&dataset)));
        }
        Ok(Computed { dataset, quality: Some(quality), seconds: start.elapsed().as_secs_f64() })
    }

    /// Computes the four functions of a state in one spectral band, with their quality.
    fn band(
        &self,
        band: BandName,
        state: &str,
        request: &Request,
        library: &dyn LayerLibrary,
        progress: &dyn Progress,
    ) -> Result<(Band, Quality), StudyError> {
        let Request { incident, emergent, error, seed } = request;
        let setting = Setting { incident, emergent, error: *error, seed: *seed };
        let model = self.optical_model_in(band, state, library)?;
        if request.at_directions() {
            let measured = measured_at_directions(model.as_ref(), &setting, progress)?;
            return Ok((measured.band_at_directions(), measured.quality()));
        }
        Ok(model.examine(&setting, progress)?)
    }

    /// Computes the datasets of several states, as many at a time as there are threads. Progress counts finished
    /// states; for a single state its own steps. `keep`: folder in which finished states are stored.
    pub fn measure_all(
        &self,
        states: &[String],
        request: &Request,
        library: &dyn LayerLibrary,
        keep: Option<&Path>,
        progress: &dyn Progress,
    ) -> Result<Vec<Computed>, StudyError> {
        if let [state] = states {
            return Ok(vec![self.measure(state, request, library, keep, progress)?]);
        }
        let withdrawn = Withdrawn(progress);
        let mut done = Vec::with_capacity(states.len());
        for some in states.chunks(rayon::current_num_threads()) {
            progress.advance("states", done.len(), states.len());
            let computed: Result<Vec<Computed>, StudyError> =
                some.par_iter().map(|state| self.measure(state, request, library, keep, &withdrawn)).collect();
            done.extend(computed?);
        }
        Ok(done)
    }

    /// Returns the product data (name, provenance, states) for storing the datasets in the catalogue.
    pub fn product(&self, request: &Request, datasets: &[Dataset]) -> NewProduct {
        product_of(&self.file, &self.text, self.method(request), datasets)
    }

    /// Returns a text on the method by which the data are computed, for their provenance.
    pub fn method(&self, request: &Request) -> String {
        method(&self.file.system, request.error, [request.incident.len(), request.emergent.len()])
    }

    /// Returns the file name of a stored state: a hash of all input of its data.
    fn kept_name(&self, state: &str, request: &Request, library: &dyn LayerLibrary) -> Result<String, StudyError> {
        let mut hash = blake3::Hasher::new();
        for part in [state, request.incident.name(), request.emergent.name(), "light and solar"] {
            hash.update(part.as_bytes()).update(b"\0");
        }
        self.sources_into(&mut hash, library, 0)?;
        hash.update(&request.error.to_le_bytes()).update(&request.seed.to_le_bytes()).update(&METHODS.to_le_bytes());
        Ok(format!("{}.cfsd", &hash.finalize().to_hex()[..32]))
    }

    /// Returns the hash of all input of the system: its text and its layers.
    pub(super) fn fingerprint(&self, library: &dyn LayerLibrary) -> Result<String, StudyError> {
        let mut hash = blake3::Hasher::new();
        self.sources_into(&mut hash, library, 0)?;
        Ok(hash.finalize().to_hex().to_string())
    }

    /// Adds the text and the input of all layers to a hash. `depth`: level of nesting so far.
    fn sources_into(
        &self,
        hash: &mut blake3::Hasher,
        library: &dyn LayerLibrary,
        depth: usize,
    ) -> Result<(), StudyError> {
        hash.update(self.text.as_bytes()).update(b"\0");
        let SystemKind::Stack(layers) = &self.file.system.kind else { return Ok(()) };
        // Deeper ones are refused when they are computed.
        for layer in layers.iter().filter(|_| depth < MOST_NESTED) {
            match &layer.source {
                LayerSource::File(name) if is_system_file(name) => {
                    self.other(name)?.sources_into(hash, library, depth + 1)?;
                }
                // A file that cannot be read is reported by its reader.
                LayerSource::File(name) => {
                    hash.update(&std::fs::read(self.folder().join(name)).unwrap_or_default());
                }
                LayerSource::Text(text) => self.within(text)?.sources_into(hash, library, depth + 1)?,
                LayerSource::Catalogue(key) => {
                    let product = library.product(key)?;
                    // Data of a built-in description depend on nothing else, whether they exist or not.
                    if product.builtin && !product.system.is_empty() {
                        hash.update(product.system.as_bytes());
                    } else {
                        product.states.iter().filter_map(|state| state.dataset.as_ref()).for_each(|dataset| {
                            hash.update(dataset.as_bytes());
                        });
                    }
                }
            }
            hash.update(b"\0");
        }
        Ok(())
    }
}

/// Progress of the computation of one state among several, which only passes on cancellation, since its steps would
/// make a progress bar jump.
pub struct Withdrawn<'a>(pub &'a dyn Progress);

impl Progress for Withdrawn<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
