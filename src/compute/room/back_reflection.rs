//! Light that an aperture reflects back into the room, by direction (second term of eq 4): illuminance of its room side
//! by the room's patches, by incident cell, times the room-side BRDF of its dataset.
//!
//! The geometry is that of the direct light of the aperture, reversed: a patch of unit exitance sends as much flux to
//! the aperture through a cell as it would receive through that cell. The illuminance of the aperture's room side is
//! assumed to be uniform, like its emission.

use super::aperture::Aperture;
use super::mesh::Mesh;
use super::patch_weights::PatchWeights;
use super::radiosity::{Exitance, Radiosity};
use crate::compute::btdf::{CellMatrix, Scattered};
use crate::compute::direction::Dir;
use crate::compute::dot::add_scaled;
use faer::Mat;
use faer::linalg::solvers::Solve;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;

/// Maximum number of incident cells of a room-side BRDF; finer data are replaced by diffuse reflection. Chosen: cost,
/// because each cell needs a solution of the room's interreflection; several times the 145 cells of Klems. No test of
/// its own.
const MOST_CELLS: usize = 600;

/// Number of cells for which the room's interreflection is solved together. Chosen: cost; results change within their
/// rounding.
const TOGETHER: usize = 64;

/// Room side of one aperture with a BRDF by cells instead of a diffuse reflectance.
pub struct BackReflection<'a> {
    matrix: &'a CellMatrix,
    /// Weights of the aperture's cells in the illuminance of the room's patches, on the incident cells of the matrix.
    weights: Arc<PatchWeights>,
    /// Index of the emergent cell of the matrix for every cell of `weights`.
    source: Vec<usize>,
}

/// Returns the room-side BRDF by cells; `None` if the data have another form or too many cells, so that they are
/// replaced by diffuse reflection.
pub fn reflecting_cells(scattered: Option<&Scattered>) -> Option<&CellMatrix> {
    match scattered {
        Some(Scattered::Cells(matrix)) if matrix.incident().len() <= MOST_CELLS => Some(matrix),
        _ => None,
    }
}

impl<'a> BackReflection<'a> {
    /// Creates the back reflection of an aperture from its room-side BRDF and the weights of its cells in the
    /// illuminance of the room's patches, on the incident cells of `matrix`.
    pub fn new(matrix: &'a CellMatrix, weights: Arc<PatchWeights>) -> Self {
        // Cells of the room-side BRDF hold reflected light by its direction of propagation, mirrored so that a mirror
        // is a diagonal matrix; the weights hold emergent light by the reversed direction: the two differ by half a
        // turn about the normal.
        let source = weights
            .basis
            .cells()
            .map(|cell| {
                let turned = Dir::from_theta_phi(cell.theta(), cell.phi + PI);
                matrix.emergent().index(turned).unwrap_or_default()
            })
            .collect();
        Self { matrix, weights, source }
    }

    /// Computes the luminance of the aperture's room side by reflected light, by cell of [`Self::weights`], from the
    /// exitance of every patch \[lm/m²\]. \[cd/m²\]
    pub fn luminance(&self, mesh: &Mesh, aperture: &Aperture, exitance: &[f64]) -> Vec<f64> {
        let incident = self.weights.falling_back(mesh, aperture, exitance);
        let reflected = self.matrix.luminance(&incident);
        self.source.iter().map(|&cell| reflected[cell]).collect()
    }

    /// Returns the luminance in a cell of [`Self::weights`] per illuminance of the room side from an incident cell.
    /// \[1/sr\]
    fn value(&self, incident: usize, cell: usize) -> f64 {
        self.matrix.value(incident, self.source[cell])
    }

    /// Returns the weights of the aperture's cells in the illuminance of the room's patches.
    pub fn weights(&self) -> &PatchWeights {
        &self.weights
    }
}

/// Apertures with a room-side BRDF by cells ("mirrors"), with their indices.
type Mirrors<'a> = [(usize, BackReflection<'a>)];

