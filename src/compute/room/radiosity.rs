//! Interreflection between the diffuse surfaces of a box room: closed-form exchange areas, one small Cholesky
//! factorisation, any number of distributions of the direct illuminance.
//!
//! With the exitance B = ρE, the equation E = E₀ + Fρ E for the illuminance E from the direct illuminance E₀ is solved
//! for the interreflected illuminance alone, R = E₁ + Fρ R with E₁ = Fρ E₀. E₀ changes fast and is given on fine
//! patches, from which E₁ is exact; R is smooth and is solved between patches of twice the size (Galerkin), then
//! transferred to the fine ones by one more exchange (Sloan's iterate). The symmetric positive definite system (A/ρ −
//! AF) b = A E₁, b = ρR, is factored, not iterated: at ρ = 0.99 iterations need thousands of sweeps.
//!
//! A second solution with all patches twice as large uses sums of the same exchange areas. The error is of second order
//! in the size of the patches, so that a third of the difference is added, and the difference shows the remaining
//! error.

use super::exchange::Exchange;
use super::mesh::{Mesh, Nested, Patch};
use crate::compute::dot::dot;
use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, Side};
use std::sync::Arc;

/// Maximum mean reflectance of all surfaces together, weighted by area. Above it the result depends mainly on small
/// errors of the reflectances; with 1 there is no solution. Chosen: limit of input; the sum of all reflections, 1 / (1
/// − ρ), is 1000 there.
pub const MOST_REFLECTANCE: f64 = 0.999;

/// Interreflection in a meshed room, prepared for any direct illuminance of its patches.
pub struct Radiosity {
    /// Patches of the room in three densities.
    pub nested: Nested,
    level: MeshBalance,
    coarser: MeshBalance,
}

/// Interreflection equations on one mesh, with exchange areas to the next finer one.
struct MeshBalance {
    exchange: Arc<Exchange>,
    /// Area of every patch of the coarser, receiving mesh. \[m²\]
    area: Vec<f64>,
    reflectance: Vec<f64>,
    /// Index of the receiving patch that contains each emitting patch of the finer mesh.
    holder: Vec<usize>,
    /// Indices of the receiving patches with ρ > 0.
    active: Vec<usize>,
    factor: Option<Llt<f64>>,
}

/// Luminous exitance of the room's patches by all reflections, computed with two densities of the mesh. \[lm/m²\]
pub struct Exitance {
    /// Exitance of the fine patches. \[lm/m²\]
    pub fine: Vec<f64>,
    /// Exitance of the coarse patches, computed on the coarse and coarser meshes alone, except for the direct
    /// illuminance. \[lm/m²\]
    pub coarse: Vec<f64>,
}

/// Error of a room that absorbs so little light that the interreflection has no meaningful solution.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "the surfaces reflect {mean} of all light as a mean over their area (allowed: up to {MOST_REFLECTANCE}): with next to \
     nothing absorbed the illuminance grows without limit; lower a reflectance of the room or of an aperture's room side"
)]
pub struct NothingAbsorbs {
    /// Mean reflectance of the room's surfaces, weighted by area.
    pub mean: f64,
}

/// Returns the mean reflectance of the patches of a mesh, weighted by area. `reflectance`: returns that of a patch.
///
/// # Errors
/// Returns an error if the mean is above [`MOST_REFLECTANCE`].
pub fn enough_is_absorbed(mesh: &Mesh, reflectance: impl Fn(&Patch) -> f64) -> Result<f64, NothingAbsorbs> {
    let total: f64 = mesh.patches.iter().map(|patch| patch.area).sum();
    let absorbed: f64 = mesh.patches.iter().map(|patch| patch.area * (1.0 - reflectance(patch))).sum();
    let mean = 1.0 - absorbed / total;
    if absorbed < (1.0 - MOST_REFLECTANCE) * (1.0 - 1e-9) * total { Err(NothingAbsorbs { mean }) } else { Ok(mean) }
}

