//! Systems in the apertures of a scene: ideal ones, dataset files, products of the catalogue.

use super::control::{ControlQuestion, Device};
use super::error::StudyError;
use super::outside::LitObstructions;
use super::scene_file::{IdealKind, SystemKeys};
use crate::compute::btdf::{self, Btdf, Dataset, SolarSource};
use crate::compute::system::measure::OpticalModel;
use std::fmt;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// System in an aperture, ready for computation.
#[derive(Debug, Clone, PartialEq)]
pub struct System {
    /// Label of the system in results.
    pub label: String,
    /// Key of the system's state; empty for systems without states.
    pub state: String,
    /// BSDF dataset of the system.
    pub dataset: Arc<Dataset>,
    /// Optical model of the system, which can be evaluated for single directions; `None` if the system is known by its
    /// data alone.
    pub model: Option<SystemModel>,
}

/// Optical model of a system, which can be evaluated for single directions, for visible light; with a second one for
/// the solar band and the source of its properties, if the description has solar properties. Two are equal if they are
/// the same object.
#[derive(Clone)]
pub struct SystemModel(pub Arc<dyn OpticalModel>, pub Option<(Arc<dyn OpticalModel>, SolarSource)>);

impl SystemModel {
    /// Returns the optical model for the solar band, or that for visible light if there is none, and the source of the
    /// solar properties.
    pub fn solar(&self) -> (&dyn OpticalModel, SolarSource) {
        self.1.as_ref().map_or((&*self.0, SolarSource::Visible), |(model, source)| (&**model, *source))
    }

    /// Returns the memory of the results that the models have cached. \[bytes\]
    pub fn bytes(&self) -> usize {
        self.0.bytes() + self.1.as_ref().map_or(0, |(solar, _)| solar.bytes())
    }

    /// Whether light from sky and ground may be computed with the optical model. If not, the data are used: where
    /// thousands of directions take too long, and where data separate regular transmission, which is more exact.
    pub fn answers_for_the_sky(&self) -> bool {
        self.0.is_quick() && !self.0.separates_regular()
    }
}

impl fmt::Debug for SystemModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("SystemModel")
    }
}

impl PartialEq for SystemModel {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// Returns the transmission of a dataset with regular transmission separated from scattered light; `None` if no regular
/// transmission is recognised. Computed once per dataset.
pub fn separate_regular(dataset: &Arc<Dataset>) -> Option<Arc<Btdf>> {
    type Known = (Weak<Dataset>, Option<Arc<Btdf>>);
    static KEPT: Mutex<Vec<Known>> = Mutex::new(Vec::new());
    // Stored values are complete even if another thread has failed while it held the lock.
    let kept = || KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    let same = |known: &Known| known.0.as_ptr() == Arc::as_ptr(dataset);
    if let Some((_, found)) = kept().iter().find(|known| same(known)) {
        return found.clone();
    }
    let found = dataset.transmission().and_then(btdf::separate_regular).map(Arc::new);
    let mut kept = kept();
    // An address that is held, even by a weak reference alone, is not reused.
    kept.retain(|(other, _)| other.strong_count() > 0);
    kept.push((Arc::downgrade(dataset), found.clone()));
    found
}

/// Extent of a system's data that a scene needs, so that no others are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Need {
    /// All data of the system, reflection included.
    Everything,
    /// Transmission of light from outside, unless the optical model is sufficient.
    Light {
        /// Whether the scene has light from sky or ground.
        lit: bool,
    },
}

/// Source of the systems that the key `aperture.system` of a scene names.
pub trait SystemLibrary: Sync {
    /// Loads the system in an aperture. `base`: folder to which file names are relative; `need`: data that the scene
    /// needs. Names of keys in errors are relative to the aperture.
    fn load(&self, keys: &SystemKeys, base: &Path, need: Need) -> Result<Arc<System>, StudyError>;

    /// Returns the key of the state that a control chooses for a product. `asked`: input of the control.
    fn controlled_state(&self, product: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError>;

    /// Returns the properties of a moving system that a shading control needs. `base`: folder to which file names are
    /// relative.
    ///
    /// # Errors
    /// Returns an error if there is no such system, or if it has no moving states.
    fn device(&self, keys: &SystemKeys, base: &Path) -> Result<Device, StudyError> {
        let _ = base;
        match keys {
            SystemKeys::Family { states, .. } => Ok(Device::of_family(states)),
            _ => Err(StudyError::key("system", "no devices are known here")),
        }
    }

    /// Returns the key of the state that a control chooses for the system in a description file. `asked`: input of the
    /// control.
    fn controlled_description(&self, path: &Path, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
        let _ = asked;
        Err(StudyError::key("system.file", format!("{}: no descriptions are read here", path.display())))
    }

    /// Returns the store of obstructions whose light was computed; `None` if this library does not store them.
    fn lit_obstructions(&self) -> Option<&LitObstructions> {
        None
    }
}

/// Creates an ideal system. `transmittance`: visible transmittance τ, 0 … 1.
pub fn ideal(kind: IdealKind, transmittance: f64) -> Result<Arc<System>, StudyError> {
    if !(0.0..=1.0).contains(&transmittance) {
        return Err(StudyError::key(
            "system.transmittance",
            format!("{transmittance} is out of range (allowed: 0 to 1)"),
        ));
    }
    let (name, btdf) = match kind {
        IdealKind::Transparent => ("ideal transparent", Btdf::ideal_transparent(transmittance)),
        IdealKind::Diffuse => ("ideal diffuse", Btdf::ideal_diffuse(transmittance)),
    };
    let mut dataset = Dataset { name: format!("{name}, τ = {transmittance}"), ..Dataset::default() };
    dataset.visible.transmission_front = Some(btdf);
    Ok(Arc::new(System { label: dataset.name.clone(), state: String::new(), dataset: Arc::new(dataset), model: None }))
}
