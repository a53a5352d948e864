//! Weights of the luminances of an aperture, by emergent cell, in the illuminance of the room's patches.

use super::aperture::Aperture;
use super::direct::{Reception, Sensor};
use super::mesh::{Mesh, Patch, Wall};
use super::nodes::Nodes;
use crate::compute::basis::{AzimuthMap, Resampling, Ring, RingBasis};
use crate::compute::dot::dot;
use crate::compute::quadrature::gauss_legendre;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Weights W of the luminances of an aperture by emergent cell in the mean illuminance of each fine patch, E_patch = Σ
/// W_cell · L_cell. \[sr\] They depend on geometry only and are shared by all skies.
pub struct PatchWeights {
    /// Basis of the emergent cells.
    pub basis: Arc<RingBasis>,
    /// Number of patches of the room.
    patches: usize,
    /// Patches that see the aperture's room side, in rising order.
    seeing: Vec<usize>,
    /// Weights by cell of every patch in `seeing`, patch after patch.
    weights: Vec<f64>,
    /// Flux that the room's patches receive from each cell, relative to the flux that leaves the aperture into the
    /// cell. Illuminances are divided by it so that the flux is exact; its deviation from 1 shows the error of the
    /// points on the patches.
    closure: Vec<f64>,
    /// Σ over the patches of area · weight, by cell. \[m²sr\]
    received: Vec<f64>,
}

/// Returns the number of Gauss points along each side of a patch: one if the patch is small compared with its distance
/// from the aperture, up to three beside the aperture.
pub(super) fn points_a_side(patch: &Patch, wall: &Wall, aperture: &Aperture) -> usize {
    let [low, _, high, _] = patch.corners(wall);
    let centre = 0.5 * (low + high);
    let corners = aperture.corners();
    let nearest = centre.clamp(corners[0].min(corners[2]), corners[0].max(corners[2]));
    // The slack keeps rounding from deciding, so that results do not depend on the unit of length.
    let ratio = (high - low).length() / centre.distance(nearest) - 1e-9;
    match ratio {
        r if r < 0.35 => 1,
        r if r < 1.0 => 2,
        _ => 3,
    }
}

/// Returns Gauss points of a patch in the room's frame \[m\] with their shares of its area. `order`: number of points
/// per side.
pub(super) fn samples<'a>(
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

/// Returns the Gauss rules with 0 to `most` points.
pub(super) fn rules(most: usize) -> Vec<Vec<(f64, f64)>> {
    (0..=most).map(gauss_legendre).collect()
}