impl Radiosity {
    /// Factors the interreflection equations of a meshed room. `level`, `coarser`: exchange areas of its meshes
    /// ([`Exchange::level`], [`Exchange::coarser`]). Memory: a dense matrix of the coarse patches, beside the shared
    /// exchange areas.
    ///
    /// # Errors
    /// Returns an error if the surfaces absorb too little light ([`MOST_REFLECTANCE`]).
    pub fn new(nested: Nested, level: Arc<Exchange>, coarser: Arc<Exchange>) -> Result<Self, NothingAbsorbs> {
        let mean = enough_is_absorbed(&nested.fine, |patch| patch.reflectance)?;
        let singular = NothingAbsorbs { mean };
        let coarser = MeshBalance::new(coarser, &nested.coarser, &nested.coarser_of_coarse).ok_or(singular)?;
        let level = MeshBalance::new(level, &nested.coarse, &nested.coarse_of_fine).ok_or(singular)?;
        Ok(Self { nested, level, coarser })
    }

    /// Factors the equations of a room that shares its exchange areas with no other.
    #[cfg(test)]
    pub(super) fn alone(nested: Nested) -> Result<Self, NothingAbsorbs> {
        let level = Exchange::level(&nested);
        let coarser = level.coarser(&nested);
        Self::new(nested, Arc::new(level), Arc::new(coarser))
    }

    /// Returns the memory that its equations and patches take, without the exchange areas. \[bytes\]
    pub fn bytes(&self) -> usize {
        let factors = [&self.level, &self.coarser].map(|level| size_of::<f64>() * level.active.len().pow(2));
        size_of::<Patch>() * self.nested.fine.patches.len() + factors[0] + factors[1]
    }

    /// Computes the exitance of every patch by all reflections, from the direct illuminance `first` of the fine patches
    /// \[lx\].
    pub fn exitance(&self, first: &[f64]) -> Exitance {
        let reflected = |level: &MeshBalance, mesh: &Mesh, first: &[f64]| -> Vec<f64> {
            let after = level.after_reflection(mesh, first);
            let received = first.iter().zip(after).map(|(e, r)| e + r);
            mesh.patches.iter().zip(received).map(|(patch, e)| patch.reflectance * e).collect()
        };
        Exitance {
            fine: reflected(&self.level, &self.nested.fine, first),
            coarse: reflected(&self.coarser, &self.nested.coarse, &self.level.means(&self.nested.fine, first)),
        }
    }

    /// Computes the illuminance of every fine patch by direct light and all its reflections, and the difference of its
    /// mean over the coarse patch from the solution with the coarse patches alone. \[lx\] `first`: direct illuminance
    /// of the fine patches \[lx\].
    pub fn illuminance(&self, first: &[f64]) -> Vec<(f64, f64)> {
        let received = |level: &MeshBalance, mesh: &Mesh, first: &[f64]| -> Vec<f64> {
            first.iter().zip(level.after_reflection(mesh, first)).map(|(e, r)| e + r).collect()
        };
        let fine = received(&self.level, &self.nested.fine, first);
        let coarse = received(&self.coarser, &self.nested.coarse, &self.level.means(&self.nested.fine, first));
        let means = self.level.means(&self.nested.fine, &fine);
        fine.into_iter().zip(&self.level.holder).map(|(e, &holder)| (e, means[holder] - coarse[holder])).collect()
    }

    /// Returns weights a of the fine patches' direct illuminance with Σ gather·exitance = Σ a·first, for each weighted
    /// sum over the exitances of the fine patches (weights `gather`, one list per sum). One solution serves every
    /// distribution of direct light.
    pub fn adjoint_fine(&self, gather: &[&[f64]]) -> Vec<Vec<f64>> {
        self.level.adjoint(&self.nested.fine, gather)
    }

