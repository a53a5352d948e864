//! Light that the apertures of a scene send into the room.

use super::Session;
use super::behind::Split;
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::lid::Emission;
use crate::study::error::StudyError;
use crate::study::scene::Scene;

/// Light that all apertures of a scene send into the room.
pub(super) struct Lights {
    /// Light of every aperture as a whole.
    pub emissions: Vec<Emission>,
    /// Light of every aperture in parts that see different outsides; empty without obstructions.
    pub splits: Vec<Split>,
}

impl Session {
    /// Computes the light that all apertures send into the room.
    pub(super) fn lights(&self, scene: &Scene, progress: &dyn Progress) -> Result<Lights, StudyError> {
        let splits = self.splits(scene, progress)?;
        let emissions = if splits.is_empty() {
            (0..scene.apertures.len()).map(|index| self.emission(scene, index)).collect()
        } else {
            splits.iter().map(|split| split.whole.clone()).collect()
        };
        Ok(Lights { emissions, splits })
    }
}

impl Lights {
    /// Returns the luminous flux that enters the room through one aperture. \[lm\]
    pub fn flux_through(&self, scene: &Scene, index: usize) -> Estimate {
        let exitance = match self.splits.get(index) {
            Some(split) => split.exitance,
            None => self.emissions[index].exitance(&scene.facing(index)),
        };
        exitance * scene.apertures[index].aperture.area()
    }

    /// Returns the luminous flux that enters the room through all apertures. \[lm\]
    pub fn flux(&self, scene: &Scene) -> Estimate {
        (0..self.emissions.len()).map(|index| self.flux_through(scene, index)).sum()
    }
}
