//! Luminance of the room side by interpolated indicatrices: under diffuse light (eq 12) from sub-patches finer than the
//! spacing of the incident directions, and under the sun (eq 16) at its actual position.
//!
//! The luminance has uncertainties, as differences to the luminance with fluxes interpolated linearly; under the sun
//! also to that on the coarser cells of the data, and to that with lobes shifted slightly to the right and upwards.
//! Their integrals at a sensor show how much its illuminance depends on the interpolation between the data.

use super::grid::Grid;
use super::model::{Copy, Model};
use crate::compute::basis::{AzimuthMap, Ring, RingBasis};
use crate::compute::direction::{Dir, Facade};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Luminance of an aperture's room side on emergent cells, and its uncertainties. \[cd/m²\]
#[derive(Debug, Clone, PartialEq)]
pub struct CellLuminance {
    /// Luminance by emergent cell. \[cd/m²\]
    pub luminance: Vec<f64>,
    /// Luminance with simpler (linear) interpolation less `luminance`, by cell. \[cd/m²\]
    pub uncertainty: Vec<f64>,
    /// Further uncertainties under the sun, each by cell: signed differences for lobes shifted along x_F and along y_F
    /// of the façade frame, and the remaining relative uncertainty times the luminance. \[cd/m²\] Empty for diffuse
    /// light, for which such shifts cancel.
    pub shifts: Vec<Vec<f64>>,
}

/// Uncertainty of the centre of an interpolated lobe, in widths of the data's emergent cells. Chosen:
/// `examples/incidence_errors` compares stated and true errors on analytic systems for a range of this, [`SUN_REST`],
/// [`BEYOND`] and [`REST`].
pub const PLACE: f64 = 0.06;
/// Relative uncertainty of the luminance under the sun beside that of the lobes' centres, for any incident direction.
/// Chosen as described at [`PLACE`].
pub const SUN_REST: f64 = 0.012;
/// Additional relative uncertainty of the luminance under the sun at θ = 90°, beyond the largest θ of the data. Chosen
/// as described at [`PLACE`].
pub const BEYOND: f64 = 0.4;
/// Relative error of the luminance by interpolation between incident directions that its uncertainties do not include,
/// for sky and sun. Chosen as described at [`PLACE`].
pub const REST: f64 = 5e-3;

impl CellLuminance {
    /// Creates luminances and uncertainties of 0 on `cells` cells.
    pub fn dark(cells: usize) -> Self {
        Self { luminance: vec![0.0; cells], uncertainty: vec![0.0; cells], shifts: Vec::new() }
    }

    /// Returns the luminance on finer cells: every cell of `target` takes the value of the cell of `own` that holds its
    /// centre.
    pub fn on(self, own: &Grid, target: &Grid) -> Self {
        if own.basis() == target.basis() {
            return self;
        }
        let parent = parents(own, target);
        let copy = |values: &[f64]| parent.iter().map(|&k| values[k]).collect();
        Self { luminance: copy(&self.luminance), uncertainty: copy(&self.uncertainty), shifts: Vec::new() }
    }

    fn add(&mut self, other: &Self) {
        self.luminance.iter_mut().zip(&other.luminance).for_each(|(sum, x)| *sum += x);
        self.uncertainty.iter_mut().zip(&other.uncertainty).for_each(|(sum, x)| *sum += x);
    }
}

/// Returns the index of the cell of `own` that holds the centre of each cell of `target`.
fn parents(own: &Grid, target: &Grid) -> Vec<usize> {
    target.centre.iter().map(|&d| own.basis().index(Dir::from_unit(d)).unwrap_or(0)).collect()
}

/// Creates a basis of cells with sides of about `step` \[rad\]: rings of equal height in θ, divided into sectors with
/// borders at right, up, left and down, so that a façade's horizon runs along borders.
pub fn sub_patches(step: f64) -> RingBasis {
    let count = (0.5 * PI / step).round().max(1.0) as usize;
    let step = 0.5 * PI / count as f64;
    let rings = (0..count)
        .map(|i| {
            let (theta_min, theta_max) = (i as f64 * step, (i + 1) as f64 * step);
            let around = 2.0 * PI * (0.5 * (theta_min + theta_max)).sin() / step;
            let sectors = 4 * ((around / 4.0).round().max(1.0) as usize);
            Ring { theta_min, theta_max, sectors, first_phi: PI / sectors as f64 }
        })
        .collect();
    RingBasis::new("sub-patches", rings, AzimuthMap::FACADE).expect("equal steps rise from 0 to 90°")
}

/// Number of sub-patches that one thread sums up at a time; constant, so that the sum does not depend on the number of
/// threads. Chosen: cost; another number changes the last digits alone.
const CHUNK: usize = 256;

