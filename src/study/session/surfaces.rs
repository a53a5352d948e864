//! Illuminances of the surfaces of the room: means over the patches between which interreflection is computed, and the
//! outlines of the areas that beams of sunlight light.

use super::interreflected::{DIFFERENCE_ALONE, PATCHES, REST, mesh_key, mirrors};
use super::{Session, check};
use crate::compute::basis::RingBasis;
use crate::compute::estimate::{Estimate, Progress};
use crate::compute::lid::Emission;
use crate::compute::room::back_reflection::settled_light;
use crate::compute::room::beam::Lit;
use crate::compute::room::mesh::{Patch, Wall};
use crate::study::error::StudyError;
use crate::study::plan::Plan;
use crate::study::scene::Scene;
use std::sync::Arc;

/// Number of steps that progress reports.
const STEPS: usize = 3;

/// Illuminance of one patch of the room's surfaces, as a mean over it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatchLight {
    /// Position and reflectance of the patch.
    pub patch: Patch,
    /// Illuminance by all light, except beams of sunlight that reach the patch without reflection. \[lx\]
    pub diffuse: Estimate,
    /// Illuminance by beams of sunlight that reach the patch without reflection. \[lx\]
    pub beam: f64,
}

impl PatchLight {
    /// Returns the total illuminance of the patch. \[lx\]
    pub fn total(&self) -> Estimate {
        self.diffuse + Estimate::exact(self.beam)
    }
}

/// Illuminances of all surfaces of the room.
#[derive(Debug, Clone)]
pub struct SurfaceLight {
    /// Walls of the room: floor, ceiling, x = 0, x = width, façade, back wall.
    pub walls: Vec<Wall>,
    /// Patches of all walls, wall by wall, first axis slowest; the room sides of apertures are among them.
    pub patches: Vec<PatchLight>,
    /// Areas that beams of sunlight light without reflection, with their illuminances, which add up where areas
    /// overlap.
    pub lit: Vec<Lit>,
    /// Luminous flux that enters the room through all apertures. \[lm\]
    pub flux: Estimate,
}

impl Session {
    /// Computes the illuminances of all surfaces of the room.
    ///
    /// # Errors
    /// Returns an error if the scene cannot be computed, with the reason, or if cancelled.
    pub fn surfaces(&self, scene: &Scene, progress: &dyn Progress) -> Result<SurfaceLight, StudyError> {
        progress.advance("surfaces", 0, STEPS);
        let lights = self.lights(scene, progress)?;
        let geometry: Vec<_> = scene.apertures.iter().map(|a| a.aperture).collect();
        let of_aperture = |(index, emission): (usize, &Emission)| {
            (lights.flux_through(scene, index), emission.exitance_uncertainty() * geometry[index].area())
        };
        let fluxes: Vec<_> = lights.emissions.iter().enumerate().map(of_aperture).collect();
        let flux: Estimate = fluxes.iter().map(|(flux, _)| *flux).sum();
        let flux_uncertainty: f64 = fluxes.iter().map(|(_, uncertainty)| uncertainty).sum();
        check(progress)?;
        let count = PATCHES[0];
        let radiosity = self.radiosity(scene, count)?;
        let mesh = &radiosity.nested.fine;
        progress.advance("surfaces", 1, STEPS);
        let first = self.first_light(scene, &lights, count, progress)?;
        let landing = first.landing(mesh);
        let beams = landing.as_ref().map_or_else(|| vec![0.0; mesh.patches.len()], |landing| landing.direct.clone());
        let lit = first.lit(mesh);
        let gap = landing.as_ref().map_or(0.0, |landing| landing.gap).max(first.gap);
        let misplaced = first.misplaced;
        check(progress)?;
        progress.advance("surfaces", 2, STEPS);
        let received = if Plan::new(scene).runs("interreflection") {
            let mut all = first.diffuse;
            if let Some(landing) = &landing {
                all.iter_mut().zip(&landing.reflected).for_each(|(sum, e)| *sum += e);
            }
            let key = mesh_key(scene, count);
            let mirrors = mirrors(scene, |index: usize, basis: &Arc<RingBasis>| {
                self.patch_weights(&key, mesh, &geometry[index], basis)
            });
            if !mirrors.is_empty() {
                let mut exitance = radiosity.exitance(&all);
                let luminances = settled_light(&radiosity, &geometry, &mirrors, &all, &beams, &mut exitance);
                for ((_, mirror), luminance) in mirrors.iter().zip(luminances) {
                    let (reflected, _) = mirror.weights().illuminance(&luminance);
                    all.iter_mut().zip(reflected).for_each(|(sum, e)| *sum += e);
                }
            }
            radiosity.illuminance(&all)
        } else {
            first.diffuse.into_iter().map(|e| (e, 0.0)).collect()
        };
        // The relative error of the flux that enters is that of the light it becomes.
        let open = if flux.value > 0.0 { (flux.error + flux_uncertainty) / flux.value } else { 0.0 };
        let rest = (REST / mesh.patches.len() as f64).hypot(gap).hypot(misplaced);
        let patches = mesh
            .patches
            .iter()
            .zip(received)
            .zip(beams)
            .map(|((patch, (value, difference)), beam)| {
                let error = (DIFFERENCE_ALONE * difference).hypot(rest * value) + open * (value + beam);
                PatchLight { patch: *patch, diffuse: Estimate::new(value, error), beam }
            })
            .collect();
        progress.advance("surfaces", STEPS, STEPS);
        Ok(SurfaceLight { walls: mesh.walls.clone(), patches, lit, flux })
    }
}