    /// Returns weights of the fine patches' direct illuminance, like [`Self::adjoint_fine`], for weighted sums over the
    /// exitances of the coarse patches, computed on the coarse and coarser meshes.
    pub fn adjoint_coarse(&self, gather: &[&[f64]]) -> Vec<Vec<f64>> {
        let coarse = self.coarser.adjoint(&self.nested.coarse, gather);
        coarse.iter().map(|weights| self.level.spread(&self.nested.fine, weights)).collect()
    }

    /// Returns the part of the weights of [`Self::adjoint_fine`] by light that was reflected only once.
    pub fn once_fine(&self, gather: &[f64]) -> Vec<f64> {
        once(&self.nested.fine, gather)
    }

    /// Returns the part of the weights of [`Self::adjoint_coarse`] by light that was reflected only once.
    pub fn once_coarse(&self, gather: &[f64]) -> Vec<f64> {
        self.level.spread(&self.nested.fine, &once(&self.nested.coarse, gather))
    }

    /// Returns values on the fine patches, each replaced by the mean over the coarse patch that contains it.
    pub fn blurred(&self, values: &[f64]) -> Vec<f64> {
        let means = self.level.means(&self.nested.fine, values);
        self.level.holder.iter().map(|&holder| means[holder]).collect()
    }

    /// Computes the mean illuminance of every fine patch by the aperture with index `aperture`, with a uniform
    /// Lambertian exitance of 1 lm/m², without reflection. \[lx\]
    pub fn illuminance_from_aperture(&self, aperture: usize) -> Vec<f64> {
        let mut first = vec![0.0; self.nested.fine.patches.len()];
        for (i, emitter) in self.nested.coarse.patches.iter().enumerate() {
            if emitter.aperture == Some(aperture) {
                for (e, af) in first.iter_mut().zip(self.level.exchange.row(i)) {
                    *e += af;
                }
            }
        }
        for (e, patch) in first.iter_mut().zip(&self.nested.fine.patches) {
            *e /= patch.area;
        }
        first
    }
}

fn once(mesh: &Mesh, gather: &[f64]) -> Vec<f64> {
    mesh.patches.iter().zip(gather).map(|(patch, g)| patch.reflectance * g).collect()
}

impl MeshBalance {
    /// Creates the equations between the patches of `receivers`; `None` if they are singular. `holder`: index of the
    /// receiving patch that contains each emitting patch.
    fn new(exchange: Arc<Exchange>, receivers: &Mesh, holder: &[usize]) -> Option<Self> {
        let area: Vec<f64> = receivers.patches.iter().map(|patch| patch.area).collect();
        let reflectance: Vec<f64> = receivers.patches.iter().map(|patch| patch.reflectance).collect();
        let active: Vec<usize> = (0..area.len()).filter(|&i| reflectance[i] > 0.0).collect();
        let factor = if active.is_empty() {
            None
        } else {
            let square = exchange.gathered(None, area.len(), holder, area.len());
            // One thread, because the result must not depend on the number of threads.
            faer::set_global_parallelism(faer::Par::Seq);
            let matrix = Mat::from_fn(active.len(), active.len(), |r, c| {
                // Only the lower half is used; its transpose differs by rounding.
                let (i, j) = (active[r.max(c)], active[r.min(c)]);
                let diagonal = if i == j { area[i] / reflectance[i] } else { 0.0 };
                diagonal - square.row(i)[j]
            });
            Some(matrix.llt(Side::Lower).ok()?)
        };
        Some(Self { exchange, area, reflectance, holder: holder.to_vec(), active, factor })
    }

    /// Returns the means over the receiving patches of values on the emitting ones.
    fn means(&self, emitters: &Mesh, values: &[f64]) -> Vec<f64> {
        let mut means = vec![0.0; self.area.len()];
        for ((patch, &holder), value) in emitters.patches.iter().zip(&self.holder).zip(values) {
            means[holder] += patch.area * value;
        }
        means.iter_mut().zip(&self.area).for_each(|(mean, area)| *mean /= area);
        means
    }