/// Computes the luminance of the room side on the emergent cells of the data under diffuse light. `illuminance`:
/// illuminance of the aperture from every cell of `patches` \[lx\].
pub fn diffuse(model: &Model, patches: &RingBasis, illuminance: &[f64]) -> CellLuminance {
    // Lobes of sub-patches with a negligible share of the illuminance are left out.
    let least = 1e-9 * illuminance.iter().sum::<f64>();
    let parts: Vec<(CellLuminance, Vec<[f64; 2]>)> = illuminance
        .par_chunks(CHUNK)
        .enumerate()
        .map(|(chunk, list)| chunk_of_diffuse(model, patches, chunk * CHUNK, list, least))
        .collect();
    let count = model.lattice().points().len();
    let (mut light, mut bases) = (CellLuminance::dark(model.grid().basis().len()), vec![[0.0; 2]; count]);
    for (part, own) in parts {
        light.add(&part);
        bases.iter_mut().zip(own).for_each(|(sum, x)| *sum = [sum[0] + x[0], sum[1] + x[1]]);
    }
    // Bases are not shifted: each is added once, with the illuminance from all its sub-patches.
    for (vertex, &[e, uncertainty]) in bases.iter().enumerate().filter(|(_, e)| e[0] > 0.0) {
        for (cell, q) in model.base(vertex).into_iter().enumerate() {
            light.luminance[cell] += e * q;
            light.uncertainty[cell] += uncertainty * q;
        }
    }
    light
}

/// Computes the luminance of the lobes under light from the sub-patches `first` and following; also the weighted
/// illuminance by which every base is multiplied, and its uncertainty.
fn chunk_of_diffuse(
    model: &Model,
    patches: &RingBasis,
    first: usize,
    list: &[f64],
    least: f64,
) -> (CellLuminance, Vec<[f64; 2]>) {
    let mut light = CellLuminance::dark(model.grid().basis().len());
    let mut bases = vec![[0.0; 2]; model.lattice().points().len()];
    let mut scratch = Vec::new();
    for (k, &e) in list.iter().enumerate().filter(|(_, e)| **e > least) {
        let d: Dir<Facade> = patches.cell(first + k).centre();
        let recipe = model.recipe(d);
        for base in &recipe.bases {
            bases[base.vertex][0] += base.factor * e;
            bases[base.vertex][1] += (base.linear - base.factor) * e;
        }
        for copy in &recipe.copies {
            // The lobe has the same cells with either flux, so that its uncertainty is its luminance times a factor.
            let uncertainty = copy.linear / copy.flux - 1.0;
            // One direction per cell is enough, because the sum over many sub-patches is smooth.
            model.moved(copy, model.grid(), 1, &mut scratch);
            for &(cell, q) in &scratch {
                light.luminance[cell as usize] += e * q;
                light.uncertainty[cell as usize] += e * q * uncertainty;
            }
        }
    }
    (light, bases)
}

/// Computes the luminance of the room side on the cells of `target` (which subdivide those of the data) under direct
/// sun. `direction`: towards the sun; `illuminance` of the aperture by the sun \[lx\]; lobes are means of `points`²
/// directions per cell.
pub fn sun(model: &Model, direction: Dir<Facade>, illuminance: f64, target: &Grid, points: usize) -> CellLuminance {
    let mut light = CellLuminance::dark(target.basis().len());
    let parent = parents(model.grid(), target);
    let recipe = model.recipe(direction);
    for base in &recipe.bases {
        let q = model.base(base.vertex);
        for (cell, &k) in parent.iter().enumerate() {
            light.luminance[cell] += illuminance * base.factor * q[k];
            light.uncertainty[cell] += illuminance * (base.linear - base.factor) * q[k];
        }
    }
    let mut scratch = Vec::new();
    let mut coarse = Vec::new();
    let mut lobes = CellLuminance::dark(target.basis().len());
    for copy in &recipe.copies {
        model.moved(copy, target, points, &mut scratch);
        for &(cell, q) in &scratch {
            lobes.luminance[cell as usize] += illuminance * q;
            lobes.uncertainty[cell as usize] += illuminance * q * copy.linear / copy.flux;
        }
    }
    if target.basis().len() > parent.len().min(model.grid().basis().len()) {
        // Means over the data's own cells: what they alone can tell.
        coarse.resize(model.grid().basis().len(), [0.0; 2]);
        for (cell, &k) in parent.iter().enumerate() {
            coarse[k][0] += lobes.uncertainty[cell] * target.projected[cell];
            coarse[k][1] += target.projected[cell];
        }
        for (cell, &k) in parent.iter().enumerate() {
            lobes.uncertainty[cell] = coarse[k][0] / coarse[k][1];
        }
    }
    for (cell, l) in lobes.luminance.iter().enumerate() {
        light.luminance[cell] += l;
        light.uncertainty[cell] += lobes.uncertainty[cell] - l;
    }
    let reach = PLACE * (2.0 * PI / model.grid().basis().len() as f64).sqrt();
    for axis in [DVec3::X, DVec3::Y] {
        let mut shift: Vec<f64> = lobes.luminance.iter().map(|l| -l).collect();
        for copy in &recipe.copies {
            let across = (axis - copy.centre * axis.dot(copy.centre)).normalize_or_zero();
            let centre = (copy.centre + across * reach).normalize_or(copy.centre);
            if centre.z <= 0.0 {
                continue;
            }
            model.moved(&Copy { centre, ..*copy }, target, 1, &mut scratch);
            scratch.iter().for_each(|&(cell, q)| shift[cell as usize] += illuminance * q);
        }
        light.shifts.push(shift);
    }
    let rest = SUN_REST + BEYOND * model.lattice().locate(direction).beyond;
    light.shifts.push(light.luminance.iter().map(|l| rest * l).collect());
    light
}