/// Computes the interreflection between the room and the apertures with a room-side BRDF, by iteration, for one
/// distribution of direct light. Returns the luminance of every such aperture by cell at equilibrium \[cd/m²\];
/// `exitance` is updated. `first`: direct illuminance of the patches, without light from these apertures \[lx\];
/// `beam`: illuminance of the patches by beams, whose reflection counts here for these apertures only, because the
/// patches' interreflection of it is included elsewhere \[lx\]. For many distributions [`settled`] is cheaper.
pub fn settled_light(
    radiosity: &Radiosity,
    geometry: &[Aperture],
    mirrors: &Mirrors<'_>,
    first: &[f64],
    beam: &[f64],
    exitance: &mut Exitance,
) -> Vec<Vec<f64>> {
    let mesh = &radiosity.nested.fine;
    let brightest = first.iter().copied().fold(0.0, f64::max);
    let mut returned = vec![0.0; first.len()];
    let mut luminances = Vec::new();
    // Each iteration reduces the change to the share of the light that returns to an aperture, about a tenth.
    for _ in 0..60 {
        let emitted: Vec<f64> =
            mesh.patches.iter().zip(&exitance.fine).zip(beam).map(|((p, b), e)| b + p.reflectance * e).collect();
        luminances =
            mirrors.iter().map(|(index, mirror)| mirror.luminance(mesh, &geometry[*index], &emitted)).collect();
        let mut next = vec![0.0; first.len()];
        for ((_, mirror), luminance) in mirrors.iter().zip(&luminances) {
            let (part, _) = mirror.weights().illuminance(luminance);
            next.iter_mut().zip(part).for_each(|(sum, e)| *sum += e);
        }
        let change = next.iter().zip(&returned).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        returned = next;
        let all: Vec<f64> = first.iter().zip(&returned).map(|(a, b)| a + b).collect();
        *exitance = radiosity.exitance(&all);
        if change <= 1e-9 * brightest {
            break;
        }
    }
    luminances
}

/// Illuminance of an aperture's room side by the room, by incident cell, for any BRDF of the room side. It depends on
/// geometry and on the room's reflectances only and is shared by all systems and states with the same cells.
pub struct RoomSide {
    /// Weights of the patches' direct illuminance in the illuminance from each cell, with all reflections except those
    /// by apertures with a BRDF.
    returned: Vec<Vec<f64>>,
    /// Weights of `returned`, stored patch by patch, because beams light few patches.
    by_patch: Vec<f64>,
}

impl RoomSide {
    /// Returns the memory that its weights take. \[bytes\]
    pub fn bytes(&self) -> usize {
        2 * size_of_val(&self.by_patch[..])
    }

    /// Computes the weights for the cells of `weights` of one aperture.
    pub fn new(radiosity: &Radiosity, aperture: &Aperture, weights: &PatchWeights) -> Self {
        let falling = weights.falling(&radiosity.nested.fine, aperture);
        let falling: Vec<&[f64]> = falling.iter().map(Vec::as_slice).collect();
        let returned: Vec<Vec<f64>> =
            falling.par_chunks(TOGETHER).flat_map_iter(|weights| radiosity.adjoint_fine(weights)).collect();
        let patches = 0..returned.first().map_or(0, Vec::len);
        let by_patch = patches.flat_map(|k| returned.iter().map(move |weights| weights[k])).collect();
        Self { returned, by_patch }
    }

    /// Computes the illuminance of the aperture's room side from every cell by light reflected in the room, from the
    /// direct illuminance `first` of the patches. \[lx\]
    pub fn incident(&self, first: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.returned.len()];
        let rows = self.by_patch.chunks_exact(sums.len().max(1));
        rows.zip(first).filter(|(_, e)| **e != 0.0).for_each(|(row, &e)| add_scaled(&mut sums, row, e));
        sums
    }

    /// Computes the illuminance of the aperture's room side per luminance of every cell of an emitting aperture with
    /// the weights `emergent`: a row for each incident cell. \[sr\]
    pub fn by_cells(&self, emergent: &PatchWeights) -> Vec<Vec<f64>> {
        let returned: Vec<&[f64]> = self.returned.iter().map(Vec::as_slice).collect();
        returned.par_chunks(TOGETHER).flat_map_iter(|rows| emergent.gathered(rows)).collect()
    }
}