    /// Returns weights of the emitting patches from weights of the receiving ones: the transpose of [`Self::means`].
    fn spread(&self, emitters: &Mesh, weights: &[f64]) -> Vec<f64> {
        emitters.patches.iter().zip(&self.holder).map(|(patch, &i)| patch.area / self.area[i] * weights[i]).collect()
    }

    /// Returns weights of E₀ with Σ weight·E₀ = Σ gather·ρ(E₀ + R), for every list of `gather`: the adjoint of
    /// [`Self::after_reflection`].
    fn adjoint(&self, emitters: &Mesh, gather: &[&[f64]]) -> Vec<Vec<f64>> {
        // h = ρ gather weighs both E₀ and R. Without any active patch R is 0.
        let mut results: Vec<Vec<f64>> = gather.iter().map(|gather| once(emitters, gather)).collect();
        let Some(factor) = &self.factor else {
            return results;
        };
        // One thread, because the result must not depend on the number of threads.
        faer::set_global_parallelism(faer::Par::Seq);
        // The last forward step shifts the fine patches to the mean of the balance. Backwards, the summed weight of a
        // receiving patch's fine patches therefore goes to that mean, b/ρ, and is subtracted from the mean of the
        // exchange alone. Black patches have no such step.
        let held: Vec<Vec<f64>> = results.iter().map(|result| self.held(result)).collect();
        let before = Mat::from_fn(emitters.patches.len(), results.len(), |k, sum| {
            let i = self.holder[k];
            results[sum][k] / emitters.patches[k].area - held[sum][i] / self.area[i]
        });
        // u = AF (h/a − held/A): weights of the exitance that the forward step distributes to the fine patches.
        let exitance = self.exchange.matrix() * before;
        // b counts as exitance and, over ρ, as mean. (A/ρ − AF) is symmetric: the same factorisation solves backwards,
        // and its solution weighs A E₁. The forward limit b ≥ 0 only removes rounding and is left out here.
        let solution = factor.solve(&Mat::from_fn(self.active.len(), results.len(), |r, sum| {
            let i = self.active[r];
            exitance[(i, sum)] + held[sum][i] / self.reflectance[i]
        }));
        let mut once = Mat::zeros(self.area.len(), results.len());
        for (r, &i) in self.active.iter().enumerate() {
            once.row_mut(i).copy_from(solution.row(r));
        }
        // A E₁ = AF ρE₀ read backwards: by the transpose to the emitting patches, whose ρ follows below.
        let emitted = self.exchange.matrix().transpose() * once;
        for (sum, result) in results.iter_mut().enumerate() {
            // The exitance of a receiving patch also contains ρ times the mean of E₀.
            let means: Vec<f64> =
                self.reflectance.iter().enumerate().map(|(i, rho)| exitance[(i, sum)] * rho).collect();
            let by_means = self.spread(emitters, &means);
            for (k, (value, patch)) in result.iter_mut().zip(&emitters.patches).enumerate() {
                *value += patch.reflectance * emitted[(k, sum)] + by_means[k];
            }
        }
        results
    }

    /// Returns the sums of weights of emitting patches over the receiving patches that reflect.
    fn held(&self, weights: &[f64]) -> Vec<f64> {
        let mut held = vec![0.0; self.area.len()];
        for (h, &holder) in weights.iter().zip(&self.holder).filter(|(_, holder)| self.reflectance[**holder] > 0.0) {
            held[holder] += h;
        }
        held
    }

