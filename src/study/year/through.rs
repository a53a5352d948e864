//! Solar transmittances of systems, each computed once.

use crate::catalogue::stated_error;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{BandName, Btdf, SolarSource};
use crate::compute::year::transmittance::{Between, DirectionalTransmittance};
use crate::study::error::StudyError;
use crate::study::scene_file::SystemKeys;
use crate::study::system::{Need, System, SystemLibrary};
use std::path::Path;
use std::sync::Arc;

/// Solar transmittance of a system in one state.
pub(super) struct Passage {
    /// Transmittance by direction.
    pub tau: DirectionalTransmittance,
    /// Source of the transmittance.
    pub source: SolarSource,
    /// Basis by which diffuse radiation is integrated.
    pub cells: RingBasis,
    /// Mean transmittance of each cell of the basis.
    pub by_cell: Vec<f64>,
    /// Errors of the integration by cells in a façade and in a roof, relative to the diffuse radiation.
    pub judged: [f64; 2],
}

/// Solar transmittance of a system, and the source of its solar properties.
pub(super) struct Found {
    pub tau: DirectionalTransmittance,
    pub source: SolarSource,
}

/// Solar transmittances of the systems of a scene.
pub(super) struct DirectSolar<'a> {
    library: &'a dyn SystemLibrary,
    base: &'a Path,
    keys: Vec<SystemKeys>,
    found: Vec<Found>,
}

impl<'a> DirectSolar<'a> {
    pub fn new(library: &'a dyn SystemLibrary, base: &'a Path) -> Self {
        Self { library, base, keys: Vec::new(), found: Vec::new() }
    }

    /// Returns the index of a system's transmittance.
    ///
    /// # Errors
    /// Returns an error if the library cannot load the system, or its data have no transmission.
    pub fn of(&mut self, keys: &SystemKeys) -> Result<usize, StudyError> {
        if let Some(known) = self.keys.iter().position(|other| other == keys) {
            return Ok(known);
        }
        let found = self.transmittance(keys)?;
        self.keys.push(keys.clone());
        self.found.push(found);
        Ok(self.keys.len() - 1)
    }

    /// Returns all transmittances.
    pub fn found(self) -> Vec<Found> {
        self.found
    }

    fn transmittance(&self, keys: &SystemKeys) -> Result<Found, StudyError> {
        let system = self.library.load(keys, self.base, Need::Light { lit: false })?;
        if let Some(model) = &system.model {
            let (solar, source) = model.solar();
            if let Some(tau) = DirectionalTransmittance::by_profile(solar) {
                return Ok(Found { tau, source });
            }
        }
        // Data of a described system are not computed before they are needed.
        let empty = |system: &System| {
            system.dataset.transmission().is_none_or(|btdf| btdf.regular.is_none() && btdf.scattered.is_none())
        };
        let system = if empty(&system) { self.library.load(keys, self.base, Need::Everything)? } else { system };
        of_data(&system)
    }
}

fn of_data(system: &Arc<System>) -> Result<Found, StudyError> {
    let dataset = &system.dataset;
    let btdf: &Btdf = dataset
        .transmission_of(BandName::Solar)
        .ok_or_else(|| StudyError::key("system", format!("'{}' has no transmission data", system.label)))?;
    // Measured data do not state their error: then only the interpolation between their directions is uncertain.
    let tau = DirectionalTransmittance::of_data(btdf, stated_error(dataset).unwrap_or(0.0));
    Ok(Found { tau, source: dataset.solar_source() })
}

/// Prepares transmittances for multiplication by received irradiances.
pub(super) fn ready(found: Vec<Found>, between: Between) -> Vec<Passage> {
    let of = |Found { tau, source }: Found| {
        let cells = tau.cells();
        // Values of the data's own cells are means already, whatever the interpolation.
        let own = if tau.knows_cells() { Between::Constant } else { between };
        let by_cell = tau.on(&cells, own);
        Passage { tau, source, cells, by_cell, judged: [0.0; 2] }
    };
    found.into_iter().map(of).collect()
}
