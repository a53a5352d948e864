//! Light that reaches the sensors after at least one reflection.

use super::{STEPS, Session, aperture_key, basis_key, check, sensor_key};
use crate::compute::basis::RingBasis;
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::lid::Emission;
use crate::compute::room::first_bounce::{FirstLight, PatchWeights};
use crate::compute::room::gather::{polygon_factor, reconstructing_factors};
use crate::compute::room::mesh::{Mesh, Nested};
use crate::compute::room::radiosity::{Radiosity, dot};
use crate::study::cache::{Key, bits};
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use rayon::prelude::*;
use std::sync::Arc;

/// Numbers of fine patches, tried one after the other until the stated error is small enough.
const PATCHES: [usize; 4] = [640, 1500, 3200, 6400];

/// Of the differences between the two densities, wall by wall (their sum may cancel), what the extrapolated result may
/// be off. Chosen with [`REST`] so that 99 % of the sensors of 57 rooms against ten times finer meshes are covered, and
/// verified on 24 other rooms.
const DIFFERENCE: f64 = 1.6;

/// Number of fine patches times the relative error that both densities share: sampling of the first light.
const REST: f64 = 3.0;

/// What a scene that names no error gets. \[relative\]
const ORDINARY_TARGET: f64 = 0.01;

impl Session {
    /// Interreflected light at every sensor, and the largest gap of flux before it was closed. Refines until the stated
    /// error of the total is 0.7 of what is asked for at every sensor that matters, or the finest mesh is reached.
    pub(super) fn interreflected(
        &self,
        scene: &Scene,
        emissions: &[Emission],
        direct: &[Estimate],
        progress: &dyn Progress,
    ) -> Result<(Vec<Estimate>, f64), StudyError> {
        let target = scene.error_target.unwrap_or(ORDINARY_TARGET);
        // A scene that names no error does not wait seconds for it in an extreme room: what was reached is stated.
        let turns = if scene.error_target.is_some() { PATCHES.len() } else { 2 };
        let mut result = (Vec::new(), 0.0);
        for (turn, count) in PATCHES.into_iter().take(turns).enumerate() {
            check(progress)?;
            progress.advance("interreflection", (2 + turn).min(STEPS - 1), STEPS);
            result = self.reflected(scene, emissions, count, progress)?;
            let total = |i: usize| direct[i].value + result.0[i].value;
            let mean = (0..direct.len()).map(total).sum::<f64>() / direct.len() as f64;
            let stated = |i: usize| direct[i].error + result.0[i].error;
            let reached = |i: usize| stated(i) <= 0.7 * target * total(i).max(0.1 * mean);
            if (0..direct.len()).all(reached) {
                break;
            }
        }
        progress.advance("interreflection", STEPS, STEPS);
        Ok(result)
    }

    /// With about so many fine patches.
    fn reflected(
        &self,
        scene: &Scene,
        emissions: &[Emission],
        count: usize,
        progress: &dyn Progress,
    ) -> Result<(Vec<Estimate>, f64), StudyError> {
        let key = room_key(scene, count);
        let geometry: Vec<_> = scene.apertures.iter().map(|a| a.aperture).collect();
        let radiosity = self.rooms.get(key.clone(), || {
            let reflectances: Vec<f64> = scene.apertures.iter().map(|a| a.reflectance).collect();
            Radiosity::new(Nested::with_about(&scene.room, &geometry, &reflectances, count)?).map_err(StudyError::from)
        })?;
        check(progress)?;
        let mesh = &radiosity.nested.fine;
        let mut gather_key = key.clone();
        gather_key.extend(sensor_key(scene));
        let gather = self.gather.get(gather_key, || {
            let weights = scene.sensors.par_iter().map(|s| {
                [mesh, &radiosity.nested.coarse].map(|mesh| reconstructing_factors(mesh, s.position, s.normal))
            });
            Ok::<_, StudyError>(weights.collect())
        })?;
        let mut first = FirstLight::dark(mesh.patches.len());
        for (index, emission) in emissions.iter().enumerate() {
            check(progress)?;
            let weights = |basis: &Arc<RingBasis>| {
                let mut key = key.clone();
                key.push(index as u64);
                key.extend(basis_key(Some(basis)));
                let compute = || {
                    let weights = PatchWeights::new(mesh, &geometry[index], Arc::clone(basis));
                    Ok::<_, std::convert::Infallible>(weights)
                };
                match self.patches.get(key, compute) {
                    Ok(weights) => weights,
                    Err(never) => match never {},
                }
            };
            first.add(&radiosity, index, &geometry[index], emission, &scene.facing(index), &weights);
        }
        check(progress)?;
        let all: Vec<f64> = first.diffuse.iter().zip(&first.beam).map(|(d, b)| d + b).collect();
        // The beam's first reflection comes from sharp outlines, and has a closed form at every sensor.
        let exitance = radiosity.exitance(&all, &first.beam);
        // What is not known of the emission is not known of its reflections.
        let emitted: Estimate = emissions
            .iter()
            .enumerate()
            .map(|(index, emission)| emission.exitance(&scene.facing(index)) * geometry[index].area())
            .sum();
        let emitted_error = if emitted.value > 0.0 { emitted.error / emitted.value } else { 0.0 };
        let estimates = scene
            .sensors
            .par_iter()
            .zip(gather.par_iter())
            .map(|(sensor, [fine, coarse])| {
                let outlines: f64 = first
                    .outlines
                    .iter()
                    .map(|(wall, outline, exitance)| {
                        exitance * polygon_factor(&mesh.walls[*wall], outline, sensor.position, sensor.normal)
                    })
                    .sum();
                let (mut value, mut difference, mut squares) = (0.0, 0.0, 0.0_f64);
                for (a, b) in spans(mesh).into_iter().zip(spans(&radiosity.nested.coarse)) {
                    let by_fine = dot(&fine[a.clone()], &exitance.fine[a]);
                    let by_coarse = dot(&coarse[b.clone()], &exitance.coarse[b]);
                    value += by_fine;
                    difference += by_fine - by_coarse;
                    squares += (by_fine - by_coarse).powi(2);
                }
                let value = (value + difference / 3.0 + outlines).max(0.0);
                let rest = (REST / mesh.patches.len() as f64).hypot(0.5 * first.gap) * value;
                Estimate::new(value, (DIFFERENCE * squares.sqrt()).hypot(rest) + emitted_error * value)
            })
            .collect();
        Ok((estimates, first.gap))
    }
}

/// What a meshed room depends on.
fn room_key(scene: &Scene, count: usize) -> Key {
    let mut key = vec![count as u64];
    key.extend(bits(scene.room.size.to_array()));
    key.extend(bits([scene.room.floor, scene.room.walls, scene.room.ceiling]));
    for index in 0..scene.apertures.len() {
        key.extend(aperture_key(scene, index));
        key.push(scene.apertures[index].reflectance.to_bits());
    }
    key
}

/// The patches of every wall.
fn spans(mesh: &Mesh) -> Vec<std::ops::Range<usize>> {
    let firsts: Vec<usize> = mesh.walls.iter().map(|wall| wall.first).chain([mesh.patches.len()]).collect();
    firsts.windows(2).map(|pair| pair[0]..pair[1]).collect()
}
