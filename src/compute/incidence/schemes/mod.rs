//! The indicatrix of the sun's direction in seven ways: the report's three, base and matched lobes, lobes moved by
//! their own responses, optimal transport, and the one that leaving out finds best at every vertex.
//!
//! Every scheme supplies a shape alone. τ is one scalar for all, interpolated by [`Model`] with its curvature, and
//! imposed exactly. Beyond the border of the lattice, shapes stay as on the border (lobes with responses go on moving).

pub(super) mod between;
pub mod blend;
mod matched;
pub(super) mod plain;
mod transport;
mod whole;
pub(super) mod words;

use super::choice::Choices;
use super::grid::Grid;
use super::model::Model;
use crate::compute::direction::{Dir, Facade};
use between::Between;
use blend::Blend;
use plain::Plain;
use std::sync::{Arc, OnceLock};
pub use words::{DiffuseScheme, SunScheme};

/// All schemes over one model, and the choice among them.
pub struct Schemes {
    plain: Plain,
    choices: OnceLock<Choices>,
}

impl Schemes {
    /// Prepares what the schemes share; the choice waits until it is asked for.
    pub fn new(model: Arc<Model>) -> Self {
        Self { plain: Plain::new(model), choices: OnceLock::new() }
    }

    /// The model underneath.
    pub fn model(&self) -> &Arc<Model> {
        &self.plain.model
    }

    /// Which scheme is best where, found at the first call.
    pub fn choices(&self) -> &Choices {
        self.choices.get_or_init(|| Choices::new(&self.plain))
    }

    /// The indicatrix of an incident direction in pieces.
    pub fn blend(&self, scheme: SunScheme, incident: Dir<Facade>) -> Blend {
        let place = self.model().lattice.locate(incident);
        let recipe = self.model().recipe(incident);
        let between = Between::new(self.model(), &place, recipe, incident.vector());
        if scheme != SunScheme::Auto {
            return self.plain.blend(scheme, &between);
        }
        let choices = self.choices();
        let mut blend = Blend::default();
        for own in SunScheme::PLAIN {
            let share: f64 = between.used.iter().filter(|(v, _)| choices.at_vertex(*v) == own).map(|(_, w)| w).sum();
            if share > 0.0 {
                blend.add(&self.plain.blend(own, &between), share);
            }
        }
        blend
    }

    /// q of an incident direction on the cells of `target`, lobes as means of `points`² directions a cell; its flux is
    /// the interpolated τ. \[1/sr\]
    pub fn coefficient(&self, scheme: SunScheme, incident: Dir<Facade>, target: &Grid, points: usize) -> Vec<f64> {
        self.blend(scheme, incident).coefficient(self.model(), target, points)
    }

    /// Share of the transmitted flux that a scheme is stated to misplace for an incident direction; continuous in it.
    pub fn predicted_error(&self, scheme: SunScheme, incident: Dir<Facade>) -> f64 {
        self.choices().predicted_error(scheme, &self.model().lattice.locate(incident))
    }
}

#[cfg(test)]
mod tests;
