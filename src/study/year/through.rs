//! Solar transmittances of the systems in a scene's apertures, each computed once.

use crate::catalogue::stated_error;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{BandName, Btdf, SolarSource};
use crate::compute::year::transmittance::{Between, DirectionalTransmittance};
use crate::study::error::StudyError;
use crate::study::scene_file::SystemKeys;
use crate::study::system::{Need, System, SystemLibrary};
use std::path::Path;
use std::sync::Arc;

/// Solar transmittance of a system in one state, prepared for diffuse and direct radiation.
pub(super) struct Passage {
    /// Solar transmittance by incident direction.
    pub tau: DirectionalTransmittance,
    /// Source of the solar properties.
    pub source: SolarSource,
    /// Basis of incident directions by which diffuse radiation is integrated.
    pub cells: RingBasis,
    /// Mean transmittance of each cell of this basis.
    pub by_cell: Vec<f64>,
    /// Errors of integrating by cells, in a façade and in a roof, relative to the transmitted diffuse radiation.
    pub judged: [f64; 2],
}

/// Solar transmittance of a system by incident direction, and the source of its solar properties.
pub(super) struct Found {
    pub tau: DirectionalTransmittance,
    pub source: SolarSource,
}

/// Collection of the solar transmittances of a scene's systems.
pub(super) struct DirectSolar<'a> {
    library: &'a dyn SystemLibrary,
    base: &'a Path,
    keys: Vec<SystemKeys>,
    found: Vec<Found>,
}

impl<'a> DirectSolar<'a> {
    /// Creates an empty collection. `base`: folder to which file names of systems are relative.
    pub fn new(library: &'a dyn SystemLibrary, base: &'a Path) -> Self {
        Self { library, base, keys: Vec::new(), found: Vec::new() }
    }

    /// Returns the index of the solar transmittance of a system, which is computed if it is not in the collection yet.
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

    /// Returns all solar transmittances of the collection.
    pub fn found(self) -> Vec<Found> {
        self.found
    }

    /// Computes the solar transmittance of a system: by profile angle from its optical model if possible, else from its
    /// data.
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

/// Prepares solar transmittances for multiplication by received irradiances. `between`: interpolation between
/// directions of data.
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
