//! The numerical goniophotometer on files: from a system file to datasets, state by state, with what is known about
//! their quality. Finished states can be kept, so that an interrupted run goes on where it stopped.

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

/// A system file with the place from which it names others.
#[derive(Debug, Clone, PartialEq)]
pub struct Described {
    /// What the file says.
    pub file: SystemFile,
    /// The file's text, which is the whole input of the computation but for other layers' files.
    pub text: String,
    /// From where it names other files.
    pub base: Base,
}

/// From where a description names other files.
#[derive(Debug, Clone, PartialEq)]
pub enum Base {
    /// A folder.
    Folder(PathBuf),
    /// The descriptions that come with the program.
    Builtin,
}

/// On which cells, and how exactly.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Incident cells.
    pub incident: RingBasis,
    /// Emergent cells.
    pub emergent: RingBasis,
    /// Absolute error allowed in τ and ρ of any incidence.
    pub error: f64,
    /// Seed of what is drawn at random.
    pub seed: u64,
}

impl Request {
    /// Are incidences single directions? The 145 of a goniophotometer are; Klems cells are cells.
    pub fn at_directions(&self) -> bool {
        self.incident == RingBasis::tregenza()
    }
}

/// A computed state.
#[derive(Debug, Clone, PartialEq)]
pub struct Computed {
    /// The four functions.
    pub dataset: Dataset,
    /// Balance, reciprocity, error; `None` for a state that was kept from an earlier run.
    pub quality: Option<Quality>,
    /// Time it took; 0 for a kept state. \[s\]
    pub seconds: f64,
}

/// Where a stack's layers come from.
pub trait LayerLibrary: SystemLibrary {
    /// A product of the catalogue without its datasets.
    fn product(&self, key: &str) -> Result<Product, StudyError>;

    /// All states of a dataset file.
    fn load_file(&self, path: &Path) -> Result<Vec<Arc<System>>, StudyError>;
}

impl Described {
    /// Reads a system file. The error names the file.
    pub fn read(path: &Path) -> Result<Self, StudyError> {
        let error = |message: String| StudyError::File { path: path.to_owned(), message };
        let bytes = files::read(path)?;
        let base = Base::Folder(files::folder(path).to_owned());
        let text = decode(&bytes).map_err(|e| error(e.to_string()))?;
        Self::from_text(&text, base).map_err(|e| error(e.to_string()))
    }

    /// A built-in one by the name of its file.
    pub fn builtin(name: &str) -> Option<Self> {
        let (file, text) = builtin_system(name)?;
        Some(Self { file, text: text.to_owned(), base: Base::Builtin })
    }

    /// Another system file that this one names.
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

    /// A layer that is described in this one's own text.
    pub(super) fn within(&self, text: &str) -> Result<Self, StudyError> {
        let told = |error: crate::formats::FormatError| StudyError::key("stack.layers", error.to_string());
        Self::from_text(text, self.base.clone()).map_err(told)
    }

    /// Where dataset files lie that it names.
    pub(super) fn folder(&self) -> &Path {
        match &self.base {
            Base::Folder(folder) => folder,
            Base::Builtin => Path::new("."),
        }
    }

    /// From the text of a system file, which names others relative to `base`.
    ///
    /// # Errors
    /// What is wrong with the text.
    pub fn from_text(text: &str, base: Base) -> Result<Self, crate::formats::FormatError> {
        Ok(Self { file: system_toml::read(text.as_bytes())?, text: text.to_owned(), base })
    }

    /// Computes one state. States kept under `keep` are taken from there, and finished ones left there.
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
        // Of what says nothing of the solar band there is nothing but light to be computed.
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
            // A state that cannot be kept is computed again next time: nothing is lost.
            drop(files::write_at_once(path, &dataset_blob::encode(&dataset)));
        }
        Ok(Computed { dataset, quality: Some(quality), seconds: start.elapsed().as_secs_f64() })
    }

    /// The four functions of a state in one band.
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
        let specimen = self.specimen_in(band, state, library)?;
        if request.at_directions() {
            let measured = measured_at_directions(specimen.as_ref(), &setting, progress)?;
            return Ok((measured.band_at_directions(), measured.quality()));
        }
        Ok(specimen.examine(&setting, progress)?)
    }

    /// Computes several states, as many at a time as there are threads. Progress is told by finished states; that of a
    /// single one by its own steps.
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

    /// What the catalogue is told about its datasets.
    pub fn product(&self, request: &Request, datasets: &[Dataset]) -> NewProduct {
        product_of(&self.file, &self.text, self.method(request), datasets)
    }

    /// How its values come to be.
    pub fn method(&self, request: &Request) -> String {
        method(&self.file.system, request.error, [request.incident.len(), request.emergent.len()])
    }

    /// Name of a kept state: by everything that decides its values.
    fn kept_name(&self, state: &str, request: &Request, library: &dyn LayerLibrary) -> Result<String, StudyError> {
        let mut hash = blake3::Hasher::new();
        for part in [state, request.incident.name(), request.emergent.name(), "light and solar"] {
            hash.update(part.as_bytes()).update(b"\0");
        }
        self.sources_into(&mut hash, library, 0)?;
        hash.update(&request.error.to_le_bytes()).update(&request.seed.to_le_bytes()).update(&METHODS.to_le_bytes());
        Ok(format!("{}.cfsd", &hash.finalize().to_hex()[..32]))
    }

    /// Hash of all that the system is computed from.
    pub(super) fn fingerprint(&self, library: &dyn LayerLibrary) -> Result<String, StudyError> {
        let mut hash = blake3::Hasher::new();
        self.sources_into(&mut hash, library, 0)?;
        Ok(hash.finalize().to_hex().to_string())
    }

    /// Hashes the text and what its layers are made of.
    fn sources_into(
        &self,
        hash: &mut blake3::Hasher,
        library: &dyn LayerLibrary,
        depth: usize,
    ) -> Result<(), StudyError> {
        hash.update(self.text.as_bytes()).update(b"\0");
        let SystemKind::Stack(layers) = &self.file.system.kind else { return Ok(()) };
        // Deeper ones are refused when they are measured.
        for layer in layers.iter().filter(|_| depth < MOST_NESTED) {
            match &layer.source {
                LayerSource::File(name) if is_system_file(name) => {
                    self.other(name)?.sources_into(hash, library, depth + 1)?;
                }
                // What cannot be read is told by its reader.
                LayerSource::File(name) => {
                    hash.update(&std::fs::read(self.folder().join(name)).unwrap_or_default());
                }
                LayerSource::Text(text) => self.within(text)?.sources_into(hash, library, depth + 1)?,
                LayerSource::Catalogue(key) => {
                    let product = library.product(key)?;
                    // What is computed from a built-in description hangs on nothing else, whether it is there or not.
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

/// Hands on whether the result is still wanted; steps within a state would only make a bar jump.
pub struct Withdrawn<'a>(pub &'a dyn Progress);

impl Progress for Withdrawn<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