    /// Computes the interreflected illuminance R of the emitting patches from their direct illuminance E₀.
    fn after_reflection(&self, emitters: &Mesh, first: &[f64]) -> Vec<f64> {
        let mut result = vec![0.0; first.len()];
        let Some(factor) = &self.factor else {
            return result;
        };
        let emitted: Vec<f64> = emitters.patches.iter().zip(first).map(|(patch, e)| patch.reflectance * e).collect();
        // A·E₁
        let once: Vec<f64> = (0..self.area.len()).map(|i| dot(self.exchange.row(i), &emitted)).collect();
        let rhs = Mat::from_fn(self.active.len(), 1, |r, _| once[self.active[r]]);
        let solution = factor.solve(&rhs);
        // Exitance of the receiving patches by E₀ + R.
        let mut exitance: Vec<f64> =
            self.means(emitters, first).iter().zip(&self.reflectance).map(|(e, rho)| rho * e).collect();
        let mut returned = vec![0.0; self.area.len()];
        for (r, &i) in self.active.iter().enumerate() {
            let b = solution[(r, 0)].max(0.0);
            exitance[i] += b;
            returned[i] = b / self.reflectance[i];
        }
        for (i, b) in exitance.iter().enumerate() {
            if *b != 0.0 {
                for (r, af) in result.iter_mut().zip(self.exchange.row(i)) {
                    *r += af * b;
                }
            }
        }
        // The means remain those of the balance, which uses E₁ of the fine patches.
        let mut shift = vec![0.0; self.area.len()];
        for ((r, patch), &holder) in result.iter_mut().zip(&emitters.patches).zip(&self.holder) {
            shift[holder] += *r;
            *r /= patch.area;
        }
        for (i, shift) in shift.iter_mut().enumerate() {
            *shift = if self.reflectance[i] > 0.0 { returned[i] - *shift / self.area[i] } else { 0.0 };
        }
        for (r, &holder) in result.iter_mut().zip(&self.holder) {
            *r += shift[holder];
        }
        result
    }
}

#[cfg(test)]
mod tests {
    use super::super::aperture::Aperture;
    use super::super::mesh::BoxRoom;
    use super::*;
    use crate::compute::direction::Surface;
    use glam::DVec3;

    fn room(rho: f64) -> BoxRoom {
        BoxRoom { size: DVec3::new(4.0, 6.0, 3.0), floor: rho, walls: rho, ceiling: rho }
    }

    fn window() -> Aperture {
        Aperture { surface: Surface::Facade, corner: DVec3::new(0.3, 0.0, 0.8), size: [2.5, 1.7] }
    }

    fn radiosity(room: &BoxRoom, apertures: &[Aperture], rho: f64, count: usize) -> Radiosity {
        let reflectances = vec![rho; apertures.len()];
        let nested = Nested::with_about(room, apertures, &reflectances, count).unwrap();
        Radiosity::alone(nested).unwrap()
    }

    #[test]
    fn every_patch_sees_the_whole_room() {
        for size in [[4.0, 6.0, 3.0], [100.0, 1.0, 1.0], [0.1, 0.1, 10.0]] {
            let room = BoxRoom { size: DVec3::from_array(size), ..room(0.5) };
            let Radiosity { nested, level, .. } = radiosity(&room, &[], 0.0, 600);
            for (i, patch) in nested.coarse.patches.iter().enumerate() {
                let closure = level.exchange.row(i).iter().sum::<f64>() / patch.area;
                assert!((closure - 1.0).abs() < 1e-9, "{size:?}: {closure}");
            }
        }
    }

    #[test]
    fn uniform_light_and_reflectance_give_the_infinite_series() {
        // E = E₀/(1 − ρ) everywhere, in any box, when E₀ and ρ are the same everywhere.
        for rho in [0.3, 0.9, 0.99, 0.999] {
            let radiosity = radiosity(&room(rho), &[window()], rho, 500);
            let patches = radiosity.nested.fine.patches.len();
            let exitance = radiosity.exitance(&vec![100.0; patches]);
            for b in exitance.fine.iter().chain(&exitance.coarse) {
                assert!((b / rho * (1.0 - rho) / 100.0 - 1.0).abs() < 1e-8, "{rho}: {b}");
            }
        }
    }

