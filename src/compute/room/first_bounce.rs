//! Direct illuminance of the room's surfaces by the apertures: the right-hand side of the interreflection equations.

use super::aperture::{Aperture, View};
use super::beam::{Beam, Lit, merged};
use super::direct::Sensor;
use super::mesh::Mesh;
use super::outline::{Outline, patch_illuminances};
use super::patch_weights::{MOST_CELLS, PatchWeights, merged_cells, merging, points_a_side, rules, samples};
use super::radiosity::Radiosity;
use super::through;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::AngularTransmittance;
use crate::compute::direction::{Dir, Surface};
use crate::compute::estimate::Estimate;
use crate::compute::lid::{BeamLight, Emission, Facing, Lamps};
use crate::compute::polygon::projected_solid_angle;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;

/// Share of light that may be on wrong patches after a shift between patches that assumes Lambertian emission. Chosen:
/// affects stated errors only.
const MISPLACED: f64 = 0.25;

/// Direct illuminance of the room's fine patches by all apertures, before reflection, and the beams of the sun. \[lx\]
pub struct FirstLight {
    /// Mean illuminance of every fine patch by sky, ground and scattered sunlight. \[lx\]
    pub diffuse: Vec<f64>,
    /// Beams of direct sun into the room. Their first reflection is computed from exact outlines: [`BeamLanding`].
    pub beams: Vec<Beam>,
    /// Largest relative difference between the flux that leaves the apertures and the flux that the patches receive,
    /// before both are made equal by scaling.
    pub gap: f64,
    /// Share of the flux that may be on wrong patches, because it is assumed to be uniform over parts of an aperture.
    pub misplaced: f64,
}

/// Illuminance of the room's surfaces by beams of direct sun, and the first reflection of it.
pub struct BeamLanding {
    /// Outlines of the lit pieces of surfaces with their exitance by the first reflection.
    pub outlines: Vec<Outline>,
    /// Mean illuminance of every patch by these outlines, the input of the interreflection of beams. \[lx\]
    pub reflected: Vec<f64>,
    /// Mean illuminance of every patch by the beams themselves, for pictures of the room's surfaces. \[lx\]
    pub direct: Vec<f64>,
    /// Share of the outlines' flux that was added or removed so that the patches receive exactly the reflected flux.
    pub gap: f64,
}

impl BeamLanding {
    /// Returns the illuminance at a point by the first reflection of the beams. \[lx\] `position` and `normal`: of the
    /// receiving plane, room's frame.
    pub fn light_at(&self, mesh: &Mesh, position: DVec3, normal: DVec3) -> f64 {
        self.outlines.iter().map(|outline| outline.light_at(mesh, position, normal)).sum()
    }
}

/// Computes the mean illuminance of every fine patch by an aperture of uniform Lambertian exitance 1 lm/m², without
/// reflection. \[lx\] `index`: of the aperture in the meshes.
pub fn from_even(radiosity: &Radiosity, index: usize, aperture: &Aperture) -> Vec<f64> {
    let mesh = &radiosity.nested.fine;
    if mesh.patches.iter().any(|patch| patch.aperture == Some(index)) {
        return radiosity.illuminance_from_aperture(index);
    }
    // An aperture too small for patches is lit as a single outline.
    patch_illuminances(mesh, &[Outline::of_aperture(mesh, aperture, 1.0)]).0
}

impl FirstLight {
    /// Creates the direct illuminance 0 of a room with this number of fine patches.
    pub fn dark(patches: usize) -> Self {
        Self { diffuse: vec![0.0; patches], beams: Vec::new(), gap: 0.0, misplaced: 0.0 }
    }

    /// Adds the direct illuminance by one aperture. `index`: of the aperture in the meshes; `weights`: returns the
    /// weights of the cells of a basis in the illuminance of the patches.
    pub fn add(
        &mut self,
        radiosity: &Radiosity,
        index: usize,
        aperture: &Aperture,
        emission: &Emission,
        facing: &Facing<'_>,
        weights: &dyn Fn(&Arc<RingBasis>) -> Arc<PatchWeights>,
    ) {
        let mesh = &radiosity.nested.fine;
        if emission.uniform.value > 0.0 {
            let exitance = PI * emission.uniform.value;
            for (sum, e) in self.diffuse.iter_mut().zip(from_even(radiosity, index, aperture)) {
                *sum += exitance * e;
            }
        }
        self.add_cells(emission, weights);
        if let Some(tau) = &emission.regular {
            self.add_diffuse(outside_seen(mesh, aperture, emission, facing, tau));
        }
        if let Some(lamps) = &emission.lamps {
            self.add_lamps(mesh, aperture, lamps);
        }
        emission.beams.iter().for_each(|beam| self.add_beam(aperture, beam, facing));
    }

    /// Adds the direct illuminance by luminaires that replace an aperture.
    pub fn add_lamps(&mut self, mesh: &Mesh, aperture: &Aperture, lamps: &Lamps) {
        let at = |sensor: &Sensor| lamps.illuminance(sensor.position, sensor.normal);
        self.add_seen(mesh, aperture, Estimate::exact(lamps.flux()), at);
    }

