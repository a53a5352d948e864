//! The numerical goniophotometer on files: from a system file to datasets, state by state, with what is known about
//! their quality. Finished states can be kept, so that an interrupted run goes on where it stopped.

use super::error::StudyError;
use super::library::Library;
use super::scene_file::SystemKeys;
use super::system::SystemLibrary;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{Dataset, Finding};
use crate::compute::estimate::Progress;
use crate::compute::goniophotometer::specimen::specimen;
use crate::compute::goniophotometer::stack::{DataLayer, Stack};
use crate::compute::goniophotometer::upright::Upright;
use crate::compute::goniophotometer::{Quality, Setting, Specimen};
use crate::compute::system::description::{Layer, LayerSource, SystemDescription, SystemKind};
use crate::formats::dataset_blob;
use crate::formats::system_toml::{self, EACH_STATE, SystemFile, is_system_file};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Stacks within stacks, at most.
const MOST_NESTED: usize = 4;
/// Version of the methods: raised whenever computed values change, so that kept states are not mistaken.
const METHODS: u32 = 1;

/// A system file with the place from which it names others.
#[derive(Debug, Clone, PartialEq)]
pub struct Described {
    /// What the file says.
    pub file: SystemFile,
    /// The file's text, which is the whole input of the computation but for other layers' files.
    pub text: String,
    /// Folder of the file.
    pub base: PathBuf,
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

impl Described {
    /// Reads a system file. The error names the file.
    pub fn read(path: &Path) -> Result<Self, StudyError> {
        let error = |message: String| StudyError::File { path: path.to_owned(), message };
        let bytes = std::fs::read(path).map_err(|e| error(format!("cannot be read: {e}")))?;
        let base = path.parent().unwrap_or(Path::new(".")).to_owned();
        Self::from_text(&String::from_utf8_lossy(&bytes), base).map_err(|e| error(e.to_string()))
    }

    /// From the text of a system file, which names others relative to `base`.
    ///
    /// # Errors
    /// What is wrong with the text.
    pub fn from_text(text: &str, base: PathBuf) -> Result<Self, crate::formats::FormatError> {
        Ok(Self { file: system_toml::read(text.as_bytes())?, text: text.to_owned(), base })
    }

    /// Keys of its states. For a stack with a moving layer, those of the layer.
    pub fn states(&self, library: &Library) -> Result<Vec<String>, StudyError> {
        let SystemKind::Stack(layers) = &self.file.system.kind else { return Ok(self.file.system.states()) };
        let Some(layer) = layers.iter().find(|layer| layer.state == EACH_STATE) else { return Ok(vec![String::new()]) };
        match &layer.source {
            LayerSource::File(name) if is_system_file(name) => Self::read(&self.base.join(name))?.states(library),
            LayerSource::File(name) => {
                let systems = library.load_file(&self.base.join(name))?;
                Ok(systems.iter().map(|system| system.state.clone()).collect())
            }
            LayerSource::Catalogue(key) => {
                Ok(library.product(key)?.states.into_iter().map(|state| state.key).collect())
            }
        }
    }

    /// One state, ready to be measured.
    pub fn specimen(&self, state: &str, library: &Library) -> Result<Box<dyn Specimen>, StudyError> {
        self.nested(state, library, 0)
    }

    fn nested(&self, state: &str, library: &Library, depth: usize) -> Result<Box<dyn Specimen>, StudyError> {
        let system = &self.file.system;
        let SystemKind::Stack(layers) = &system.kind else {
            return specimen(system, state).map_err(|error| StudyError::key("state", error.to_string()));
        };
        if depth >= MOST_NESTED {
            return Err(StudyError::key("stack.layers", format!("stacks within stacks, more than {MOST_NESTED}")));
        }
        let moving = layers.iter().any(|layer| layer.state == EACH_STATE);
        if !moving && !state.is_empty() {
            return Err(StudyError::key("state", "a stack without a moving layer has no states"));
        }
        let made: Result<Vec<_>, StudyError> =
            layers.iter().map(|layer| self.layer(layer, state, library, depth)).collect();
        let stack: Box<dyn Specimen> = Box::new(Stack(made?));
        Ok(if system.upright { Box::new(Upright(stack)) } else { stack })
    }

    fn layer(
        &self,
        layer: &Layer,
        state: &str,
        library: &Library,
        depth: usize,
    ) -> Result<Box<dyn Specimen>, StudyError> {
        let state = if layer.state == EACH_STATE { state } else { &layer.state };
        let told = (!state.is_empty()).then(|| state.to_owned());
        let keys = match &layer.source {
            LayerSource::File(name) if is_system_file(name) => {
                return Self::read(&self.base.join(name))?.nested(state, library, depth + 1);
            }
            LayerSource::File(name) => SystemKeys::File { path: name.into(), state: told },
            LayerSource::Catalogue(key) => SystemKeys::Catalogue { key: key.clone(), state: told },
        };
        let system = library.load(&keys, &self.base)?;
        Ok(Box::new(DataLayer(system.dataset.visible.clone())))
    }

