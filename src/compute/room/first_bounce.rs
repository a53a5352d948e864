//! What every surface of the room receives directly from an aperture: the right-hand side of the interreflection.

use super::aperture::Aperture;
use super::beam::lit_shares;
use super::direct::{Reception, Sensor};
use super::mesh::Mesh;
use super::radiosity::Radiosity;
use crate::compute::basis::{AzimuthMap, Ring, RingBasis};
use crate::compute::lid::{Emission, Facing};
use crate::compute::quadrature::gauss_legendre;
use crate::compute::sky::{Frame, incident_illuminances_within};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;

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

impl PatchWeights {
    /// Gauss points of `order`² a patch.
    pub fn new(mesh: &Mesh, aperture: &Aperture, basis: Arc<RingBasis>, order: usize) -> Self {
        let rule = gauss_legendre(order);
        let rows: Vec<Vec<f64>> = mesh
            .patches
            .par_iter()
            .map(|patch| {
                let wall = &mesh.walls[patch.wall];
                let mut row = Vec::new();
                for &(s, ws) in &rule {
                    for &(t, wt) in &rule {
                        let [a, b] = patch.extent;
                        let position = wall.point(a[0] + (a[1] - a[0]) * s, b[0] + (b[1] - b[0]) * t);
                        let sensor = Sensor { position, normal: wall.normal };
                        if aperture.view(position, wall.normal).is_none() {
                            continue;
                        }
                        let reception = Reception::new(&sensor, aperture, Some(&basis));
                        if row.is_empty() {
                            row = vec![0.0; basis.len()];
                        }
                        for (sum, weight) in row.iter_mut().zip(&reception.cells) {
                            *sum += ws * wt * weight;
                        }
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
    fn illuminance(&self, luminance: &[f64]) -> (Vec<f64>, f64) {
        let received: f64 = self.received.iter().zip(luminance).map(|(r, l)| r * l).sum();
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
        let first = self.rows.iter().map(|row| scale * row.iter().zip(luminance).map(|(w, l)| w * l).sum::<f64>());
        (first.collect(), (scale - 1.0).abs())
    }
}

/// Relative accuracy of the light of [`through_basis`]'s cells; their size costs more.
const THROUGH_ACCURACY: f64 = 1e-4;

/// The cells in which the outside seen straight through is handed to the patches: about 400, of equal projected solid
/// angle but for finer ones around the normal, where the far end of a deep room looks; their borders hold the façade's
/// horizon. Sensors see the outside unquantised.
pub fn through_basis() -> RingBasis {
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
    RingBasis::new("through", rings, AzimuthMap::FACADE).expect("the sines above rise from 0 to 1")
}

/// Mean direct illuminance of every patch from one aperture, and the relative error of its flux. \[lx\]
pub fn first_illuminance(
    radiosity: &Radiosity,
    index: usize,
    aperture: &Aperture,
    emission: &Emission,
    facing: &Facing<'_>,
    weights: &dyn Fn(&Arc<RingBasis>) -> Arc<PatchWeights>,
) -> (Vec<f64>, f64) {
    let mesh = &radiosity.mesh;
    let mut first = vec![0.0; mesh.patches.len()];
    let mut error = 0.0_f64;
    let mut add = |(part, part_error): (Vec<f64>, f64)| {
        for (sum, e) in first.iter_mut().zip(part) {
            *sum += e;
        }
        error = error.max(part_error);
    };
    if emission.uniform.value > 0.0 {
        let emitters: Vec<(usize, f64)> = (0..mesh.patches.len())
            .filter(|&i| mesh.patches[i].aperture == Some(index))
            .map(|i| (i, PI * emission.uniform.value))
            .collect();
        add((radiosity.illuminance_from(&emitters), 0.0));
    }
    if let Some(light) = &emission.cells {
        let luminance: Vec<f64> = light.diffuse.iter().zip(&light.sun).map(|(d, s)| d + s).collect();
        add(weights(&light.basis).illuminance(&luminance));
    }
    if let Some(tau) = &emission.regular {
        let basis = Arc::new(through_basis());
        let frame = Frame::of_aperture(facing.orientation, facing.surface);
        let luminance: Vec<f64> = incident_illuminances_within(facing.outside, &basis, &frame, THROUGH_ACCURACY)
            .into_iter()
            .zip(basis.cells())
            .map(|(e, cell)| {
                let middle = (0.5 * (cell.theta_min.sin().powi(2) + cell.theta_max.sin().powi(2))).sqrt().asin();
                e.value / cell.projected_solid_angle() * tau.at(middle)
            })
            .collect();
        add(weights(&basis).illuminance(&luminance));
        if let Some(sun) = facing.sun_direction().filter(|sun| emission.beam_tau > 0.0 && sun.vector().z > 0.0) {
            let direction = facing.surface.room_dir(sun).vector();
            let flux = emission.beam_tau * emission.incident_sun * aperture.area();
            let shares = lit_shares(mesh, aperture, direction);
            let cosine = |i: usize| mesh.walls[mesh.patches[i].wall].normal.dot(direction).max(0.0);
            let landed: f64 = shares.iter().enumerate().map(|(i, s)| s * mesh.patches[i].area * cosine(i)).sum();
            if landed > 0.0 {
                add((shares.iter().enumerate().map(|(i, s)| s * cosine(i) * flux / landed).collect(), 0.0));
            }
        }
    }
    (first, error)
}
