//! Optical model of a described system: its layers combined into one model in either spectral band, and the number of
//! materials with known solar properties.

use super::error::StudyError;
use super::goniophotometer::{Described, LayerLibrary};
use super::scene_file::SystemKeys;
use super::system::{Need, System};
use crate::compute::btdf::{BandName, SolarSource};
use crate::compute::system::SystemKind;
use crate::compute::system::measure::OpticalModel;
use crate::compute::system::measure::upright::Upright;
use crate::compute::system::panes::Panes;
use crate::compute::system::panes::coated::Layer as Pane;
use crate::compute::system::stack::{DataLayer, Layer, LayerSource, Stack};
use crate::formats::system_toml::{EACH_STATE, MOST_NESTED, is_system_file};
use std::sync::Arc;

/// Maximum number of layers of a stack, including nested stacks.
const MOST_LAYERS: usize = 40;

/// Layer of a stack, or a run of adjacent panes. Adjacent panes are not converted to matrices, because light keeps its
/// polarisation between them, which matrices do not contain.
enum LayerRun {
    Panes(Vec<Pane>),
    Other(Box<dyn OpticalModel>),
}

impl LayerRun {
    fn into_model(self) -> Box<dyn OpticalModel> {
        match self {
            Self::Panes(layers) => Box::new(Panes { layers }),
            Self::Other(model) => model,
        }
    }

    /// Rotates the layer by 90° about its normal, which has no effect on panes.
    fn turn(&mut self) {
        if let Self::Other(_) = self
            && let Self::Other(model) = std::mem::replace(self, Self::Panes(Vec::new()))
        {
            *self = Self::Other(Box::new(Upright(model)));
        }
    }
}

impl Described {
    /// Returns the keys of the system's states; for a stack with a moving layer, those of that layer.
    pub fn states(&self, library: &dyn LayerLibrary) -> Result<Vec<String>, StudyError> {
        self.states_within(library, 0)
    }

    /// Returns the keys of the system's states. `depth`: level of nesting of descriptions so far.
    fn states_within(&self, library: &dyn LayerLibrary, depth: usize) -> Result<Vec<String>, StudyError> {
        let SystemKind::Stack(layers) = &self.file.system.kind else { return Ok(self.file.system.states()) };
        let Some(layer) = layers.iter().find(|layer| layer.state == EACH_STATE) else { return Ok(vec![String::new()]) };
        match &layer.source {
            LayerSource::File(name) if is_system_file(name) => {
                not_too_deep(depth)?;
                self.other(name)?.states_within(library, depth + 1)
            }
            LayerSource::File(name) => {
                let systems = library.load_file(&self.folder().join(name))?;
                Ok(systems.iter().map(|system| system.state.clone()).collect())
            }
            LayerSource::Text(text) => {
                not_too_deep(depth)?;
                self.within(text)?.states_within(library, depth + 1)
            }
            LayerSource::Catalogue(key) => {
                Ok(library.product(key)?.states.into_iter().map(|state| state.key).collect())
            }
        }
    }

    /// Creates the optical model of one state for visible light.
    pub fn optical_model(&self, state: &str, library: &dyn LayerLibrary) -> Result<Box<dyn OpticalModel>, StudyError> {
        self.optical_model_in(BandName::Visible, state, library)
    }

    /// Creates the optical model of one state in a spectral band. Visible properties are used where solar ones are
    /// missing, see [`Self::materials`].
    pub fn optical_model_in(
        &self,
        band: BandName,
        state: &str,
        library: &dyn LayerLibrary,
    ) -> Result<Box<dyn OpticalModel>, StudyError> {
        let mut layers = Vec::new();
        self.layers_into(&mut layers, (band, state), library, 0)?;
        let mut ready: Vec<Box<dyn OpticalModel>> = layers.into_iter().map(LayerRun::into_model).collect();
        Ok(match ready.len() {
            1 => ready.pop().expect("counted"),
            _ => Box::new(Stack::new(ready)),
        })
    }

