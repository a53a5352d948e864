//! Indicatrix of the sun's direction by four schemes: lobes moved by their own responses, which is what the program
//! does, and the report's three, to be compared with.
//!
//! Every scheme supplies a shape alone. τ is one scalar for all, interpolated by [`Model`] with its curvature, and
//! imposed exactly. Beyond the border of the lattice, shapes stay as on the border (lobes with responses keep moving).

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
    /// Returns q of an incident direction on the cells of `target`, lobes as means of `points`² directions per cell;
    /// its flux is the interpolated τ. \[1/sr\]
    pub fn coefficient(self, model: &Model, incident: Dir<Facade>, target: &Grid, points: usize) -> Vec<f64> {
        let place = model.lattice.locate(incident);
        Between::new(model, &place, model.recipe(incident), incident).coefficient(self, target, points)
    }
}

/// Direction between directions of the data, as every scheme needs it.
pub(super) struct Between<'a> {
    model: &'a Model,
    /// Data directions and their barycentric weights, above 0 and of sum 1.
    used: Vec<(usize, f64)>,
    direction: DVec3,
    recipe: Recipe,
    /// Interpolated τ.
    tau: f64,
}

impl<'a> Between<'a> {
    /// Creates the direction; `place` and `recipe` may be those of the same data with a direction left out.
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

    /// Returns q on the cells of `target`, τ imposed. \[1/sr\]
    pub(super) fn coefficient(&self, scheme: SunScheme, target: &Grid, points: usize) -> Vec<f64> {
        let shape = match scheme {
            SunScheme::Responses => Blend::of_recipe(self.model, &self.recipe),
            SunScheme::Nearest => self.nearest(false),
            SunScheme::DisplacedNearest => self.nearest(true),
            SunScheme::Superposed => self.superposed(),
        };
        // Without any light at the vertices there is no shape; then the model's own says what there is.
        let own = || Blend::of_recipe(self.model, &self.recipe);
        shape.with_flux(self.tau).unwrap_or_else(own).coefficient(self.model, target, points)
    }

    /// Returns the indicatrix of the nearest direction that lets anything through; `displaced`: turned so that its flux
    /// centroid comes to the interpolated one.
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

    /// Superposes every indicatrix around, turned to the interpolated centroid, with its barycentric weight. Right for
    /// one lobe; between two, the centroid lies where no light is.
    fn superposed(&self) -> Blend {
        let to = self.common_centroid();
        let mut blend = Blend::default();
        for &(v, w) in &self.used {
            blend.push_whole(self.model, v, self.turn(v, to), w * self.model.data.tau_by_direction()[v]);
        }
        blend
    }

    /// Returns the mean direction of an indicatrix by flux; `None` where nothing gets through.
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
