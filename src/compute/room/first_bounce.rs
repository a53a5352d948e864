//! What every surface of the room receives directly from an aperture: the right-hand side of the interreflection.

use super::aperture::{Aperture, View};
use super::beam::{Beam, Lit, merged};
use super::direct::{Reception, Sensor};
use super::mesh::{Mesh, Patch, Wall};
use super::outline::{Outline, thrown_on_patches};
use super::radiosity::{Radiosity, dot};
use crate::compute::basis::{AzimuthMap, Resampling, Ring, RingBasis};
use crate::compute::btdf::AngularTransmittance;
use crate::compute::direction::{Dir, Surface};
use crate::compute::estimate::Estimate;
use crate::compute::lid::{BeamLight, Emission, Facing, Lamps};
use crate::compute::polygon::projected_solid_angle;
use crate::compute::quadrature::gauss_legendre;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Weights W with E_patch = Σ W_cell · L_cell, mean over each patch: geometry only, shared by all skies. \[sr\]
pub struct PatchWeights {
    /// The cells.
    pub basis: Arc<RingBasis>,
    /// One row a patch; empty for patches that do not see the aperture's room side.
    rows: Vec<Vec<f64>>,
    /// Flux that the room receives from each cell of luminance 1, over the flux that leaves through it. The mean is
    /// taken out of the weights; what remains here tells how well the patches' points sample the light.
    closure: Vec<f64>,
    /// Σ over the patches of area · weight, by cell. \[m²sr\]
    received: Vec<f64>,
}

/// Gauss points along each side of a patch: one where the patch is small against its distance from the opening, up to
/// three beside it.
fn points_a_side(patch: &Patch, wall: &Wall, aperture: &Aperture) -> usize {
    let [low, _, high, _] = patch.corners(wall);
    let centre = 0.5 * (low + high);
    let corners = aperture.corners();
    let nearest = centre.clamp(corners[0].min(corners[2]), corners[0].max(corners[2]));
    // The slack keeps decisions the same for a room in another unit.
    let ratio = (high - low).length() / centre.distance(nearest) - 1e-9;
    match ratio {
        r if r < 0.35 => 1,
        r if r < 1.0 => 2,
        _ => 3,
    }
}

/// Points of a patch with their share of its area.
fn samples<'a>(
    patch: &'a Patch,
    wall: &'a Wall,
    rules: &'a [Vec<(f64, f64)>],
    order: usize,
) -> impl Iterator<Item = (DVec3, f64)> + 'a {
    let rule = &rules[order];
    let [a, b] = patch.extent;
    rule.iter().flat_map(move |&(s, ws)| {
        rule.iter().map(move |&(t, wt)| (wall.point(a[0] + (a[1] - a[0]) * s, b[0] + (b[1] - b[0]) * t), ws * wt))
    })
}

/// Gauss rules by their number of points.
fn rules(most: usize) -> Vec<Vec<(f64, f64)>> {
    (0..=most).map(gauss_legendre).collect()
}

impl PatchWeights {
    /// Of all patches that see the aperture's room side.
    pub fn new(mesh: &Mesh, aperture: &Aperture, basis: Arc<RingBasis>) -> Self {
        let rules = rules(3);
        let rows: Vec<Vec<f64>> = mesh
            .patches
            .par_iter()
            .map(|patch| {
                let wall = &mesh.walls[patch.wall];
                let mut row = Vec::new();
                for (position, share) in samples(patch, wall, &rules, points_a_side(patch, wall, aperture)) {
                    if aperture.view(position, wall.normal).is_none() {
                        continue;
                    }
                    let reception = Reception::new(&Sensor { position, normal: wall.normal }, aperture, Some(&basis));
                    if row.is_empty() {
                        row = vec![0.0; basis.len()];
                    }
                    for (sum, weight) in row.iter_mut().zip(&reception.cells) {
                        *sum += share * weight;
                    }
                }
                row
            })
            .collect();
        let mut received = vec![0.0; basis.len()];
        for (row, patch) in rows.iter().zip(&mesh.patches) {
            for (sum, weight) in received.iter_mut().zip(row) {
                *sum += patch.area * weight;
            }
        }
        let closure = basis
            .cells()
            .zip(&received)
            .map(|(cell, r)| r / (aperture.area() * cell.projected_solid_angle()))
            .collect();
        Self { basis, rows, closure, received }
    }

