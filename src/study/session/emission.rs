//! Light that leaves an aperture on its room side: computed by the system's description for sunlight from the actual
//! sun position, and by its data for all other light. Results of both are stored.

use super::Session;
use crate::compute::btdf::{Btdf, CellMatrix, Dataset, Indicatrices, Scattered};
use crate::compute::lid::peaks::{self, Peaks};
use crate::compute::lid::{Emission, Facing, Interpolator, SkyThrough, SunThrough};
use crate::compute::system::measure::OpticalModel;
use crate::study::cache::bits;
use crate::study::scene::{Scene, SceneAperture};
use crate::study::scene_file::Interpolation;
use crate::study::system::SystemModel;
use std::sync::{Arc, Weak};

/// Result for an optical model, with a reference that keeps its address, the key of the result, from being used again.
pub(crate) type OfModel<T> = (Weak<dyn OpticalModel>, T);

impl Session {
    /// Computes the light that leaves an aperture on its room side under the scene's outside, reduced by frame and
    /// dirt.
    pub(crate) fn emission(&self, scene: &Scene, aperture: usize) -> Emission {
        self.emission_under(scene, aperture, &scene.facing(aperture))
    }

    /// Computes the light that leaves an aperture on its room side under a given outside and sun.
    pub(super) fn emission_under(&self, scene: &Scene, aperture: usize, facing: &Facing<'_>) -> Emission {
        if let Some(lamps) = &scene.apertures[aperture].lamps {
            return Emission::lamps(Arc::clone(lamps));
        }
        let clear = scene.apertures[aperture].clear;
        let emission = self.of_system(scene, aperture, facing);
        if clear == 1.0 { emission } else { emission.scaled(clear) }
    }

    fn of_system(&self, scene: &Scene, aperture: usize, facing: &Facing<'_>) -> Emission {
        let system = &scene.apertures[aperture].system;
        match system.model.as_ref().filter(|_| scene.beams) {
            Some(model) => {
                let mut emission = self.diffuse(scene, aperture, model, &Facing { sun: None, ..*facing });
                emission.add_sun_through(&self.sun_through(model, facing).1);
                emission
            }
            None => self.by_data(scene, aperture, facing),
        }
    }

    /// Computes the light that a described system emits under sky and ground.
    fn diffuse(&self, scene: &Scene, aperture: usize, model: &SystemModel, facing: &Facing<'_>) -> Emission {
        if !facing.outside.is_lit() {
            return Emission::dark();
        }
        if !model.answers_for_the_sky() {
            return self.by_data(scene, aperture, facing);
        }
        self.sky_through(model).1.emission(facing)
    }

    /// Returns the emergent light of a described system for each incident patch, computed or stored.
    pub(crate) fn sky_through(&self, model: &SystemModel) -> Arc<OfModel<SkyThrough>> {
        let key = vec![Arc::as_ptr(&model.0).cast::<()>() as u64];
        self.skies.find(key, || (Arc::downgrade(&model.0), SkyThrough::new(model.0.as_ref())))
    }

    /// Returns the light that a described system emits under the sun, computed or stored.
    fn sun_through(&self, model: &SystemModel, facing: &Facing<'_>) -> Arc<OfModel<SunThrough>> {
        let mut key = vec![Arc::as_ptr(&model.0).cast::<()>() as u64, facing.surface as u64];
        // Everything that decides how much of the disc is visible, and where.
        let edges = facing.sun_edges().map(|edge| edge.normal.extend(edge.offset).to_array());
        key.extend(bits(edges.into_iter().flatten()));
        if let (Some(sun), Some(direction)) = (facing.sun, facing.sun_direction()) {
            key.extend(bits(direction.vector().to_array()));
            key.extend(bits([sun.direct_normal]));
        }
        self.suns.find(key, || (Arc::downgrade(&model.0), SunThrough::new(model.0.as_ref(), facing)))
    }

    /// Computes the light that a system emits according to its data, under the whole outside.
    fn by_data(&self, scene: &Scene, aperture: usize, facing: &Facing<'_>) -> Emission {
        let one = &scene.apertures[aperture];
        let btdf = one.transmission().expect("a resolved scene has only systems with transmission data");
        let mut emission = self.scattered_by_data(scene, one, btdf, facing);
        if let (Some(_), Some(tau)) = (&one.separated, &btdf.regular) {
            emission.notes.push(format!(
                "data: regular transmission recognised, {:.1} % ± {:.1} % at normal incidence; sky, ground and sun are seen \
                 through it directly",
                100.0 * tau.at(0.0),
                100.0 * tau.uncertainty(0.0)
            ));
        }
        emission
    }

    /// Computes the scattered light that a system emits according to its data.
    fn scattered_by_data(&self, scene: &Scene, one: &SceneAperture, btdf: &Btdf, facing: &Facing<'_>) -> Emission {
        match &btdf.scattered {
            // Used as given.
            _ if scene.interpolation == Interpolation::Patch => Emission::new(btdf, facing),
            Some(Scattered::Directions(data)) => {
                let schemes = (scene.sun_interpolation, scene.diffuse_interpolation);
                Emission::interpolated(btdf, &self.interpolator(data), schemes, facing)
            }
            Some(Scattered::Cells(matrix)) => {
                let mut emission = Emission::new(btdf, facing);
                emission.estimate_patch_uncertainty();
                if emission.incident_sun > 0.0
                    && let Some(peaks) = self.peaks(one, matrix, facing)
                {
                    emission.take_peaks(&peaks.1, facing, scene.beams);
                }
                emission
            }
            Some(Scattered::Tree(tree)) => {
                let mut emission = Emission::new(btdf, facing);
                emission.estimate_patch_uncertainty();
                emission.estimate_leaf_uncertainty(tree, facing);
                emission
            }
            _ => Emission::new(btdf, facing),
        }
    }

    /// Returns the beams extracted from patch-averaged data for the position of the sun, computed or stored; `None` if
    /// there is no sun in front of the aperture.
    fn peaks(
        &self,
        one: &SceneAperture,
        matrix: &CellMatrix,
        facing: &Facing<'_>,
    ) -> Option<Arc<(Weak<Dataset>, Peaks)>> {
        let sun = facing.sun_entering()?;
        let dataset = &one.system.dataset;
        let mut key = vec![Arc::as_ptr(dataset) as u64, u64::from(one.separated.is_some())];
        if matrix.incident().len() > peaks::MOST_CELLS {
            key.extend(matrix.incident().index(sun).map(|cell| cell as u64));
        }
        Some(self.peaks.find(key, || (Arc::downgrade(dataset), Peaks::new(matrix, sun))))
    }

    /// Returns the interpolator between the incident directions of a dataset, created or stored.
    pub fn interpolator(&self, data: &Arc<Indicatrices>) -> Arc<Interpolator> {
        // The interpolator keeps the data alive, so that no others can have their address.
        self.interpolators.find(vec![Arc::as_ptr(data) as u64], || Interpolator::new(Arc::clone(data)))
    }
}
