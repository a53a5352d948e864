//! Answers questions about scenes, and keeps between them what did not change: factored rooms, and what sensors and
//! surfaces see of each aperture. A new sky, time or product of the same basis costs only products with these.

mod interreflected;

use super::cache::{Cache, Key, bits};
use super::error::StudyError;
use super::plan::Plan;
use super::scene::Scene;
use crate::compute::basis::RingBasis;
use crate::compute::estimate::{Cancelled, Estimate, Progress};
use crate::compute::lid::{Emission, Lid};
use crate::compute::quadrature::Tolerance;
use crate::compute::room::direct::{self, Reception, Sensor};
use crate::compute::room::first_bounce::PatchWeights;
use crate::compute::room::gather::Reconstruction;
use crate::compute::room::radiosity::Radiosity;
use rayon::prelude::*;
use std::sync::Arc;
use std::time::Instant;

/// Relative accuracy asked of the cubature at every sensor. Its error estimate is on the safe side by two to three
/// digits, so that the ordinary value costs no digit that anyone sees.
fn cubature(error_target: Option<f64>) -> f64 {
    error_target.map_or(8e-5, |target| (0.03 * target).clamp(1e-10, 8e-5))
}

/// Steps that a room reports: emission, direct light, two meshes.
const STEPS: usize = 4;

/// What one sensor gets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorResult {
    /// Where.
    pub sensor: Sensor,
    /// Straight from the apertures, sun included. \[lx\]
    pub direct: Estimate,
    /// After at least one reflection. \[lx\]
    pub interreflected: Estimate,
}

impl SensorResult {
    /// Both together. \[lx\]
    pub fn total(&self) -> Estimate {
        self.direct + self.interreflected
    }
}

/// Illuminances of a scene.
#[derive(Debug, Clone)]
pub struct RoomResult {
    /// In the order of the scene.
    pub sensors: Vec<SensorResult>,
    /// Flux that enters through all apertures. \[lm\]
    pub flux: Estimate,
    /// Largest relative gap between the flux that leaves an aperture and the flux found on the surfaces, before it
    /// was closed; 0 without interreflection.
    pub flux_gap: f64,
    /// What ran, what was left out, and how long it took.
    pub plan: Plan,
}

/// The light of one aperture.
#[derive(Debug, Clone)]
pub struct LidResult {
    /// Its luminous-intensity distribution.
    pub lid: Lid,
    /// Luminous flux into the room. \[lm\]
    pub flux: Estimate,
    /// Illuminance of the outside face: diffuse, and by the sun. \[lx\]
    pub incident: (Estimate, f64),
}

/// Caches. One for the life of a program; shared between threads.
pub struct Session {
    rooms: Cache<Radiosity>,
    gather: Cache<Vec<[Reconstruction; 2]>>,
    reception: Cache<Vec<Reception>>,
    patches: Cache<PatchWeights>,
}

impl Default for Session {
    fn default() -> Self {
        Self::new()
    }
}

impl Session {
    /// Empty caches.
    pub const fn new() -> Self {
        Self { rooms: Cache::new(8), gather: Cache::new(8), reception: Cache::new(16), patches: Cache::new(24) }
    }

    /// The light of one aperture (eq 5). `aperture` counts from 0 and must exist.
    pub fn lid(&self, scene: &Scene, aperture: usize, progress: &dyn Progress) -> Result<LidResult, StudyError> {
        check(progress)?;
        let facing = scene.facing(aperture);
        let emission = emission(scene, aperture);
        let geometry = &scene.apertures[aperture].aperture;
        Ok(LidResult {
            lid: emission.lid(&facing, geometry.size),
            flux: emission.exitance(&facing) * geometry.area(),
            incident: (emission.incident_diffuse, emission.incident_sun),
        })
    }