    /// Mean illuminance of every patch, scaled so that the room receives exactly the flux that leaves the aperture;
    /// and by how much that scaling was, relative.
    pub fn illuminance(&self, luminance: &[f64]) -> (Vec<f64>, f64) {
        let received = dot(&self.received, luminance);
        if received <= 0.0 {
            return (vec![0.0; self.rows.len()], 0.0);
        }
        let left: f64 = self
            .received
            .iter()
            .zip(&self.closure)
            .zip(luminance)
            .map(|((r, c), l)| if *c > 0.0 { r / c * l } else { 0.0 })
            .sum();
        let scale = left / received;
        let first = self.rows.iter().map(|row| if row.is_empty() { 0.0 } else { scale * dot(row, luminance) });
        (first.collect(), (scale - 1.0).abs())
    }

    /// For weights of the patches' illuminance the weights of the cells' luminance, every cell's flux closed by itself.
    pub fn gathered(&self, weights: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.basis.len()];
        for (row, w) in self.rows.iter().zip(weights).filter(|(_, w)| **w != 0.0) {
            sums.iter_mut().zip(row).for_each(|(sum, weight)| *sum += w * weight);
        }
        sums.iter().zip(&self.closure).map(|(sum, c)| if *c > 0.0 { sum / c } else { 0.0 }).collect()
    }

    /// Mean relative gap of flux that the closing takes away, weighted by flux.
    pub fn gap(&self) -> f64 {
        let received: f64 = self.received.iter().sum();
        let gaps = self.received.iter().zip(&self.closure).filter(|(_, c)| **c > 0.0);
        if received > 0.0 { gaps.map(|(r, c)| r * (1.0 / c - 1.0).abs()).sum::<f64>() / received } else { 0.0 }
    }

    /// [`Self::falling_back`] as weights: for every cell those of the patches' exitance.
    pub fn falling(&self, mesh: &Mesh, aperture: &Aperture) -> Vec<Vec<f64>> {
        let scale = 1.0 / (PI * aperture.area());
        let share = |cell: usize, row: &Vec<f64>, patch: &Patch| {
            let closure = self.closure[cell];
            if row.is_empty() || closure <= 0.0 { 0.0 } else { patch.area * scale * row[cell] / closure }
        };
        (0..self.basis.len())
            .into_par_iter()
            .map(|cell| self.rows.iter().zip(&mesh.patches).map(|(row, patch)| share(cell, row, patch)).collect())
            .collect()
    }

    /// Mean illuminance of the aperture's room side from the patches, by the cells through which their light comes.
    /// \[lx\] A cell is named by where its light goes to.
    pub fn falling_back(&self, mesh: &Mesh, aperture: &Aperture, exitance: &[f64]) -> Vec<f64> {
        let mut incident = vec![0.0; self.basis.len()];
        for ((row, patch), b) in self.rows.iter().zip(&mesh.patches).zip(exitance) {
            let flux = patch.area * b;
            if flux > 0.0 {
                incident.iter_mut().zip(row).for_each(|(sum, weight)| *sum += flux * weight);
            }
        }
        let scale = 1.0 / (PI * aperture.area());
        incident.iter().zip(&self.closure).map(|(e, c)| if *c > 0.0 { e * scale / c } else { 0.0 }).collect()
    }
}

/// More cells than this are merged before they meet the patches, which cannot tell them apart.
pub const MOST_CELLS: usize = 600;

/// About 400 cells of equal projected solid angle but for finer ones around the normal, where the far end of a deep room
/// looks; their borders hold the façade's horizon.
pub fn merged_basis() -> RingBasis {
    let limits = [0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0_f64];
    let sectors = [4, 8, 12, 12, 20, 28, 36, 44, 52, 60, 68, 76];
    let rings = limits
        .windows(2)
        .zip(sectors)
        .map(|(sine, sectors)| Ring {
            theta_min: sine[0].asin(),
            theta_max: sine[1].asin(),
            sectors,
            first_phi: PI / sectors as f64,
        })
        .collect();
    RingBasis::new("merged", rings, AzimuthMap::FACADE).expect("the sines above rise from 0 to 1")
}

/// [`merged_basis`], made once.
fn merged_cells() -> &'static Arc<RingBasis> {
    static CELLS: OnceLock<Arc<RingBasis>> = OnceLock::new();
    CELLS.get_or_init(|| Arc::new(merged_basis()))
}

/// Bases whose way onto the merged cells is kept; the oldest goes first.
const MERGINGS: usize = 4;

/// From the cells of a basis to the merged ones. Every sun asks for the same few bases.
fn merging(basis: &Arc<RingBasis>) -> Arc<Resampling> {
    static KEPT: Mutex<Vec<(Arc<RingBasis>, Arc<Resampling>)>> = Mutex::new(Vec::new());
    // What is kept is whole even if another thread has failed while it held the lock.
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, found)) = kept.iter().find(|(known, _)| Arc::ptr_eq(known, basis)) {
        return Arc::clone(found);
    }
    let made = Arc::new(Resampling::new(basis, merged_cells()));
    if kept.len() == MERGINGS {
        kept.remove(0);
    }
    kept.push((Arc::clone(basis), Arc::clone(&made)));
    made
}

