//! The sun straight at the sensors: what comes through the apertures without being scattered, past skyline and boxes. No
//! sky, no ground, no reflection.

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

/// A scene whose states are fixed, ready for any sun.
pub(super) struct DirectSun {
    scene: Arc<Scene>,
    /// Boxes that hide the sun; `None` where there are none.
    around: Option<Surroundings>,
}

impl DirectSun {
    /// Of a scene, and of the boxes before it.
    ///
    /// # Errors
    /// Boxes that cannot be.
    pub fn new(scene: Arc<Scene>, file: &SceneFile) -> Result<Self, StudyError> {
        let turn = scene.orientation.turn();
        let solids: Vec<Solid> = boxes(file, &scene.room)?.iter().map(|(solid, _)| solid.turned(turn)).collect();
        let around = (!solids.is_empty()).then(|| Surroundings::dark(solids, None));
        Ok(Self { scene, around })
    }

    /// Number of sensors.
    pub fn places(&self) -> usize {
        self.scene.sensors.len()
    }

    /// May an aperture let the sun through unscattered? What is known by cells alone lets none.
    pub fn passes(&self) -> bool {
        let scene = &*self.scene;
        let described = |index: usize| scene.beams && scene.apertures[index].system.very.is_some();
        let regular = |index: usize| scene.apertures[index].transmission().is_some_and(|btdf| btdf.regular.is_some());
        (0..scene.apertures.len()).any(|index| described(index) || regular(index))
    }

    /// Of every aperture at every sensor, frame and dirt counted. \[lx\]
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

    /// Of all apertures at every sensor. \[lx\]
    pub fn at(&self, sun: &Sun) -> Vec<f64> {
        let mut sums = vec![0.0; self.scene.sensors.len()];
        for aperture in self.by_aperture(sun) {
            sums.iter_mut().zip(aperture).for_each(|(sum, e)| *sum += e.value);
        }
        sums
    }

    /// What goes on unscattered and undeviated behind an aperture.
    fn beams(&self, index: usize, facing: &Facing<'_>) -> Vec<BeamLight> {
        let one = &self.scene.apertures[index];
        let beams = match one.system.very.as_ref().filter(|_| self.scene.beams) {
            Some(very) => SunThrough::beams_alone(very.0.as_ref(), facing).beams().to_vec(),
            None => {
                let regular = one.transmission().and_then(|btdf| btdf.regular.as_ref());
                BeamLight::regular(regular, facing).into_iter().collect()
            }
        };
        beams.into_iter().filter(|beam| beam.straight).map(|beam| beam.scaled(one.clear)).collect()
    }
}