    /// Appends the layers of this system to a list; of a stack all its layers, so that a stack within a stack is solved
    /// together with it, on the same cells. `depth`: level of nesting so far.
    fn layers_into(
        &self,
        list: &mut Vec<LayerRun>,
        (band, state): (BandName, &str),
        library: &dyn LayerLibrary,
        depth: usize,
    ) -> Result<(), StudyError> {
        let system = &self.file.in_band(band);
        let SystemKind::Stack(layers) = &system.kind else {
            let made = system.optical_model(state).map_err(|error| StudyError::key("state", error.to_string()))?;
            match (&system.kind, list.last_mut()) {
                (SystemKind::Pane(pane), Some(LayerRun::Panes(before))) => before.extend(pane.layers()),
                (SystemKind::Pane(pane), _) => list.push(LayerRun::Panes(pane.layers())),
                _ => list.push(LayerRun::Other(made)),
            }
            return Ok(());
        };
        not_too_deep(depth)?;
        let moving = layers.iter().any(|layer| layer.state == EACH_STATE);
        if !moving && !state.is_empty() {
            return Err(StudyError::key("state", "a stack without a moving layer has no states"));
        }
        let first = list.len();
        for layer in layers {
            self.layer_into(list, layer, (band, state), library, depth)?;
            if list.len() > MOST_LAYERS {
                return Err(StudyError::key("stack.layers", format!("more than {MOST_LAYERS} layers in all")));
            }
        }
        if system.upright {
            list[first..].iter_mut().for_each(LayerRun::turn);
        }
        Ok(())
    }

    fn layer_into(
        &self,
        list: &mut Vec<LayerRun>,
        layer: &Layer,
        (band, state): (BandName, &str),
        library: &dyn LayerLibrary,
        depth: usize,
    ) -> Result<(), StudyError> {
        let state = if layer.state == EACH_STATE { state } else { &layer.state };
        match self.described_layer(layer)? {
            Some(described) => described.layers_into(list, (band, state), library, depth + 1),
            None => {
                let data = self.data_layer(layer, state, library)?;
                list.push(LayerRun::Other(Box::new(DataLayer(data.dataset.band(band).clone()))));
                Ok(())
            }
        }
    }

    /// Returns the description of a layer; `None` for a layer that is known only by its data.
    fn described_layer(&self, layer: &Layer) -> Result<Option<Self>, StudyError> {
        match &layer.source {
            LayerSource::File(name) if is_system_file(name) => self.other(name).map(Some),
            LayerSource::Text(text) => self.within(text).map(Some),
            LayerSource::File(_) | LayerSource::Catalogue(_) => Ok(None),
        }
    }

    /// Returns the system of a layer that is known only by its data.
    fn data_layer(&self, layer: &Layer, state: &str, library: &dyn LayerLibrary) -> Result<Arc<System>, StudyError> {
        let state = (!state.is_empty()).then(|| state.to_owned());
        let keys = match &layer.source {
            LayerSource::Catalogue(key) => SystemKeys::Catalogue { key: key.clone(), state },
            LayerSource::File(name) | LayerSource::Text(name) => SystemKeys::File { path: name.into(), state },
        };
        library.load(&keys, self.folder(), Need::Everything)
    }

    /// Returns two numbers for a state: materials with known solar properties, and all materials; a layer known by data
    /// counts as one.
    pub fn materials(&self, state: &str, library: &dyn LayerLibrary) -> Result<[usize; 2], StudyError> {
        self.materials_within(state, library, 0)
    }

    /// Returns the number of materials with known solar properties, and of all materials. `depth`: level of nesting of
    /// descriptions so far.
    fn materials_within(
        &self,
        state: &str,
        library: &dyn LayerLibrary,
        depth: usize,
    ) -> Result<[usize; 2], StudyError> {
        let SystemKind::Stack(layers) = &self.file.system.kind else { return Ok(self.file.materials) };
        not_too_deep(depth)?;
        let mut sum = [0; 2];
        for layer in layers {
            let state = if layer.state == EACH_STATE { state } else { &layer.state };
            let own = match self.described_layer(layer)? {
                Some(described) => described.materials_within(state, library, depth + 1)?,
                None => match self.data_layer(layer, state, library)?.dataset.solar_source_of_all() {
                    SolarSource::Own => [1, 1],
                    SolarSource::Partly => [1, 2],
                    SolarSource::Visible => [0, 1],
                },
            };
            sum = [sum[0] + own[0], sum[1] + own[1]];
        }
        Ok(sum)
    }
}

fn not_too_deep(depth: usize) -> Result<(), StudyError> {
    let too_deep = || StudyError::key("stack.layers", format!("stacks within stacks, more than {MOST_NESTED}"));
    (depth < MOST_NESTED).then_some(()).ok_or_else(too_deep)
}