/// Of the light that is shifted between patches as if it left in all directions alike, what may be misplaced.
const MISPLACED: f64 = 0.25;

/// Direct illuminance of the fine patches, means. \[lx\]
pub struct FirstLight {
    /// Sky, ground and scattered light.
    pub diffuse: Vec<f64>,
    /// The sun's beams. What they light shines from exact outlines: [`BeamLanding`].
    pub beams: Vec<Beam>,
    /// Largest relative gap between the flux that left and the flux that was found, before it was closed.
    pub gap: f64,
    /// Share of the light that may lie on other patches, for being taken as even over parts of an aperture.
    pub misplaced: f64,
}

/// What the beams do in the room.
pub struct BeamLanding {
    /// What they light, and reflects at once.
    pub outlines: Vec<Outline>,
    /// Mean illuminance of every patch from these outlines: where the balance of the patches takes the beams up. \[lx\]
    pub thrown: Vec<f64>,
    /// Mean illuminance of every patch by the beams themselves, for what looks at patches. \[lx\]
    pub direct: Vec<f64>,
    /// Share of their flux that was closed.
    pub gap: f64,
}

impl BeamLanding {
    /// What a point gets from the first reflection. \[lx\]
    pub fn light_at(&self, mesh: &Mesh, position: DVec3, normal: DVec3) -> f64 {
        self.outlines.iter().map(|outline| outline.light_at(mesh, position, normal)).sum()
    }
}

/// Mean illuminance of every fine patch from an aperture of uniform exitance 1, no reflection. \[lx\]
pub fn from_even(radiosity: &Radiosity, index: usize, aperture: &Aperture) -> Vec<f64> {
    let mesh = &radiosity.nested.fine;
    if mesh.patches.iter().any(|patch| patch.aperture == Some(index)) {
        return radiosity.illuminance_from_aperture(index);
    }
    // Too small for a patch: an outline has no neighbours to share lines with.
    thrown_on_patches(mesh, &[Outline::of_aperture(mesh, aperture, 1.0)]).0
}

impl FirstLight {
    /// None.
    pub fn dark(patches: usize) -> Self {
        Self { diffuse: vec![0.0; patches], beams: Vec::new(), gap: 0.0, misplaced: 0.0 }
    }

    /// Adds the light of one aperture.
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

    /// Adds the light of luminaires in an aperture.
    pub fn add_lamps(&mut self, mesh: &Mesh, aperture: &Aperture, lamps: &Lamps) {
        let at = |sensor: &Sensor| lamps.illuminance(sensor.position, sensor.normal);
        self.add_seen(mesh, aperture, Estimate::exact(lamps.flux()), at);
    }

    /// Adds light that lies on cells or bands. `weights`: what the patches receive by the cells of a basis.
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

    /// Adds a beam of the sun through one aperture.
    pub fn add_beam(&mut self, aperture: &Aperture, beam: &BeamLight, facing: &Facing<'_>) {
        if let Some(to) = beam.entering(facing) {
            let from = aperture.surface.room_dir(to).vector();
            let opening = aperture.corners().to_vec();
            self.beams.push(Beam { opening, from, flux: beam.exitance * aperture.area() });
        }
    }

    /// What the beams light, as sharp as the room reflects it: those of a wide fan together.
    pub fn lit(&self, mesh: &Mesh) -> Vec<Lit> {
        merged(&self.beams).iter().flat_map(|beam| beam.lit(mesh)).collect()
    }

    /// Adds a beam through the convex pieces of an aperture that the sun reaches; room frame.
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

    /// Adds scattered light that is even over a convex piece of a wall with an aperture in it. \[lm/m²\]
    pub fn add_outlines(&mut self, mesh: &Mesh, outlines: &[Outline]) {
        self.add_diffuse(thrown_on_patches(mesh, outlines));
    }

