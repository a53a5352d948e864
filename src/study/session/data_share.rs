//! Uncertainty of diffuse illuminances by the BSDF data, as shares of the illuminances, for the skies of a year.

use super::Session;
use crate::compute::estimate::Progress;
use crate::study::error::StudyError;
use crate::study::scene::Scene;

/// Uncertainty of the diffuse illuminances by one aperture that is due to its BSDF data, relative to them.
#[derive(Debug, Clone, Default)]
pub struct DataShare {
    /// Relative uncertainty of the direct component, by sensor; empty if there is none.
    pub direct: Vec<f64>,
    /// Relative uncertainty of the interreflected component.
    pub reflected: f64,
}

impl Session {
    /// Computes the relative uncertainties under the scene's own sky, by aperture. `known`: whether the uncertainty of
    /// an aperture's light on the cells of its data is included elsewhere.
    ///
    /// # Errors
    /// Returns an error if cancelled.
    pub(crate) fn data_shares(
        &self,
        scene: &Scene,
        known: impl Fn(usize) -> bool,
        progress: &dyn Progress,
    ) -> Result<Vec<DataShare>, StudyError> {
        let of = |index: usize| {
            let mut own = Scene { sun: None, ..scene.clone() };
            own.apertures = vec![scene.apertures[index].clone()];
            let mut lights = self.lights(&own, progress)?;
            let emission = &mut lights.emissions[0];
            if known(index) {
                emission.cells.iter_mut().for_each(|light| light.uncertainties.clear());
            }
            if !emission.is_uncertain() {
                return Ok(DataShare::default());
            }
            let uncertainty = emission.exitance_uncertainty() * own.apertures[0].aperture.area();
            let direct = if lights.splits.is_empty() {
                self.direct(&own, &lights.emissions, progress)?
            } else {
                self.direct_behind(&own, &lights.splits, progress)?
            };
            let share = |value: f64, part: f64| if value > 0.0 { part / value } else { 0.0 };
            Ok(DataShare {
                direct: direct.iter().map(|one| share(one.all.value, one.data_error)).collect(),
                reflected: share(lights.flux(&own).value, uncertainty),
            })
        };
        (0..scene.apertures.len()).map(of).collect()
    }
}