    /// Computes one state. States kept under `keep` are taken from there, and finished ones left there.
    pub fn measure(
        &self,
        state: &str,
        request: &Request,
        library: &Library,
        keep: Option<&Path>,
        progress: &dyn Progress,
    ) -> Result<Computed, StudyError> {
        let kept = keep.map(|folder| folder.join(self.kept_name(state, request)));
        if let Some(path) = &kept
            && let Ok(bytes) = std::fs::read(path)
            && let Ok(dataset) = dataset_blob::decode(&bytes)
        {
            return Ok(Computed { dataset, quality: None, seconds: 0.0 });
        }
        let start = Instant::now();
        let Request { incident, emergent, error, seed } = request;
        let setting = Setting { incident, emergent, error: *error, seed: *seed };
        let (visible, quality) = self.specimen(state, library)?.examine(&setting, progress)?;
        let system = &self.file.system;
        let dataset = Dataset {
            name: system.name.clone(),
            description: system.description.clone(),
            state: state.to_owned(),
            structure: system.structure(),
            visible,
            incident_basis: incident.name().to_owned(),
            emergent_basis: emergent.name().to_owned(),
            findings: findings(system, request, &quality),
            ..Dataset::default()
        };
        if let Some(path) = &kept {
            // A state that cannot be kept is computed again next time: nothing is lost.
            drop(std::fs::write(path, dataset_blob::encode(&dataset)));
        }
        Ok(Computed { dataset, quality: Some(quality), seconds: start.elapsed().as_secs_f64() })
    }

    /// Name of a kept state: by everything that decides its values but the files of other layers.
    fn kept_name(&self, state: &str, request: &Request) -> String {
        let mut hash = blake3::Hasher::new();
        for part in [&self.text, state, request.incident.name(), request.emergent.name()] {
            hash.update(part.as_bytes()).update(b"\0");
        }
        for layer in self.layer_files() {
            hash.update(&std::fs::read(layer).unwrap_or_default()).update(b"\0");
        }
        hash.update(&request.error.to_le_bytes()).update(&request.seed.to_le_bytes()).update(&METHODS.to_le_bytes());
        format!("{}.cfsd", &hash.finalize().to_hex()[..32])
    }

    fn layer_files(&self) -> Vec<PathBuf> {
        let SystemKind::Stack(layers) = &self.file.system.kind else { return Vec::new() };
        let file = |layer: &Layer| match &layer.source {
            LayerSource::File(name) => Some(self.base.join(name)),
            LayerSource::Catalogue(_) => None,
        };
        layers.iter().filter_map(file).collect()
    }

    /// How the values came to be, for the catalogue: method, program, and what it was asked.
    pub fn method(&self, request: &Request) -> String {
        format!(
            "Numerical goniophotometer of cfs {}: {}; error target {}, {} × {} cells",
            env!("CARGO_PKG_VERSION"),
            method_words(&self.file.system),
            request.error,
            request.incident.len(),
            request.emergent.len(),
        )
    }
}

/// The method in words, with its source.
pub fn method_words(system: &SystemDescription) -> &'static str {
    match &system.kind {
        SystemKind::Venetian(_) => {
            "section of endless slats, direct share in closed form, strip radiosity, mirror chains as bundles of lines"
        }
        SystemKind::LaserCutPanel(_) => {
            "Edmonds' shares (Solar Energy Materials and Solar Cells 29, 1993), Fresnel faces"
        }
        SystemKind::Prismatic(_) | SystemKind::RedirectingGlass(_) => {
            "section of endless clear bodies, beams followed with their polarisation, no dispersion, no interference"
        }
        SystemKind::Pane(_) => {
            "Fresnel and Bouguer-Lambert through the stack, coated panes by the angular fits of WINDOW 4, no interference"
        }
        SystemKind::Diffuser(_) => "separable diffuse light and a balanced Gaussian lobe in direction cosines",
        SystemKind::Woven(_) => "roller blind model of Kotey, Wright and Collins (ASHRAE Transactions 115, 2009)",
        SystemKind::Perforated(_) => "radiosity in the hole, straight share by clipped polygons",
        SystemKind::Stack(_) => "adding method on matrices of refined cells (Klems, ASHRAE Transactions 100, 1994)",
    }
}

fn findings(system: &SystemDescription, request: &Request, quality: &Quality) -> Vec<Finding> {
    let reciprocity = match quality.reciprocity {
        Some(error) => format!("reciprocity within {:.2} % of the flux", 100.0 * error),
        None => "reciprocity not counted on unequal cells".to_owned(),
    };
    let text = format!(
        "Computed ({}): τ + ρ + α = 1 within {:.3} %, {reciprocity}, estimated error of τ and ρ at most {:.4}.",
        method_words(system),
        100.0 * quality.balance,
        quality.error
    );
    let mut list = vec![Finding::info("computed", text)];
    if quality.error > request.error {
        list.push(Finding::warning(
            "error-target-missed",
            format!(
                "The error target {} was not reached at every incidence; {:.4} at the worst.",
                request.error, quality.error
            ),
        ));
    }
    list
}