    #[test]
    fn illuminance_is_exitance_over_reflectance_and_known_on_black_patches_too() {
        let floor_black = BoxRoom { floor: 0.0, ..room(0.6) };
        let radiosity = radiosity(&floor_black, &[window()], 0.3, 500);
        let mesh = &radiosity.nested.fine;
        let first: Vec<f64> = mesh.patches.iter().map(|patch| 10.0 + patch.extent[0][0] + patch.extent[1][1]).collect();
        let received = radiosity.illuminance(&first);
        let exitance = radiosity.exitance(&first).fine;
        let (mut falling, mut leaving) = (0.0, 0.0);
        for (((patch, e0), (e, _)), b) in mesh.patches.iter().zip(&first).zip(&received).zip(&exitance) {
            assert!((patch.reflectance * e - b).abs() < 1e-9 * (1.0 + b));
            assert!(e > e0);
            falling += patch.area * (e - e0);
            leaving += patch.area * b;
        }
        // All that leaves a surface falls on one; black patches know the first light by its means over coarse ones.
        assert!((falling / leaving - 1.0).abs() < 1e-3, "{falling} {leaving}");
    }

    #[test]
    fn read_backwards_it_gives_the_same_sums() {
        let uneven = BoxRoom { floor: 0.2, walls: 0.6, ceiling: 0.0, ..room(0.5) };
        let radiosity = radiosity(&uneven, &[window()], 0.3, 500);
        let noise = |n: usize, seed: u64| -> Vec<f64> {
            let mut x = seed;
            let mut next = || {
                x = x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (x >> 33) as f64 / f64::from(u32::MAX)
            };
            (0..n).map(|_| next()).collect()
        };
        let (fine, coarse) = (radiosity.nested.fine.patches.len(), radiosity.nested.coarse.patches.len());
        for seed in 1..4 {
            let first = noise(fine, seed);
            let exitance = radiosity.exitance(&first);
            let (a, b) = (noise(fine, seed + 10), noise(coarse, seed + 20));
            for (forwards, backwards) in [
                (dot(&a, &exitance.fine), dot(&radiosity.adjoint_fine(&[&a])[0], &first)),
                (dot(&b, &exitance.coarse), dot(&radiosity.adjoint_coarse(&[&b])[0], &first)),
            ] {
                assert!((forwards / backwards - 1.0).abs() < 1e-11, "{forwards} {backwards}");
            }
        }
    }

    #[test]
    fn flux_that_enters_is_absorbed() {
        for rho in [0.7, 0.99, 0.999] {
            let radiosity = radiosity(&room(rho), &[window()], 0.2, 700);
            let mut first = radiosity.illuminance_from_aperture(0);
            first.iter_mut().for_each(|e| *e *= 1000.0);
            let exitance = radiosity.exitance(&first);
            let absorbed: f64 = radiosity
                .nested
                .fine
                .patches
                .iter()
                .zip(&exitance.fine)
                .map(|(patch, b)| patch.area * b / patch.reflectance * (1.0 - patch.reflectance))
                .sum();
            assert!((absorbed / (1000.0 * window().area()) - 1.0).abs() < 1e-9, "{rho}: {absorbed}");
        }
    }

    #[test]
    fn one_surface_that_absorbs_is_enough_and_none_is_refused() {
        let mirror = BoxRoom { floor: 0.5, ..room(1.0) };
        let radiosity = radiosity(&mirror, &[], 0.0, 400);
        let patches = &radiosity.nested.fine.patches;
        let exitance = radiosity.exitance(&vec![1.0; patches.len()]);
        let floor: f64 = patches.iter().zip(&exitance.fine).filter(|(p, _)| p.wall == 0).map(|(p, b)| p.area * b).sum();
        // All that enters, 1 lm/m² on every surface, ends in the floor, which absorbs as much as it emits.
        let entered: f64 = patches.iter().map(|patch| patch.area).sum();
        assert!((floor / entered - 1.0).abs() < 1e-9, "{floor} {entered}");
        for rho in [1.0, 0.9995] {
            let nested = Nested::with_about(&room(rho), &[window()], &[rho], 300).unwrap();
            let refused = Radiosity::alone(nested).err().unwrap().to_string();
            assert!(refused.contains("0.999"), "{refused}");
        }
    }
}
