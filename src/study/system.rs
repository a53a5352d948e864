//! Where the systems of a scene come from: closed forms, files, the catalogue.

use super::control::{ControlQuestion, Device};
use super::error::StudyError;
use super::outside::LitObstructions;
use super::scene_file::{IdealKind, SystemKeys};
use crate::compute::btdf::{self, Btdf, Dataset, SolarSource};
use crate::compute::system::measure::Specimen;
use std::fmt;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// A system ready to be computed with.
#[derive(Debug, Clone, PartialEq)]
pub struct System {
    /// What to call it in results.
    pub label: String,
    /// Key of the state; empty for systems without.
    pub state: String,
    /// Its photometry.
    pub dataset: Arc<Dataset>,
    /// What answers for single directions, where the system is known by its description.
    pub very: Option<VerySystem>,
}

/// A system that answers for light of single directions; and in the solar band, where its description has properties for it.
/// Two are equal when they are the same.
#[derive(Clone)]
pub struct VerySystem(pub Arc<dyn Specimen>, pub Option<(Arc<dyn Specimen>, SolarSource)>);

impl VerySystem {
    /// What answers in the solar band: by its own properties, else by those of light.
    pub fn solar(&self) -> (&dyn Specimen, SolarSource) {
        self.1.as_ref().map_or((&*self.0, SolarSource::Visible), |(specimen, source)| (&**specimen, *source))
    }

    /// May sky and ground be computed from its answers? Else its data are: where thousands of answers take too long, and
    /// where data keep straight light apart, which is better still.
    pub fn answers_for_the_sky(&self) -> bool {
        self.0.is_quick() && !self.0.keeps_regular_apart()
    }
}

impl fmt::Debug for VerySystem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("VerySystem")
    }
}

impl PartialEq for VerySystem {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// Transmission of a dataset with regular transmission separated; `None` where none is recognised. Computed once a dataset.
pub fn separate_regular(dataset: &Arc<Dataset>) -> Option<Arc<Btdf>> {
    type Known = (Weak<Dataset>, Option<Arc<Btdf>>);
    static KEPT: Mutex<Vec<Known>> = Mutex::new(Vec::new());
    // What is kept is whole even if another thread has failed while it held the lock.
    let kept = || KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    let same = |known: &Known| known.0.as_ptr() == Arc::as_ptr(dataset);
    if let Some((_, found)) = kept().iter().find(|known| same(known)) {
        return found.clone();
    }
    let found = dataset.transmission().and_then(btdf::separate_regular).map(Arc::new);
    let mut kept = kept();
    // An address that is held, if by a weak reference alone, is no other's.
    kept.retain(|(other, _)| other.strong_count() > 0);
    kept.push((Arc::downgrade(dataset), found.clone()));
    found
}

/// How much of a system a scene needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Need {
    /// All that is known of it.
    Everything,
    /// What it does to light from outside, as far as its description does not tell by itself; `lit`: is there light from
    /// sky or ground?
    Light {
        /// Sky or ground shine.
        lit: bool,
    },
}

/// Loads what `aperture.system` names.
pub trait SystemLibrary: Sync {
    /// Loads a system. Key names in errors are relative to the aperture.
    fn load(&self, keys: &SystemKeys, base: &Path, need: Need) -> Result<Arc<System>, StudyError>;

    /// The state that a control picks for a product.
    fn controlled_state(&self, product: &str, asked: &ControlQuestion<'_>) -> Result<String, StudyError>;

    /// What a control needs to know of a moving system.
    ///
    /// # Errors
    /// No such system, or one that nothing moves.
    fn device(&self, keys: &SystemKeys, base: &Path) -> Result<Device, StudyError> {
        let _ = base;
        match keys {
            SystemKeys::Family { states, .. } => Ok(Device::of_family(states)),
            _ => Err(StudyError::key("system", "no devices are known here")),
        }
    }

    /// The state that a control picks for a description in a file.
    fn controlled_description(&self, path: &Path, asked: &ControlQuestion<'_>) -> Result<String, StudyError> {
        let _ = asked;
        Err(StudyError::key("system.file", format!("{}: no descriptions are read here", path.display())))
    }

    /// Where lit obstructions are kept, if they are.
    fn lit_obstructions(&self) -> Option<&LitObstructions> {
        None
    }
}

/// An ideal system.
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
    Ok(Arc::new(System { label: dataset.name.clone(), state: String::new(), dataset: Arc::new(dataset), very: None }))
}
