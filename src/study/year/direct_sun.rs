//! Illuminance at the sensors by direct sun alone: sunlight that the apertures transmit without scattering, past
//! skyline and boxes. Sky, ground and reflections are left out.

use crate::compute::estimate::Estimate;
use crate::compute::lid::{BeamLight, Facing, SunThrough};
use crate::compute::room::beams_past::beams_past;
use crate::compute::room::direct::{Sensor, beams_through};
use crate::compute::sky::Sun;
use crate::compute::surroundings::Surroundings;
use crate::compute::surroundings::solid::Solid;
use crate::study::error::StudyError;
use crate::study::outside::boxes;
use crate::study::scene::Scene;
use crate::study::scene_file::SceneFile;
use std::sync::Arc;

/// Scene with fixed states, for the illuminance by direct sun at any position of the sun.
pub(super) struct DirectSun {
    scene: Arc<Scene>,
    /// Boxes outside that obstruct the sun; `None` if there are none.
    around: Option<Surroundings>,
}

impl DirectSun {
    /// Creates the computation for a scene. `file`: scene file with the boxes outside.
    ///
    /// # Errors
    /// Returns an error if a box is not valid.
    pub fn new(scene: Arc<Scene>, file: &SceneFile) -> Result<Self, StudyError> {
        let turn = scene.orientation.turn();
        let solids: Vec<Solid> = boxes(file, &scene.room)?.iter().map(|(solid, _)| solid.turned(turn)).collect();
        let around = (!solids.is_empty()).then(|| Surroundings::dark(solids, None));
        Ok(Self { scene, around })
    }

    /// Returns the number of sensors.
    pub fn places(&self) -> usize {
        self.scene.sensors.len()
    }

    /// Whether any aperture can transmit sunlight unscattered. Systems that are known by patch-averaged data alone do
    /// not.
    pub fn passes(&self) -> bool {
        let scene = &*self.scene;
        let described = |index: usize| scene.beams && scene.apertures[index].system.model.is_some();
        let regular = |index: usize| scene.apertures[index].transmission().is_some_and(|btdf| btdf.regular.is_some());
        (0..scene.apertures.len()).any(|index| described(index) || regular(index))
    }

    /// Computes the illuminance by direct sun at every sensor, for each aperture, reduced by frame and dirt. \[lx\]
    pub fn by_aperture(&self, sun: &Sun) -> Vec<Vec<Estimate>> {
        let scene = &*self.scene;
        let of = |index: usize| {
            let aperture = &scene.apertures[index].aperture;
            let facing = Facing { sun: Some(sun), ..scene.facing(index) };
            let beams = self.beams(index, &facing);
            let at = |sensor: &Sensor| {
                let seen = match &self.around {
                    Some(around) => beams_past(sensor, aperture, &[], &[], &beams, &facing, around),
                    None => beams_through(sensor, aperture, &beams, &facing),
                };
                seen.all + Estimate::new(0.0, seen.data_error)
            };
            scene.sensors.iter().map(at).collect()
        };
        (0..scene.apertures.len()).map(of).collect()
    }

    /// Computes the illuminance by direct sun at every sensor, through all apertures together. \[lx\]
    pub fn at(&self, sun: &Sun) -> Vec<f64> {
        let mut sums = vec![0.0; self.scene.sensors.len()];
        for aperture in self.by_aperture(sun) {
            sums.iter_mut().zip(aperture).for_each(|(sum, e)| *sum += e.value);
        }
        sums
    }

    /// Returns the beams of sunlight that leave an aperture unscattered and undeviated.
    fn beams(&self, index: usize, facing: &Facing<'_>) -> Vec<BeamLight> {
        let one = &self.scene.apertures[index];
        let beams = match one.system.model.as_ref().filter(|_| self.scene.beams) {
            Some(model) => SunThrough::beams_alone(model.0.as_ref(), facing).beams().to_vec(),
            None => {
                let regular = one.transmission().and_then(|btdf| btdf.regular.as_ref());
                BeamLight::regular(regular, facing).into_iter().collect()
            }
        };
        beams.into_iter().filter(|beam| beam.straight).map(|beam| beam.scaled(one.clear)).collect()
    }
}