impl PatchWeights {
    /// Returns the memory that its weights take. \[bytes\]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.weights[..])
    }

    /// Returns the patches that see the aperture's room side, each with its weights by cell.
    fn rows(&self) -> impl Iterator<Item = (usize, &[f64])> {
        self.seeing.iter().copied().zip(self.weights.chunks_exact(self.basis.len()))
    }

    /// Computes the weights for an aperture and the emergent cells of a basis, for all patches that see the aperture's
    /// room side.
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
        Self::closed(mesh, aperture.area(), basis, rows.into_iter())
    }

    /// Creates the weights from a row for each patch, which is empty if the patch does not see the aperture's room
    /// side, and computes the ratio of received and emitted flux; `area`: area of the aperture that emits. \[m²\]
    fn closed(mesh: &Mesh, area: f64, basis: Arc<RingBasis>, rows: impl Iterator<Item = impl AsRef<[f64]>>) -> Self {
        let mut received = vec![0.0; basis.len()];
        let (mut seeing, mut weights) = (Vec::new(), Vec::new());
        for (index, (row, patch)) in rows.zip(&mesh.patches).enumerate() {
            let row = row.as_ref();
            if !row.is_empty() {
                seeing.push(index);
                weights.extend_from_slice(row);
            }
            for (sum, weight) in received.iter_mut().zip(row) {
                *sum += patch.area * weight;
            }
        }
        weights.shrink_to_fit();
        let closure = basis.cells().zip(&received).map(|(cell, r)| r / (area * cell.projected_solid_angle())).collect();
        Self { basis, patches: mesh.patches.len(), seeing, weights, closure, received }
    }

    /// Computes weights for luminances that vary over the aperture, one set for each node: for a luminance that is 1 at
    /// this node, 0 at the others, and interpolated by the polynomials of `nodes` between them.
    pub fn by_node(mesh: &Mesh, aperture: &Aperture, basis: &Arc<RingBasis>, nodes: &Nodes) -> Vec<Self> {
        let (rules, count) = (rules(3), nodes.count());
        let of = |patch: &Patch| {
            let wall = &mesh.walls[patch.wall];
            let mut rows = vec![Vec::new(); count];
            for (position, share) in samples(patch, wall, &rules, points_a_side(patch, wall, aperture)) {
                let Some(view) = aperture.view(position, wall.normal) else { continue };
                let reception = Reception::new(&Sensor { position, normal: wall.normal }, aperture, Some(basis));
                let mut seen = vec![0.0; basis.len() * count];
                nodes.add_seen(&view, basis, &mut seen);
                let all: f64 = seen.iter().sum();
                let mean: Vec<f64> =
                    (0..count).map(|node| seen[node..].iter().step_by(count).sum::<f64>() / all).collect();
                for (cell, counts) in reception.cells.iter().enumerate().filter(|(_, counts)| **counts != 0.0) {
                    let own = &seen[cell * count..(cell + 1) * count];
                    let sum: f64 = own.iter().sum();
                    for (node, row) in rows.iter_mut().enumerate() {
                        row.resize(basis.len(), 0.0);
                        row[cell] += share * counts * if sum > 0.0 { own[node] / sum } else { mean[node] };
                    }
                }
            }
            rows
        };
        let by_patch: Vec<Vec<Vec<f64>>> = mesh.patches.par_iter().map(of).collect();
        let of_node = |(node, part): (usize, f64)| {
            let rows = by_patch.iter().map(|rows| &rows[node]);
            Self::closed(mesh, part * aperture.area(), Arc::clone(basis), rows)
        };
        nodes.parts().into_iter().enumerate().map(of_node).collect()
    }

    /// Computes the mean illuminance of every patch from the luminance of every cell \[cd/m²\], scaled so that the room
    /// receives exactly the flux that leaves the aperture \[lx\], and the relative change by that scaling.
    pub fn illuminance(&self, luminance: &[f64]) -> (Vec<f64>, f64) {
        let received = dot(&self.received, luminance);
        if received <= 0.0 {
            return (vec![0.0; self.patches], 0.0);
        }
        let left: f64 = self
            .received
            .iter()
            .zip(&self.closure)
            .zip(luminance)
            .map(|((r, c), l)| if *c > 0.0 { r / c * l } else { 0.0 })
            .sum();
        let scale = left / received;
        let mut first = vec![0.0; self.patches];
        self.rows().for_each(|(patch, row)| first[patch] = scale * dot(row, luminance));
        (first, (scale - 1.0).abs())
    }

    /// Returns, for each list of weights of the patches' illuminances, the weights of the cells' luminances that give
    /// the same sum; the flux of every cell is scaled to be exact separately.
    pub fn gathered(&self, weights: &[&[f64]]) -> Vec<Vec<f64>> {
        let by_patch = MatRef::from_column_major_slice(&self.weights, self.basis.len(), self.seeing.len());
        let weights = Mat::from_fn(self.seeing.len(), weights.len(), |row, list| weights[list][self.seeing[row]]);
        let mut sums = Mat::zeros(self.basis.len(), weights.ncols());
        // One thread, because the result must not depend on the number of threads.
        matmul(sums.as_mut(), Accum::Replace, by_patch, weights.as_ref(), 1.0, Par::Seq);
        let closed = |(sum, c): (&f64, &f64)| if *c > 0.0 { sum / c } else { 0.0 };
        sums.col_iter().map(|sums| sums.iter().zip(&self.closure).map(closed).collect()).collect()
    }

    /// Returns the mean relative difference between received and emitted flux over the cells before the scaling,
    /// weighted by flux.
    pub fn gap(&self) -> f64 {
        let received: f64 = self.received.iter().sum();
        let gaps = self.received.iter().zip(&self.closure).filter(|(_, c)| **c > 0.0);
        if received > 0.0 { gaps.map(|(r, c)| r * (1.0 / c - 1.0).abs()).sum::<f64>() / received } else { 0.0 }
    }

    /// Returns, for every cell, the weights of the patches' exitances in the illuminance of the aperture's room side
    /// from this cell, the factors of [`Self::falling_back`].
    pub fn falling(&self, mesh: &Mesh, aperture: &Aperture) -> Vec<Vec<f64>> {
        let scale = 1.0 / (PI * aperture.area());
        let of_cell = |(cell, &closure): (usize, &f64)| {
            let mut shares = vec![0.0; self.patches];
            if closure > 0.0 {
                self.rows().for_each(|(k, row)| shares[k] = mesh.patches[k].area * scale * row[cell] / closure);
            }
            shares
        };
        self.closure.par_iter().enumerate().map(of_cell).collect()
    }

    /// Computes the mean illuminance of the aperture's room side by the patches, by cell of the direction that the
    /// light comes from. \[lx\] `exitance`: of every patch \[lm/m²\]. A cell contains the directions, z > 0 in the
    /// façade frame, in which the light travels.
    pub fn falling_back(&self, mesh: &Mesh, aperture: &Aperture, exitance: &[f64]) -> Vec<f64> {
        let mut incident = vec![0.0; self.basis.len()];
        for (patch, row) in self.rows() {
            let flux = mesh.patches[patch].area * exitance[patch];
            if flux > 0.0 {
                incident.iter_mut().zip(row).for_each(|(sum, weight)| *sum += flux * weight);
            }
        }
        let scale = 1.0 / (PI * aperture.area());
        incident.iter().zip(&self.closure).map(|(e, c)| if *c > 0.0 { e * scale / c } else { 0.0 }).collect()
    }
}

/// Maximum number of emergent cells in the weights for patches; more are merged, because the patches do not resolve
/// them. Chosen: cost; above the 420 cells that they are merged into.
pub const MOST_CELLS: usize = 600;

/// Creates the basis of [`merged_cells`].
fn merged_basis() -> RingBasis {
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

/// Returns the 420 emergent cells into which finer bases are merged: of about equal projected solid angle, with finer
/// ones around the normal, for the far end of a deep room; the façade's horizon runs along their borders.
pub fn merged_cells() -> &'static Arc<RingBasis> {
    static CELLS: OnceLock<Arc<RingBasis>> = OnceLock::new();
    CELLS.get_or_init(|| Arc::new(merged_basis()))
}

/// Number of bases whose resampling to the merged cells is cached; the oldest is removed first. Chosen: cost only, no
/// effect on results.
const MERGINGS: usize = 4;

/// Returns the resampling from the cells of a basis to those of [`merged_cells`]; it is cached, because the same few
/// bases are needed for every position of the sun.
pub fn merging(basis: &Arc<RingBasis>) -> Arc<Resampling> {
    static KEPT: Mutex<Vec<(Arc<RingBasis>, Arc<Resampling>)>> = Mutex::new(Vec::new());
    // The cache is valid even if another thread panicked while it held the lock.
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