    /// Illuminance at every sensor.
    pub fn room(&self, scene: &Scene, progress: &dyn Progress) -> Result<RoomResult, StudyError> {
        let mut plan = Plan::new(scene);
        let clock = Instant::now();
        let emissions: Vec<Emission> = (0..scene.apertures.len()).map(|index| emission(scene, index)).collect();
        let flux = emissions
            .iter()
            .enumerate()
            .map(|(i, emission)| emission.exitance(&scene.facing(i)) * scene.apertures[i].aperture.area())
            .sum();
        plan.spend("emission", clock.elapsed());
        check(progress)?;
        progress.advance("direct light", 1, STEPS);

        let clock = Instant::now();
        let direct = self.direct(scene, &emissions, progress)?;
        plan.spend("direct", clock.elapsed());
        progress.advance("interreflection", 2, STEPS);

        let clock = Instant::now();
        let (interreflected, flux_gap) = if plan.runs("interreflection") {
            self.interreflected(scene, &emissions, &direct, progress)?
        } else {
            (vec![Estimate::default(); scene.sensors.len()], 0.0)
        };
        plan.spend("interreflection", clock.elapsed());
        let sensors = scene
            .sensors
            .iter()
            .zip(direct.into_iter().zip(interreflected))
            .map(|(&sensor, (direct, interreflected))| SensorResult { sensor, direct, interreflected })
            .collect();
        Ok(RoomResult { sensors, flux, flux_gap, plan })
    }

    /// What every sensor receives from one aperture per luminance, on the cells of a basis.
    fn receptions(
        &self,
        scene: &Scene,
        index: usize,
        basis: Option<&RingBasis>,
        progress: &dyn Progress,
    ) -> Result<Arc<Vec<Reception>>, StudyError> {
        let aperture = &scene.apertures[index].aperture;
        let mut key = aperture_key(scene, index);
        key.extend(sensor_key(scene));
        key.extend(basis_key(basis));
        self.reception.get(key, || {
            scene
                .sensors
                .par_iter()
                .map(|sensor| {
                    check(progress)?;
                    Ok(Reception::new(sensor, aperture, basis))
                })
                .collect()
        })
    }

    fn direct(
        &self,
        scene: &Scene,
        emissions: &[Emission],
        progress: &dyn Progress,
    ) -> Result<Vec<Estimate>, StudyError> {
        let mut sums = vec![Estimate::default(); scene.sensors.len()];
        let relative = cubature(scene.error_target);
        for (index, emission) in emissions.iter().enumerate() {
            check(progress)?;
            let aperture = &scene.apertures[index].aperture;
            let facing = scene.facing(index);
            let basis = emission.cells.as_ref().map(|light| Arc::clone(&light.basis));
            let receptions = self.receptions(scene, index, basis.as_deref(), progress)?;
            // Dark corners are not chased beyond what anyone can see.
            let absolute = 1e-7 * (facing.outside.diffuse_horizontal());
            let tolerance = Tolerance { absolute, relative, max_pieces: 4000 };
            let part: Vec<Estimate> = scene
                .sensors
                .par_iter()
                .zip(receptions.par_iter())
                .map(|(sensor, reception)| {
                    check(progress)?;
                    Ok(direct::illuminance(sensor, aperture, reception, emission, &facing, tolerance))
                })
                .collect::<Result<_, StudyError>>()?;
            for (sum, e) in sums.iter_mut().zip(part) {
                *sum += e;
            }
        }
        Ok(sums)
    }
}

fn emission(scene: &Scene, aperture: usize) -> Emission {
    let system = &scene.apertures[aperture].system;
    let btdf = system.dataset.transmission().expect("a resolved scene has only systems with transmission data");
    Emission::new(btdf, &scene.facing(aperture))
}

fn check(progress: &dyn Progress) -> Result<(), Cancelled> {
    if progress.cancelled() { Err(Cancelled) } else { Ok(()) }
}

fn aperture_key(scene: &Scene, index: usize) -> Key {
    let aperture = &scene.apertures[index].aperture;
    let mut key = vec![aperture.surface as u64];
    key.extend(bits(aperture.corner.to_array()));
    key.extend(bits(aperture.size));
    key
}

fn sensor_key(scene: &Scene) -> impl Iterator<Item = u64> + '_ {
    scene.sensors.iter().flat_map(|s| bits(s.position.to_array()).chain(bits(s.normal.to_array())))
}

fn basis_key(basis: Option<&RingBasis>) -> Key {
    let mut key = Vec::new();
    if let Some(basis) = basis {
        key.push(basis.len() as u64);
        key.extend(bits([basis.azimuth().sign, basis.azimuth().offset]));
        for ring in basis.rings() {
            key.extend(bits([ring.theta_min, ring.theta_max, ring.first_phi]));
            key.push(ring.sectors as u64);
        }
    }
    key
}
