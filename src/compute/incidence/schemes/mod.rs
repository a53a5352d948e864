//! Indicatrix of the sun's direction by four interpolation schemes: lobes shifted by their responses, the default, and
//! the three schemes of the IEA SHC Task 31 report for comparison.
//!
//! A scheme only determines the shape of the indicatrix. Its flux τ is the same for all: a scalar that [`Model`]
//! interpolates with its curvature, imposed exactly. Beyond the border of the data, shapes are those on the border
//! (lobes with responses continue to shift).

mod blend;
mod words;

use super::grid::Grid;
use super::lattice::Place;
use super::model::{Model, Recipe};
use crate::compute::direction::{Dir, Facade};
use blend::Blend;
use glam::{DQuat, DVec3};
pub use words::{DiffuseScheme, SunScheme};

impl SunScheme {
    /// Returns q of the indicatrix that this scheme interpolates for an incident direction, on the cells of `target`;
    /// lobes are means of `points`² directions per cell. Its flux is the interpolated τ. \[1/sr\]
    pub fn coefficient(self, model: &Model, incident: Dir<Facade>, target: &Grid, points: usize) -> Vec<f64> {
        let place = model.lattice.locate(incident);
        Between::new(model, &place, model.recipe(incident), incident).coefficient(self, target, points)
    }
}

/// Incident direction between those of the data, with the weights and the interpolated τ that every scheme uses.
pub(super) struct Between<'a> {
    model: &'a Model,
    /// Indices of the surrounding incident directions of the data and their barycentric weights, above 0 and of sum 1.
    used: Vec<(usize, f64)>,
    direction: DVec3,
    recipe: Recipe,
    /// Interpolated τ.
    tau: f64,
}

impl<'a> Between<'a> {
    /// Prepares the interpolation for `direction`; `place` and `recipe` may be those of the same data without one of
    /// its directions.
    pub(super) fn new(model: &'a Model, place: &Place, recipe: Recipe, direction: Dir<Facade>) -> Self {
        let mut used: Vec<(usize, f64)> = Vec::with_capacity(3);
        for (&v, w) in place.vertices.iter().zip(place.weights).filter(|(_, w)| *w > 1e-12) {
            match used.iter_mut().find(|(other, _)| *other == v) {
                Some((_, sum)) => *sum += w,
                None => used.push((v, w)),
            }
        }
        let bases: f64 = recipe.bases.iter().map(|base| base.factor * model.base_flux[base.vertex]).sum();
        let tau = bases + recipe.copies.iter().map(|copy| copy.flux).sum::<f64>();
        Self { model, used, direction: direction.vector(), recipe, tau }
    }

    /// Returns q of the indicatrix by a scheme on the cells of `target`, with the flux τ. \[1/sr\]
    pub(super) fn coefficient(&self, scheme: SunScheme, target: &Grid, points: usize) -> Vec<f64> {
        let shape = match scheme {
            SunScheme::Responses => Blend::of_recipe(self.model, &self.recipe),
            SunScheme::Nearest => self.nearest(false),
            SunScheme::DisplacedNearest => self.nearest(true),
            SunScheme::Superposed => self.superposed(),
        };
        // Without light at the vertices there is no shape; the model's own indicatrix is then used.
        let own = || Blend::of_recipe(self.model, &self.recipe);
        shape.with_flux(self.tau).unwrap_or_else(own).coefficient(self.model, target, points)
    }

    /// Returns the indicatrix of the nearest incident direction with τ above 0; with `displaced` it is rotated so that
    /// its flux centroid lies in the interpolated one.
    fn nearest(&self, displaced: bool) -> Blend {
        let cosine = |v: usize| self.model.lattice.points()[v].dot(self.direction);
        let open = self.used.iter().map(|&(v, _)| v).filter(|&v| self.model.data.tau_by_direction()[v] > 0.0);
        let Some(v) = open.max_by(|&a, &b| cosine(a).total_cmp(&cosine(b)).then(b.cmp(&a))) else {
            return Blend::default();
        };
        let turn = if displaced { self.turn(v, self.common_centroid()) } else { DQuat::IDENTITY };
        let mut blend = Blend::default();
        blend.push_whole(self.model, v, turn, self.tau);
        blend
    }

    /// Returns the sum of the surrounding indicatrices, each rotated to the interpolated centroid, with their
    /// barycentric weights. Right for one lobe; with two, the centroid lies between them, where there is no light.
    fn superposed(&self) -> Blend {
        let to = self.common_centroid();
        let mut blend = Blend::default();
        for &(v, w) in &self.used {
            blend.push_whole(self.model, v, self.turn(v, to), w * self.model.data.tau_by_direction()[v]);
        }
        blend
    }

    /// Returns the mean direction of the indicatrix of an incident direction, weighted by flux; `None` if its flux is
    /// 0.
    fn centroid(&self, vertex: usize) -> Option<DVec3> {
        let (row, grid) = (self.model.data.row(vertex), &self.model.grid);
        let cells = row.iter().zip(&grid.projected).zip(&grid.centre);
        cells.map(|((q, w), centre)| *centre * (q * w)).sum::<DVec3>().try_normalize()
    }

    /// Returns the weighted mean of the flux centroids; `None` where they cancel.
    fn common_centroid(&self) -> Option<DVec3> {
        let sum: DVec3 = self.used.iter().filter_map(|&(v, w)| self.centroid(v).map(|c| c * w)).sum();
        sum.try_normalize().filter(|_| sum.length() > 1e-9)
    }

    fn turn(&self, vertex: usize, to: Option<DVec3>) -> DQuat {
        match (self.centroid(vertex), to) {
            (Some(from), Some(to)) => DQuat::from_rotation_arc(from, to),
            _ => DQuat::IDENTITY,
        }
    }
}

#[cfg(test)]
mod tests;
