//! Diffuse light through interpolated indicatrices (eq 12): the outside in sub-patches finer than the incident
//! lattice, each with its own recipe.

use super::grid::Grid;
use super::model::Model;
use crate::compute::basis::{AzimuthMap, Ring, RingBasis};
use crate::compute::direction::{Dir, Facade};
use rayon::prelude::*;

/// Rings of the sub-patches: equal steps of θ, so that borders fall on whole multiples and the horizon of a façade
/// runs between sectors.
pub fn sub_patches(step: f64) -> RingBasis {
    let count = (0.5 * std::f64::consts::PI / step).round().max(1.0) as usize;
    let step = 0.5 * std::f64::consts::PI / count as f64;
    let rings = (0..count)
        .map(|i| {
            let (theta_min, theta_max) = (i as f64 * step, (i + 1) as f64 * step);
            // Sectors about as wide as high, a multiple of four: borders at right, up, left, down.
            let around = 2.0 * std::f64::consts::PI * (0.5 * (theta_min + theta_max)).sin() / step;
            let sectors = 4 * ((around / 4.0).round().max(1.0) as usize);
            Ring { theta_min, theta_max, sectors, first_phi: std::f64::consts::PI / sectors as f64 }
        })
        .collect();
    RingBasis::new("sub-patches", rings, AzimuthMap::FACADE).expect("equal steps rise from 0 to 90°")
}

/// Luminance of the emergent cells from the illuminance through every sub-patch. \[cd/m²\]
pub fn diffuse(model: &Model, patches: &RingBasis, illuminance: &[f64]) -> Vec<f64> {
    let cells = model.grid().basis().len();
    let count = model.lattice().points().len();
    // Fixed chunks: the sum does not depend on the number of threads.
    let parts: Vec<(Vec<f64>, Vec<f64>)> = illuminance
        .par_chunks(512)
        .enumerate()
        .map(|(chunk, list)| {
            let (mut luminance, mut bases) = (vec![0.0; cells], vec![0.0; count]);
            let mut scratch = Vec::new();
            for (k, &e) in list.iter().enumerate().filter(|(_, e)| **e > 0.0) {
                let d: Dir<Facade> = patches.cell(chunk * 512 + k).centre();
                let recipe = model.recipe(d);
                recipe.bases.iter().for_each(|&(v, w)| bases[v] += w * e);
                model.add_copies(&recipe, e, (model.grid(), 1), &mut luminance, &mut scratch);
            }
            (luminance, bases)
        })
        .collect();
    let (mut luminance, mut bases) = (vec![0.0; cells], vec![0.0; count]);
    for (l, b) in parts {
        luminance.iter_mut().zip(l).for_each(|(sum, x)| *sum += x);
        bases.iter_mut().zip(b).for_each(|(sum, x)| *sum += x);
    }
    for (vertex, &e) in bases.iter().enumerate().filter(|(_, e)| **e > 0.0) {
        luminance.iter_mut().zip(model.base(vertex)).for_each(|(sum, q)| *sum += e * q);
    }
    luminance
}

/// Luminance of the emergent cells from the sun. \[cd/m²\]
pub fn sun(model: &Model, direction: Dir<Facade>, illuminance: f64, target: &Grid, points: usize) -> Vec<f64> {
    let mut luminance = vec![0.0; target.basis().len()];
    let parent: Vec<usize> =
        target.centre.iter().map(|&d| model.grid().basis().index(Dir::from_unit(d)).unwrap_or(0)).collect();
    let recipe = model.recipe(direction);
    for &(vertex, w) in &recipe.bases {
        let base = model.base(vertex);
        luminance.iter_mut().zip(&parent).for_each(|(sum, &k)| *sum += illuminance * w * base[k]);
    }
    model.add_copies(&recipe, illuminance, (target, points), &mut luminance, &mut Vec::new());
    luminance
}