    /// Adds the direct illuminance by the components of an emission on cells and by profile angle. `weights`: returns
    /// the weights of the cells of a basis in the illuminance of the patches.
    pub fn add_cells(&mut self, emission: &Emission, weights: &dyn Fn(&Arc<RingBasis>) -> Arc<PatchWeights>) {
        for light in &emission.cells {
            let luminance: Vec<f64> = light.diffuse.iter().zip(&light.sun).map(|(d, s)| d + s).collect();
            let part = if light.basis.len() > MOST_CELLS {
                weights(merged_cells()).illuminance(&merging(&light.basis).apply(&luminance))
            } else {
                weights(&light.basis).illuminance(&luminance)
            };
            self.add_diffuse(part);
        }
        for bands in &emission.bands {
            let merged = merged_cells();
            let luminance: Vec<f64> = bands.light.on(merged).iter().map(|q| q * bands.illuminance).collect();
            self.add_diffuse(weights(merged).illuminance(&luminance));
        }
    }

    /// Adds a beam of direct sun through a whole aperture.
    pub fn add_beam(&mut self, aperture: &Aperture, beam: &BeamLight, facing: &Facing<'_>) {
        if let Some(to) = beam.entering(facing) {
            let from = aperture.surface.room_dir(to).vector();
            let opening = aperture.corners().to_vec();
            self.beams.push(Beam { opening, from, flux: beam.exitance * aperture.area() });
        }
    }

    /// Returns the pieces of room surfaces that the beams light; beams of a wide fan are merged, like in the first
    /// reflection.
    pub fn lit(&self, mesh: &Mesh) -> Vec<Lit> {
        merged(&self.beams).iter().flat_map(|beam| beam.lit(mesh)).collect()
    }

    /// Adds a beam of direct sun through the sunlit convex pieces of an aperture, given by their corners in the room's
    /// frame \[m\].
    pub fn add_beam_through(
        &mut self,
        aperture: &Aperture,
        pieces: &[Vec<DVec3>],
        beam: &BeamLight,
        facing: &Facing<'_>,
    ) {
        if let Some(to) = beam.entering(facing) {
            let from = aperture.surface.room_dir(to).vector();
            for piece in pieces {
                let flux = beam.exitance * area_of(piece);
                self.beams.push(Beam { opening: piece.clone(), from, flux });
            }
        }
    }

    /// Adds the direct illuminance by Lambertian light of convex pieces of an aperture, given by their outlines and
    /// exitances.
    pub fn add_outlines(&mut self, mesh: &Mesh, outlines: &[Outline]) {
        self.add_diffuse(patch_illuminances(mesh, outlines));
    }

    /// Adds the direct illuminance `on_cells`, computed for an emission that is uniform over few parts of an aperture
    /// (`coarse`), corrected to the actual distribution over the aperture (`fine`). The correction of each patch is
    /// that for Lambertian emission.
    pub fn add_shifted(&mut self, mesh: &Mesh, mut on_cells: Self, coarse: &[Outline], fine: &[Outline]) {
        let before = std::mem::take(&mut on_cells.diffuse);
        let (few, many) = (patch_illuminances(mesh, coarse).0, patch_illuminances(mesh, fine).0);
        let shifted: Vec<f64> = before
            .iter()
            .zip(few.iter().zip(&many))
            .map(|(e, (few, many))| if *few > 0.0 { e * many / few } else { *e })
            .collect();
        let flux: f64 = mesh.patches.iter().zip(&before).map(|(patch, e)| patch.area * e).sum();
        let (shifted, _) = scaled_to(mesh, flux, shifted);
        let moves = before.iter().zip(&shifted).zip(&mesh.patches).map(|((a, b), patch)| patch.area * (a - b).abs());
        if flux > 0.0 {
            self.misplaced = self.misplaced.max(MISPLACED * 0.5 * moves.sum::<f64>() / flux);
        }
        self.add_diffuse((shifted, on_cells.gap));
    }

    /// Adds the direct illuminance by the outside seen through an aperture. `at`: returns the illuminance at a point of
    /// a patch \[lx\]; `flux`: flux that enters the room, to which the sum is scaled within its error \[lm\].
    pub fn add_seen(&mut self, mesh: &Mesh, aperture: &Aperture, flux: Estimate, at: impl Fn(&Sensor) -> f64 + Sync) {
        let first = seen_on_patches(mesh, aperture, &rules(3), at);
        let received: f64 = mesh.patches.iter().zip(&first).map(|(patch, e)| patch.area * e).sum();
        let entered = received.clamp(flux.value - flux.error, flux.value + flux.error);
        self.add_diffuse(scaled_to(mesh, entered, first));
    }

