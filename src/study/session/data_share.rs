//! What the data leave open of sky and ground at the sensors, as shares: for skies of which there are thousands.

use super::Session;
use crate::compute::estimate::Progress;
use crate::study::error::StudyError;
use crate::study::scene::Scene;

/// Of one aperture.
#[derive(Debug, Clone, Default)]
pub struct DataShare {
    /// Sensor by sensor, of what comes straight; empty where nothing is open.
    pub direct: Vec<f64>,
    /// Of what the room makes of it.
    pub reflected: f64,
}

impl Session {
    /// The shares under the scene's own sky, aperture by aperture; `known`: of these the doubts on cells are known
    /// otherwise.
    ///
    /// # Errors
    /// Cancelled.
    pub(in crate::study) fn data_shares(
        &self,
        scene: &Scene,
        known: impl Fn(usize) -> bool,
        progress: &dyn Progress,
    ) -> Result<Vec<DataShare>, StudyError> {
        let of = |index: usize| {
            let mut own = Scene { sun: None, ..scene.clone() };
            own.apertures = vec![scene.apertures[index].clone()];
            let mut lights = self.lights(&own)?;
            let emission = &mut lights.emissions[0];
            if known(index) {
                emission.cells.iter_mut().for_each(|light| light.doubts.clear());
            }
            if !emission.is_doubted() {
                return Ok(DataShare::default());
            }
            let open = emission.exitance_doubt() * own.apertures[0].aperture.area();
            let direct = if lights.splits.is_empty() {
                self.direct(&own, &lights.emissions, progress)?
            } else {
                self.direct_behind(&own, &lights.splits, progress)?
            };
            let share = |value: f64, open: f64| if value > 0.0 { open / value } else { 0.0 };
            Ok(DataShare {
                direct: direct.iter().map(|one| share(one.all.value, one.data_error)).collect(),
                reflected: share(lights.flux(&own).value, open),
            })
        };
        (0..scene.apertures.len()).map(of).collect()
    }
}
