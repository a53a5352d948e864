//! Interreflected light: light that reaches the sensors after at least one reflection in the room.

use super::lights::Lights;
use super::seen::{Gathered, gathered, in_blocks, inside, keeps};
use super::{STEPS, Session, aperture_key, basis_key, check, sensor_key};
use crate::compute::basis::RingBasis;
use crate::compute::dot::dot;
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::room::aperture::Aperture;
use crate::compute::room::back_reflection::{BackReflection, settled_light};
use crate::compute::room::exchange::Exchange;
use crate::compute::room::first_bounce::FirstLight;
use crate::compute::room::gather::Reconstruction;
use crate::compute::room::mesh::{Mesh, Nested, Wall};
use crate::compute::room::patch_weights::PatchWeights;
use crate::compute::room::radiosity::Radiosity;
use crate::study::cache::{Key, bits};
use crate::study::error::StudyError;
use crate::study::scene::{Scene, SceneAperture};
use crate::study::scene_file::ORDINARY_TARGET;
use rayon::prelude::*;
use std::sync::Arc;

/// Numbers of patches of the fine mesh, tried in this order until the stated error is small enough.
pub(crate) const PATCHES: [usize; 4] = [640, 1500, 3200, 6400];

/// Factor from the differences between the coarse and the fine mesh, taken wall by wall because their sum may cancel,
/// to the error of the extrapolated illuminance. Chosen together with [`REST`] and [`NEAR`] so that about 99 % of the
/// sensors of 81 rooms, 24 of them random, are within the error, compared with meshes of ten times as many patches.
const DIFFERENCE: f64 = 0.6;

/// Product of the number of fine patches and the relative error that both meshes share, by sampling the direct light on
/// the patches.
pub(crate) const REST: f64 = 3.0;

/// Share of the illuminance by slopes of the exitance over near patches that is taken as its error at a sensor.
const NEAR: f64 = 0.8;

/// Value of [`DIFFERENCE`] where the illuminance by slopes is not known separately.
pub(crate) const DIFFERENCE_ALONE: f64 = 1.6;

/// Relative error of the illuminance by light that an aperture reflects to a sensor, if the light on the aperture is
/// taken as uniform.
pub(crate) const UNEVEN: f64 = 0.1;

impl Session {
    /// Computes the interreflected illuminance at every sensor, and the largest relative gap of flux before it was
    /// closed. `lights`: light of all apertures; `direct`: direct illuminances. Refines the mesh until the stated error
    /// of the total illuminance is 0.6 of the error target at every sensor that is not dark (errors of single sensors
    /// exceed the stated ones), or until the finest mesh is reached.
    pub(super) fn interreflected(
        &self,
        scene: &Scene,
        lights: &Lights,
        direct: &[Estimate],
        progress: &dyn Progress,
    ) -> Result<(Vec<Estimate>, f64), StudyError> {
        let target = scene.error_target.unwrap_or(ORDINARY_TARGET);
        // A scene without an error target does not wait seconds for it in an extreme room: the error reached is
        // stated.
        let turns = if scene.error_target.is_some() { PATCHES.len() } else { 2 };
        let mut result = (Vec::new(), 0.0);
        for (turn, count) in PATCHES.into_iter().take(turns).enumerate() {
            check(progress)?;
            progress.advance("interreflection", (2 + turn).min(STEPS - 1), STEPS);
            result = self.reflected(scene, lights, count, progress)?;
            let total = |i: usize| direct[i].value + result.0[i].value;
            let mean = (0..direct.len()).map(total).sum::<f64>() / direct.len() as f64;
            let stated = |i: usize| direct[i].error + result.0[i].error;
            let reached = |i: usize| stated(i) <= 0.6 * target * total(i).max(0.1 * mean);
            if (0..direct.len()).all(reached) {
                break;
            }
        }
        progress.advance("interreflection", STEPS, STEPS);
        Ok(result)
    }

    /// Whether the solved room with the coarsest mesh is stored.
    pub(super) fn holds_room(&self, scene: &Scene) -> bool {
        self.rooms.holds(&room_key(scene, PATCHES[0]))
    }

    /// Returns the room with about `count` fine patches, with its interreflection solved (factored); computed or
    /// stored.
    pub(super) fn radiosity(&self, scene: &Scene, count: usize) -> Result<Arc<Radiosity>, StudyError> {
        self.rooms.get(room_key(scene, count), || {
            let geometry: Vec<_> = scene.apertures.iter().map(|a| a.aperture).collect();
            let reflectances: Vec<f64> = scene.apertures.iter().map(|a| a.diffuse_reflectance()).collect();
            let nested = Nested::with_about(&scene.room, &geometry, &reflectances, count)?;
            let key = |mesh: u64| mesh_key(scene, count).into_iter().chain([mesh]).collect();
            let level = self.exchanges.find(key(0), || Exchange::level(&nested));
            let coarser = self.exchanges.find(key(1), || level.coarser(&nested));
            Radiosity::new(nested, level, coarser).map_err(StudyError::from)
        })
    }