    /// Adds light on cells that is known as even over few parts of an aperture (`coarse`, all else left out) and leaves it
    /// as `fine` says: what a patch gets is shifted as if light left in all directions alike.
    pub fn add_shifted(&mut self, mesh: &Mesh, mut on_cells: Self, coarse: &[Outline], fine: &[Outline]) {
        let before = std::mem::take(&mut on_cells.diffuse);
        let (few, many) = (thrown_on_patches(mesh, coarse).0, thrown_on_patches(mesh, fine).0);
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

    /// Adds the outside seen straight through an aperture by light at points of the patches, scaled to the flux that
    /// enters as far as that is known. \[lm\]
    pub fn add_seen(&mut self, mesh: &Mesh, aperture: &Aperture, flux: Estimate, at: impl Fn(&Sensor) -> f64 + Sync) {
        let first = seen_on_patches(mesh, aperture, &rules(3), at);
        let received: f64 = mesh.patches.iter().zip(&first).map(|(patch, e)| patch.area * e).sum();
        let entered = received.clamp(flux.value - flux.error, flux.value + flux.error);
        self.add_diffuse(scaled_to(mesh, entered, first));
    }

    /// Where the beams land; `None` without any.
    pub fn landing(&self, mesh: &Mesh) -> Option<BeamLanding> {
        if self.beams.is_empty() {
            return None;
        }
        let outlines: Vec<Outline> = self.beams.iter().flat_map(|beam| beam.outlines(mesh)).collect();
        let few = merged(&self.beams);
        let mut direct = vec![0.0; mesh.patches.len()];
        few.iter().for_each(|beam| beam.add_to(mesh, &mut direct));
        // Points see every outline as it is; the patches, from which light is reflected on, see those of a fan together.
        let (thrown, gap) = if few.len() < self.beams.len() {
            thrown_on_patches(mesh, &few.iter().flat_map(|beam| beam.outlines(mesh)).collect::<Vec<_>>())
        } else {
            thrown_on_patches(mesh, &outlines)
        };
        Some(BeamLanding { outlines, thrown, direct, gap })
    }

    fn add_diffuse(&mut self, (part, gap): (Vec<f64>, f64)) {
        for (sum, e) in self.diffuse.iter_mut().zip(part) {
            *sum += e;
        }
        self.gap = self.gap.max(gap);
    }
}

/// Mean illuminance of every patch from the outside seen straight through the opening, scaled to the flux that enters;
/// and by how much that scaling was, relative.
fn outside_seen(
    mesh: &Mesh,
    aperture: &Aperture,
    emission: &Emission,
    facing: &Facing<'_>,
    tau: &AngularTransmittance,
) -> (Vec<f64>, f64) {
    // What goes straight on, without the beam and what scatters.
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

/// Means over every patch of the light at its points.
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

/// Scaled to the flux that enters \[lm\], and by how much that was, relative.
fn scaled_to(mesh: &Mesh, flux: f64, mut first: Vec<f64>) -> (Vec<f64>, f64) {
    let received: f64 = mesh.patches.iter().zip(&first).map(|(patch, e)| patch.area * e).sum();
    if received <= 0.0 {
        return (first, 0.0);
    }
    let scale = flux / received;
    first.iter_mut().for_each(|e| *e *= scale);
    (first, (scale - 1.0).abs())
}

/// Area of a plane convex polygon in space. \[m²\]
fn area_of(corners: &[DVec3]) -> f64 {
    let Some((&apex, rest)) = corners.split_first() else { return 0.0 };
    0.5 * rest.windows(2).map(|pair| (pair[0] - apex).cross(pair[1] - apex)).sum::<DVec3>().length()
}

/// Illuminance at a point that has all of the opening in front of it: ground in closed form where nothing depends on
/// the angle, the sky by a Gauss rule in the two angles of profile, in which the opening's near field is smooth.
fn seen_from(view: &View, facing: &Facing<'_>, tau: &AngularTransmittance, rules: &[Vec<(f64, f64)>]) -> f64 {
    let uniform = tau.constant();
    let mut sum = 0.0;
    let mut bands = vec![view.y];
    if facing.surface == Surface::Facade {
        // The horizon of the point cuts the opening.
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
    let angle = |x: f64| (x / view.distance).atan();
    let [a0, a1] = view.x.map(angle);
    for band in bands {
        let [b0, b1] = band.map(angle);
        if b1 - b0 < 1e-12 {
            continue;
        }
        let order = |width: f64| ((2.0 + 4.0 * width - 1e-9).ceil() as usize).min(rules.len() - 1);
        let mut part = 0.0;
        for &(s, ws) in &rules[order(a1 - a0)] {
            let x = (a0 + (a1 - a0) * s).tan();
            for &(t, wt) in &rules[order(b1 - b0)] {
                let y = (b0 + (b1 - b0) * t).tan();
                let square = 1.0 + x * x + y * y;
                let d = DVec3::new(x, y, 1.0) / square.sqrt();
                let tau = uniform.unwrap_or_else(|| tau.at(d.z.acos()));
                // dω = dx dy / r³ with dx = (1 + x²) da.
                let solid = (1.0 + x * x) * (1.0 + y * y) / (square * square.sqrt());
                part += ws * wt * solid * view.normal.dot(d).max(0.0) * tau * facing.luminance(Dir::from_unit(d));
            }
        }
        sum += part * (a1 - a0) * (b1 - b0);
    }
    sum
}
