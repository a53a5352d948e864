//! Systems that are known by their description: their data for a scene are computed from it; direct sunlight is traced
//! through it for the actual sun position.

use super::error::StudyError;
use super::goniophotometer::{Base, Described, LayerLibrary, Request};
use super::system::{Need, System, SystemModel};
use crate::compute::btdf::{BandName, Btdf, Dataset, Finding, SolarSource};
use crate::compute::estimate::Silent;
use crate::compute::system::measure::front_basis;
use std::sync::Arc;

/// Error target (absolute, of τ and ρ) of the data with which light from sky and ground and back reflection are
/// computed.
const ERROR: f64 = 0.005;

/// Returns the bases and the error target of data that are computed for a scene.
pub fn request() -> Request {
    let cells = front_basis();
    Request { incident: cells.clone(), emergent: cells, error: ERROR, seed: 1 }
}

impl Described {
    /// Creates the system of an aperture from one state of the description. `need`: data that the scene needs.
    pub fn system(&self, state: Option<&str>, need: Need, library: &dyn LayerLibrary) -> Result<System, StudyError> {
        let states = self.states(library)?;
        let first = states.first().map(String::as_str).unwrap_or_default();
        let state = state.unwrap_or(first);
        if !states.iter().any(|key| key == state) {
            return Err(StudyError::key("system.state", no_such_state(&self.file.system.name, state, &states)));
        }
        let model = self.system_model(state, library)?;
        let dataset = match need {
            Need::Light { lit } if !lit || model.answers_for_the_sky() => self.dark(state),
            Need::Everything | Need::Light { .. } => self.measure(state, &request(), library, None, &Silent)?.dataset,
        };
        let label = if state.is_empty() { dataset.name.clone() } else { format!("{}, {state}", dataset.name) };
        Ok(System { label, state: state.to_owned(), dataset: Arc::new(dataset), model: Some(model) })
    }

    /// Creates the optical model for single directions, with one for the solar band if the materials have solar
    /// properties.
    fn system_model(&self, state: &str, library: &dyn LayerLibrary) -> Result<SystemModel, StudyError> {
        let source = SolarSource::of(self.materials(state, library)?);
        let solar = match source {
            SolarSource::Visible => None,
            _ => Some((Arc::from(self.optical_model_in(BandName::Solar, state, library)?), source)),
        };
        Ok(SystemModel(Arc::from(self.optical_model(state, library)?), solar))
    }

    /// Returns a dataset without light, in place of data that a scene does not need.
    fn dark(&self, state: &str) -> Dataset {
        let system = &self.file.system;
        let mut dataset = Dataset {
            name: system.name.clone(),
            description: system.description.clone(),
            state: state.to_owned(),
            structure: system.family().structure(),
            findings: vec![Finding::info("not-computed", "Nothing in this scene asks for them.")],
            ..Dataset::default()
        };
        dataset.visible.transmission_front = Some(Btdf::default());
        dataset
    }
}

/// Creates the optical model from the text of a description; `None` if it names layers that cannot be found.
pub(super) fn system_model_from_text(text: &str, state: &str, library: &dyn LayerLibrary) -> Option<SystemModel> {
    let described = Described::from_text(text, Base::Builtin).ok()?;
    described.system_model(state, library).ok()
}

/// Returns the message that a described system does not have a state.
pub(super) fn no_such_state(name: &str, state: &str, states: &[String]) -> String {
    if states.iter().all(String::is_empty) {
        format!("{name} has no states; leave `state` out")
    } else {
        format!("{name} has no state '{state}'; it has: {}", states.join(", "))
    }
}