    /// Returns the weights with which every sensor sees the patches: stored, or, for more sensors than can be stored,
    /// to be computed again for each.
    fn gathered<'a>(&self, scene: &Scene, count: usize, radiosity: &'a Radiosity) -> Result<Gathered<'a>, StudyError> {
        let patches = radiosity.nested.fine.patches.len() + radiosity.nested.coarse.patches.len();
        // Weights and slopes.
        if keeps(scene, 2 * patches) {
            return self.gathering(scene, count, radiosity).map(Gathered::Kept);
        }
        Ok(Gathered::Recomputed([&radiosity.nested.fine, &radiosity.nested.coarse]))
    }

    /// Returns the weights with which every sensor sees the patches of the fine and the coarse mesh; computed or
    /// stored.
    pub(super) fn gathering(
        &self,
        scene: &Scene,
        count: usize,
        radiosity: &Radiosity,
    ) -> Result<Arc<Vec<[Reconstruction; 2]>>, StudyError> {
        let mut key = mesh_key(scene, count);
        key.extend(sensor_key(scene));
        self.gather.get(key, || {
            let weights = scene
                .sensors
                .par_iter()
                .map(|s| gathered(&[&radiosity.nested.fine, &radiosity.nested.coarse], &inside(scene, s)));
            Ok::<_, StudyError>(weights.collect())
        })
    }

    /// Returns the weights with which the patches of the room receive light from an aperture, or from a part of one, by
    /// the cells of a basis. `key`: key of the mesh in the caches.
    pub(super) fn patch_weights(
        &self,
        key: &Key,
        mesh: &Mesh,
        aperture: &Aperture,
        basis: &Arc<RingBasis>,
    ) -> Arc<PatchWeights> {
        let mut key = key.clone();
        key.extend(bits(aperture.corner.to_array()).chain(bits(aperture.size)));
        key.push(aperture.surface as u64);
        key.extend(basis_key(Some(basis)));
        self.patches.find(key, || PatchWeights::new(mesh, aperture, Arc::clone(basis)))
    }

    /// Computes the direct light of all apertures on the patches of the room, about `count` in the fine mesh.
    pub(super) fn first_light(
        &self,
        scene: &Scene,
        lights: &Lights,
        count: usize,
        progress: &dyn Progress,
    ) -> Result<FirstLight, StudyError> {
        let key = mesh_key(scene, count);
        let geometry: Vec<_> = scene.apertures.iter().map(|a| a.aperture).collect();
        let radiosity = self.radiosity(scene, count)?;
        let mesh = &radiosity.nested.fine;
        let mut first = FirstLight::dark(mesh.patches.len());
        for (index, split) in lights.splits.iter().enumerate() {
            check(progress)?;
            let of_part = |part: &Aperture, basis: &Arc<RingBasis>| self.patch_weights(&key, mesh, part, basis);
            split.add_to(&mut first, mesh, &geometry[index], &scene.facing(index), &of_part);
        }
        for (index, emission) in lights.emissions.iter().enumerate().filter(|_| lights.splits.is_empty()) {
            check(progress)?;
            let weights = |basis: &Arc<RingBasis>| self.patch_weights(&key, mesh, &geometry[index], basis);
            first.add(&radiosity, index, &geometry[index], emission, &scene.facing(index), &weights);
        }
        Ok(first)
    }

    /// Computes the interreflected illuminance at every sensor with about `count` fine patches, and the relative gap of
    /// flux.
    fn reflected(
        &self,
        scene: &Scene,
        lights: &Lights,
        count: usize,
        progress: &dyn Progress,
    ) -> Result<(Vec<Estimate>, f64), StudyError> {
        let key = mesh_key(scene, count);
        let geometry: Vec<_> = scene.apertures.iter().map(|a| a.aperture).collect();
        let radiosity = self.radiosity(scene, count)?;
        check(progress)?;
        let mesh = &radiosity.nested.fine;
        let gather = self.gathered(scene, count, &radiosity)?;
        let weights = |index: usize, basis: &Arc<RingBasis>| self.patch_weights(&key, mesh, &geometry[index], basis);
        let first = self.first_light(scene, lights, count, progress)?;
        check(progress)?;
        // Areas that beams light reflect as the sharp outlines that they are, to sensors and patches; the balance
        // begins with what these receive.
        let landing = first.landing(mesh);
        let gap = landing.as_ref().map_or(0.0, |landing| landing.gap).max(first.gap);
        let misplaced = first.misplaced;
        let mut all = first.diffuse;
        if let Some(landing) = &landing {
            all.iter_mut().zip(&landing.reflected).for_each(|(sum, e)| *sum += e);
        }
        let mut exitance = radiosity.exitance(&all);
        let mut room_side_reflection = vec![0.0; scene.sensors.len()];
        let mirrors = mirrors(scene, weights);
        if !mirrors.is_empty() {
            check(progress)?;
            let lit = landing.as_ref().map_or_else(|| vec![0.0; all.len()], |landing| landing.direct.clone());
            let luminances = settled_light(&radiosity, &geometry, &mirrors, &all, &lit, &mut exitance);
            for ((index, mirror), luminance) in mirrors.iter().zip(luminances) {
                let seen = self.seen(scene, *index, Some(&mirror.weights().basis), progress)?;
                let part = in_blocks(scene, "interreflection", progress, |s, sensor| {
                    Ok(dot(&seen.of(s, sensor).cells, &luminance))
                })?;
                room_side_reflection.iter_mut().zip(part).for_each(|(sum, e)| *sum += e);
            }
        }
        // The relative error of the emission is that of its reflections.
        let emitted = lights.flux(scene);
        let emitted_error = if emitted.value > 0.0 { emitted.error / emitted.value } else { 0.0 };
        let spans = [spans(mesh), spans(&radiosity.nested.coarse)];
        let estimates = in_blocks(scene, "interreflection", progress, |s, sensor| {
            let (own, room_side_reflection) = (gather.of(s, sensor), room_side_reflection[s]);
            let [fine, coarse] = &*own;
            let outlines =
                landing.as_ref().map_or(0.0, |landing| landing.light_at(mesh, sensor.position, sensor.normal));
            let (mut value, mut difference, mut squares) = (0.0, 0.0, 0.0_f64);
            for (a, b) in spans[0].iter().cloned().zip(spans[1].iter().cloned()) {
                let by_fine = dot(&fine.weights[a.clone()], &exitance.fine[a]);
                let by_coarse = dot(&coarse.weights[b.clone()], &exitance.coarse[b]);
                value += by_fine;
                difference += by_fine - by_coarse;
                squares += (by_fine - by_coarse).powi(2);
            }
            let value = (value + difference / 3.0 + outlines + room_side_reflection).max(0.0);
            // The outlines are seen in closed form.
            let rest = (REST / mesh.patches.len() as f64).hypot(gap).hypot(misplaced) * (value - outlines);
            let near = NEAR * fine.slopes.iter().map(|&(patch, slope)| slope * exitance.fine[patch]).sum::<f64>();
            Ok(Estimate::new(
                value,
                (DIFFERENCE * squares.sqrt()).hypot(rest).hypot(near)
                    + emitted_error * value
                    + UNEVEN * room_side_reflection,
            ))
        })?;
        Ok((estimates, gap))
    }
}