/// Returns the matrix (1 − R G)⁻¹ R that gives the luminances l of the cells of all apertures with a room-side BRDF
/// from the illuminances e from their incident cells: l = R (e + G l), with R the BRDF by cells, and G the illuminance
/// from cells that these luminances cause by way of the room. It solves [`settled_light`] once for all distributions of
/// direct light. `again`: G, by index of the illuminated and of the emitting aperture.
pub fn settled(mirrors: &Mirrors<'_>, again: &[Vec<Arc<Vec<Vec<f64>>>>]) -> Mat<f64> {
    let counts: Vec<usize> = mirrors.iter().map(|(_, mirror)| mirror.weights.basis.len()).collect();
    // Index of the mirrored cell and of the cell itself, for every cell of all apertures.
    let cells: Vec<(usize, usize)> =
        counts.iter().enumerate().flat_map(|(mirror, &count)| (0..count).map(move |cell| (mirror, cell))).collect();
    let reflect = Mat::from_fn(cells.len(), cells.len(), |o, i| {
        let ((to, cell), (from, incident)) = (cells[o], cells[i]);
        if to == from { mirrors[to].1.value(incident, cell) } else { 0.0 }
    });
    let again = Mat::from_fn(cells.len(), cells.len(), |i, o| again[cells[i].0][cells[o].0][cells[i].1][cells[o].1]);
    // One thread, because the result must not depend on the number of threads.
    faer::set_global_parallelism(faer::Par::Seq);
    let balance = Mat::<f64>::identity(cells.len(), cells.len()) - &reflect * again;
    balance.partial_piv_lu().solve(&reflect)
}

#[cfg(test)]
mod tests {
    use super::super::mesh::{BoxRoom, Nested};
    use super::*;
    use crate::compute::basis::{AzimuthMap, RingBasis};
    use crate::compute::direction::Surface;
    use glam::DVec3;

    fn setting() -> (Mesh, Aperture, RingBasis) {
        let room = BoxRoom { size: DVec3::new(4.0, 6.0, 3.0), floor: 0.5, walls: 0.5, ceiling: 0.5 };
        let aperture = Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 0.5), size: [3.0, 2.0] };
        let mesh = Nested::with_about(&room, &[aperture], &[0.0], 500).unwrap().fine;
        (mesh, aperture, RingBasis::klems_full(AzimuthMap::KLEMS_BACK))
    }

    fn returned(matrix: &CellMatrix, exitance: impl Fn(&super::super::mesh::Patch) -> f64) -> (Mesh, Vec<f64>, f64) {
        let (mesh, aperture, basis) = setting();
        let weights = Arc::new(PatchWeights::new(&mesh, &aperture, Arc::new(basis)));
        let back = BackReflection::new(matrix, weights);
        let exitance: Vec<f64> = mesh.patches.iter().map(exitance).collect();
        let luminance = back.luminance(&mesh, &aperture, &exitance);
        let (first, _) = back.weights().illuminance(&luminance);
        let incident: f64 = back.weights().falling_back(&mesh, &aperture, &exitance).iter().sum();
        (mesh, first, incident * aperture.area())
    }

    fn mirror(basis: &RingBasis) -> CellMatrix {
        let n = basis.len();
        let mut values = vec![0.0; n * n];
        for (i, cell) in basis.cells().enumerate() {
            values[i * n + i] = 1.0 / cell.projected_solid_angle();
        }
        CellMatrix::new(basis.clone(), basis.clone(), values).unwrap()
    }

    #[test]
    fn a_room_of_even_exitance_lights_its_aperture_evenly_and_gets_all_of_it_back() {
        let (mesh, _, basis) = setting();
        let (_, first, incident) = returned(&mirror(&basis), |_| 100.0);
        assert!((incident / (100.0 * 6.0) - 1.0).abs() < 1e-9, "{incident}");
        let back: f64 = mesh.patches.iter().zip(&first).map(|(patch, e)| patch.area * e).sum();
        assert!((back / incident - 1.0).abs() < 1e-9, "{back} {incident}");
    }

    #[test]
    fn a_mirror_sends_light_from_the_floor_on_upwards_and_from_the_left_to_the_right() {
        let (_, _, basis) = setting();
        let flux = |mesh: &Mesh, first: &[f64], wall: usize| -> f64 {
            mesh.patches.iter().zip(first).filter(|(p, _)| p.wall == wall).map(|(p, e)| p.area * e).sum()
        };
        let (mesh, first, _) = returned(&mirror(&basis), |patch| if patch.wall == 0 { 100.0 } else { 0.0 });
        assert!(flux(&mesh, &first, 1) > 20.0 * flux(&mesh, &first, 0), "ceiling against floor");
        let (mesh, first, _) = returned(&mirror(&basis), |patch| if patch.wall == 2 { 100.0 } else { 0.0 });
        assert!(flux(&mesh, &first, 3) > 20.0 * flux(&mesh, &first, 2), "right against left");
    }
}
