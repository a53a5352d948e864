//! Light that reaches the sensors after at least one reflection.

use super::{STEPS, Session, aperture_key, basis_key, check, sensor_key};
use crate::compute::basis::RingBasis;
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::lid::Emission;
use crate::compute::room::first_bounce::{PatchWeights, first_illuminance};
use crate::compute::room::mesh::Mesh;
use crate::compute::room::radiosity::Radiosity;
use crate::study::cache::bits;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use rayon::prelude::*;
use std::sync::Arc;

/// Numbers of patches of the two meshes whose results are extrapolated, by the relative error asked for.
const fn patches(error_target: Option<f64>) -> [usize; 2] {
    match error_target {
        Some(target) if target < 1e-3 => [900, 3600],
        Some(target) if target < 4e-3 => [450, 1800],
        _ => [220, 900],
    }
}

impl Session {
    /// Two meshes, extrapolated to none (the error of patches of constant exitance is of second order in their size).
    pub(super) fn interreflected(
        &self,
        scene: &Scene,
        emissions: &[Emission],
        progress: &dyn Progress,
    ) -> Result<(Vec<Estimate>, f64), StudyError> {
        let mut levels = Vec::with_capacity(2);
        let mut gap = 0.0_f64;
        let counts = patches(scene.error_target);
        for (level, count) in counts.into_iter().enumerate() {
            check(progress)?;
            let (illuminances, level_gap) = self.level(scene, emissions, count, 3 - level, progress)?;
            levels.push(illuminances);
            gap = gap.max(level_gap);
            progress.advance("interreflection", 3 + level, STEPS);
        }
        // What extrapolation leaves: of the order of a permille with 900 patches, falling with their area.
        let rest = 0.9 / counts[1] as f64;
        let estimates = levels[0]
            .iter()
            .zip(&levels[1])
            .map(|(coarse, fine)| {
                let value = (fine + (fine - coarse) / 3.0).max(0.0);
                // More than what was added: near the opening the first order is not yet all of the error.
                Estimate::new(value, (fine - coarse).abs() / 2.0 + (rest + 0.2 * gap) * value)
            })
            .collect();
        Ok((estimates, gap))
    }

    fn level(
        &self,
        scene: &Scene,
        emissions: &[Emission],
        count: usize,
        order: usize,
        progress: &dyn Progress,
    ) -> Result<(Vec<f64>, f64), StudyError> {
        let mut room_key = vec![count as u64];
        room_key.extend(bits(scene.room.size.to_array()));
        room_key.extend(bits([scene.room.floor, scene.room.walls, scene.room.ceiling]));
        for index in 0..scene.apertures.len() {
            room_key.extend(aperture_key(scene, index));
            room_key.push(scene.apertures[index].reflectance.to_bits());
        }
        let geometry: Vec<_> = scene.apertures.iter().map(|a| a.aperture).collect();
        let reflectances: Vec<f64> = scene.apertures.iter().map(|a| a.reflectance).collect();
        let radiosity = self.rooms.get(room_key.clone(), || {
            let mesh = Mesh::with_about(&scene.room, &geometry, &reflectances, count)?;
            Radiosity::new(mesh).map_err(StudyError::from)
        })?;
        check(progress)?;
        let mut gather_key = room_key.clone();
        gather_key.extend(sensor_key(scene));
        let gather = self.gather.get(gather_key, || {
            Ok::<_, StudyError>(
                scene.sensors.par_iter().map(|s| radiosity.gather_weights(s.position, s.normal)).collect(),
            )
        })?;
        let mut first = vec![0.0; radiosity.mesh.patches.len()];
        let mut gap = 0.0_f64;
        for (index, emission) in emissions.iter().enumerate() {
            check(progress)?;
            let facing = scene.facing(index);
            let weights = |basis: &Arc<RingBasis>| {
                let mut key = room_key.clone();
                key.extend([index as u64, order as u64]);
                key.extend(basis_key(Some(basis)));
                let compute = || {
                    Ok::<_, std::convert::Infallible>(PatchWeights::new(
                        &radiosity.mesh,
                        &geometry[index],
                        Arc::clone(basis),
                        order,
                    ))
                };
                match self.patches.get(key, compute) {
                    Ok(weights) => weights,
                    Err(never) => match never {},
                }
            };
            let (part, part_gap) = first_illuminance(&radiosity, index, &geometry[index], emission, &facing, &weights);
            gap = gap.max(part_gap);
            for (sum, e) in first.iter_mut().zip(part) {
                *sum += e;
            }
        }
        check(progress)?;
        let exitance = radiosity.exitance(&first);
        let at_sensors =
            gather.par_iter().map(|weights| weights.iter().zip(&exitance).map(|(w, b)| w * b).sum()).collect();
        Ok((at_sensors, gap))
    }
}
