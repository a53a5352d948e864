//! A direction between directions of the data, as every scheme needs it.

use crate::compute::incidence::lattice::Place;
use crate::compute::incidence::model::{Model, Recipe};
use glam::DVec3;

/// A direction between directions of the data.
pub(in crate::compute::incidence) struct Between {
    /// Data directions and their barycentric weights, above 0 and of sum 1.
    pub used: Vec<(usize, f64)>,
    /// The direction itself.
    pub direction: DVec3,
    /// What the model says of it.
    pub recipe: Recipe,
    /// Interpolated τ.
    pub tau: f64,
}

impl Between {
    pub(in crate::compute::incidence) fn new(model: &Model, place: &Place, recipe: Recipe, direction: DVec3) -> Self {
        let mut used: Vec<(usize, f64)> = Vec::with_capacity(3);
        for (&v, w) in place.vertices.iter().zip(place.weights).filter(|(_, w)| *w > 1e-12) {
            match used.iter_mut().find(|(other, _)| *other == v) {
                Some((_, sum)) => *sum += w,
                None => used.push((v, w)),
            }
        }
        let bases: f64 = recipe.bases.iter().map(|base| base.factor * model.base_flux[base.vertex]).sum();
        let tau = bases + recipe.copies.iter().map(|copy| copy.flux).sum::<f64>();
        Self { used, direction, recipe, tau }
    }
}