/// Returns the apertures that reflect by direction, each with its index. `weights`: returns the weights with which the
/// patches receive light from an aperture by the cells of a basis.
pub(super) fn mirrors<'a>(
    scene: &'a Scene,
    weights: impl Fn(usize, &Arc<RingBasis>) -> Arc<PatchWeights>,
) -> Vec<(usize, BackReflection<'a>)> {
    let reflecting = |(index, aperture): (usize, &'a SceneAperture)| {
        let matrix = aperture.back_reflection()?;
        Some((index, BackReflection::new(matrix, weights(index, &Arc::new(matrix.incident().clone())))))
    };
    scene.apertures.iter().enumerate().filter_map(reflecting).collect()
}

/// Returns the key of the room's patches in the caches, which does not depend on the reflectances.
pub(super) fn mesh_key(scene: &Scene, count: usize) -> Key {
    let mut key = vec![count as u64];
    key.extend(bits(scene.room.size.to_array()));
    (0..scene.apertures.len()).for_each(|index| key.extend(aperture_key(scene, index)));
    key
}

/// Returns the key of the room with its patches and reflectances in the caches.
pub(super) fn room_key(scene: &Scene, count: usize) -> Key {
    let mut key = mesh_key(scene, count);
    key.extend(bits([scene.room.floor, scene.room.walls, scene.room.ceiling]));
    key.extend(bits(scene.apertures.iter().map(SceneAperture::diffuse_reflectance)));
    key
}

/// Returns the range of patch indices for every wall.
pub(super) fn spans(mesh: &Mesh) -> Vec<std::ops::Range<usize>> {
    mesh.walls.iter().map(Wall::patches).collect()
}