    /// Returns the illuminance of the room's surfaces by the beams and its first reflection; `None` without any beam.
    pub fn landing(&self, mesh: &Mesh) -> Option<BeamLanding> {
        if self.beams.is_empty() {
            return None;
        }
        let outlines: Vec<Outline> = self.beams.iter().flat_map(|beam| beam.outlines(mesh)).collect();
        let few = merged(&self.beams);
        let mut direct = vec![0.0; mesh.patches.len()];
        few.iter().for_each(|beam| beam.add_to(mesh, &mut direct));
        // Sensors are lit by every outline separately; for the patches, the outlines of a fan are merged.
        let (reflected, gap) = if few.len() < self.beams.len() {
            patch_illuminances(mesh, &few.iter().flat_map(|beam| beam.outlines(mesh)).collect::<Vec<_>>())
        } else {
            patch_illuminances(mesh, &outlines)
        };
        Some(BeamLanding { outlines, reflected, direct, gap })
    }

    fn add_diffuse(&mut self, (part, gap): (Vec<f64>, f64)) {
        for (sum, e) in self.diffuse.iter_mut().zip(part) {
            *sum += e;
        }
        self.gap = self.gap.max(gap);
    }
}

/// Computes the mean illuminance of every patch by the outside seen through the aperture by regular transmission,
/// scaled to the flux that enters \[lx\], and the relative change by that scaling.
fn outside_seen(
    mesh: &Mesh,
    aperture: &Aperture,
    emission: &Emission,
    facing: &Facing<'_>,
    tau: &AngularTransmittance,
) -> (Vec<f64>, f64) {
    // The regular transmission alone, without beams and scattered light.
    let mut straight = emission.clone();
    (straight.beams, straight.cells, straight.bands) = (Vec::new(), Vec::new(), Vec::new());
    straight.uniform = Estimate::default();
    let flux = straight.exitance(facing).value * aperture.area();
    let rules = rules(8);
    let first = seen_on_patches(mesh, aperture, &rules, |sensor| {
        let view = aperture.view(sensor.position, sensor.normal);
        view.map_or(0.0, |view| seen_from(&view, facing, tau, &rules))
    });
    scaled_to(mesh, flux, first)
}

/// Returns the mean over every patch of the illuminance `at` its points. \[lx\]
fn seen_on_patches(
    mesh: &Mesh,
    aperture: &Aperture,
    rules: &[Vec<(f64, f64)>],
    at: impl Fn(&Sensor) -> f64 + Sync,
) -> Vec<f64> {
    mesh.patches
        .par_iter()
        .map(|patch| {
            let wall = &mesh.walls[patch.wall];
            samples(patch, wall, rules, points_a_side(patch, wall, aperture))
                .map(|(position, share)| share * at(&Sensor { position, normal: wall.normal }))
                .sum()
        })
        .collect()
}

/// Returns the illuminance of the patches scaled to the flux `flux` that enters \[lm\], with the relative change.
fn scaled_to(mesh: &Mesh, flux: f64, mut first: Vec<f64>) -> (Vec<f64>, f64) {
    let received: f64 = mesh.patches.iter().zip(&first).map(|(patch, e)| patch.area * e).sum();
    if received <= 0.0 {
        return (first, 0.0);
    }
    let scale = flux / received;
    first.iter_mut().for_each(|e| *e *= scale);
    (first, (scale - 1.0).abs())
}

/// Returns the area of a plane convex polygon given by its corners. \[m²\]
fn area_of(corners: &[DVec3]) -> f64 {
    let Some((&apex, rest)) = corners.split_first() else { return 0.0 };
    0.5 * rest.windows(2).map(|pair| (pair[0] - apex).cross(pair[1] - apex)).sum::<DVec3>().length()
}

/// Computes the illuminance, by regular transmission, at a point in front of which the whole aperture lies: of the
/// ground in closed form if τ does not depend on the angle, of the sky by a Gauss rule in the two profile angles, in
/// which the integrand is smooth near the aperture, too. \[lx\]
fn seen_from(view: &View, facing: &Facing<'_>, tau: &AngularTransmittance, rules: &[Vec<(f64, f64)>]) -> f64 {
    let uniform = tau.constant();
    let mut sum = 0.0;
    let mut bands = vec![view.y];
    if facing.surface == Surface::Facade {
        // The opening is divided at the sensor's horizon.
        let [low, high] = view.y;
        let level = 0.0_f64.clamp(low, high);
        bands = vec![[level, high]];
        match uniform {
            Some(tau) => {
                let below = View { y: [low, level], ..*view };
                let ground = tau * facing.outside.ground_luminance();
                if ground > 0.0 && level > low {
                    sum += ground * projected_solid_angle(&below.corners(), view.normal);
                }
            }
            None => bands.push([low, level]),
        }
    }
    if let Some(tau) = uniform.filter(|_| facing.outside.is_uniform_above_horizon()) {
        let luminance = facing.luminance(facing.surface.facade_dir(Dir::from_unit(DVec3::Z)));
        let above = View { y: bands[0], ..*view };
        return sum + tau * luminance * projected_solid_angle(&above.corners(), view.normal);
    }
    for band in bands {
        through::nodes(view, band, rules, |d, weight| {
            let tau = uniform.unwrap_or_else(|| tau.at(d.z.acos()));
            sum += weight * tau * facing.luminance(Dir::from_unit(d));
        });
    }
    sum
}
