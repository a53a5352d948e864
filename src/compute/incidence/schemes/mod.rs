//! The indicatrix of the sun's direction in seven ways: the report's three, base and matched lobes, lobes moved by
//! their own responses, optimal transport, and the one that leaving out finds best at every vertex.
//!
//! Every scheme supplies a shape alone. τ is one scalar for all, interpolated by [`Model`] with its curvature, and
//! imposed exactly. Beyond the border of the lattice, shapes stay as on the border (lobes with responses go on moving).

pub mod blend;
mod matched;
mod transport;
mod whole;

use super::choice::Choices;
use super::grid::Grid;
use super::lattice::Place;
use super::model::{Model, Recipe};
use crate::compute::direction::{Dir, Facade};
use blend::Blend;
use glam::DVec3;
use std::sync::{Arc, OnceLock};

/// How to find the indicatrix of a direction between the data's directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum SunScheme {
    /// At every vertex the scheme that predicts it and those around best without it; see [`super::choice`].
    #[default]
    Auto,
    /// That of the nearest direction. Jumps half way.
    Nearest,
    /// The nearest, moved as a whole to the interpolated centroid. Jumps half way.
    DisplacedNearest,
    /// Three, each moved as a whole to the interpolated centroid.
    Superposed,
    /// Bases blended, lobes paired and moved to their mean.
    MatchedLobes,
    /// Bases blended, lobes moved by their own responses.
    Responses,
    /// Bases blended, the rest moved by optimal transport.
    Transport,
}

impl SunScheme {
    /// All, in the order that lists show.
    pub const ALL: [Self; 7] = [
        Self::Auto,
        Self::Nearest,
        Self::DisplacedNearest,
        Self::Superposed,
        Self::MatchedLobes,
        Self::Responses,
        Self::Transport,
    ];

    /// All but the automatic one.
    pub const PLAIN: [Self; 6] =
        [Self::Nearest, Self::DisplacedNearest, Self::Superposed, Self::MatchedLobes, Self::Responses, Self::Transport];

    /// The word for it in scenes and on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Nearest => "nearest",
            Self::DisplacedNearest => "displaced-nearest",
            Self::Superposed => "superposed",
            Self::MatchedLobes => "matched-lobes",
            Self::Responses => "responses",
            Self::Transport => "transport",
        }
    }

    /// The scheme of a word.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|scheme| scheme.key() == key)
    }

    /// Whether its result moves smoothly with the sun: a condition for being chosen automatically.
    pub fn is_continuous(self) -> bool {
        !matches!(self, Self::Nearest | Self::DisplacedNearest)
    }
}

/// How diffuse light goes through indicatrices known at single directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum DiffuseScheme {
    /// The program chooses.
    #[default]
    Auto,
    /// Sub-patches finer than the lattice, each with its own interpolated indicatrix.
    Shift,
    /// Every direction stands for its patch as it is.
    Patch,
    /// The report's mean filter (eq 13), half as wide as patches.
    FilterNarrow,
    /// The same, as wide as patches.
    FilterMatched,
    /// The same, twice as wide.
    FilterWide,
    /// The filter with the shape of every patch itself, on the sharp part alone.
    FilterPatch,
}

impl DiffuseScheme {
    /// All, in the order that lists show.
    pub const ALL: [Self; 7] = [
        Self::Auto,
        Self::Shift,
        Self::Patch,
        Self::FilterNarrow,
        Self::FilterMatched,
        Self::FilterWide,
        Self::FilterPatch,
    ];

    /// The word for it in scenes and on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Shift => "shift",
            Self::Patch => "patch",
            Self::FilterNarrow => "filter-narrow",
            Self::FilterMatched => "filter-matched",
            Self::FilterWide => "filter-wide",
            Self::FilterPatch => "filter-patch",
        }
    }

    /// The scheme of a word.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|scheme| scheme.key() == key)
    }
}

/// A direction between directions of the data.
pub(super) struct Between {
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
    pub(super) fn new(model: &Model, place: &Place, recipe: Recipe, direction: DVec3) -> Self {
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

/// All schemes over one model.
pub struct Schemes {
    pub(super) model: Arc<Model>,
    /// Mean direction of every indicatrix by flux; `None` where nothing gets through.
    centroid: Vec<Option<DVec3>>,
    clusters: Vec<Vec<transport::Cluster>>,
    choices: OnceLock<Choices>,
}

impl Schemes {
    /// Prepares what the schemes share; the choice waits until it is asked for.
    pub fn new(model: Arc<Model>) -> Self {
        let count = model.lattice.points().len();
        let centroid = |v: usize| {
            let row = model.data.row(v);
            let cells = row.iter().zip(&model.grid.projected).zip(&model.grid.centre);
            cells.map(|((q, w), c)| *c * (q * w)).sum::<DVec3>().try_normalize()
        };
        Self {
            centroid: (0..count).map(centroid).collect(),
            clusters: (0..count).map(|v| transport::clusters(&model, v)).collect(),
            choices: OnceLock::new(),
            model,
        }
    }

    /// The model underneath.
    pub fn model(&self) -> &Arc<Model> {
        &self.model
    }

    /// Which scheme is best where, found at the first call.
    pub fn choices(&self) -> &Choices {
        self.choices.get_or_init(|| Choices::new(self))
    }

    /// The indicatrix of an incident direction in pieces.
    pub fn blend(&self, scheme: SunScheme, incident: Dir<Facade>) -> Blend {
        let place = self.model.lattice.locate(incident);
        let recipe = self.model.recipe(incident);
        let between = Between::new(&self.model, &place, recipe, incident.vector());
        if scheme != SunScheme::Auto {
            return self.plain(scheme, &between);
        }
        let choices = self.choices();
        let mut blend = Blend::default();
        for own in SunScheme::PLAIN {
            let share: f64 = between.used.iter().filter(|(v, _)| choices.at_vertex(*v) == own).map(|(_, w)| w).sum();
            if share > 0.0 {
                blend.add(&self.plain(own, &between), share);
            }
        }
        blend
    }

    /// One scheme, τ imposed.
    pub(super) fn plain(&self, scheme: SunScheme, between: &Between) -> Blend {
        let responses = || Blend::of_recipe(&self.model, &between.recipe);
        let shape = match scheme {
            SunScheme::Nearest => whole::nearest(self, between),
            SunScheme::DisplacedNearest => whole::displaced_nearest(self, between),
            SunScheme::Superposed => whole::superposed(self, between),
            SunScheme::MatchedLobes => matched::blend(self, between),
            SunScheme::Transport => transport::blend(self, between),
            SunScheme::Responses | SunScheme::Auto => responses(),
        };
        // Without any light at the vertices there is no shape; then the model's own says what there is.
        shape.with_flux(between.tau).unwrap_or_else(responses)
    }

    /// q of an incident direction on the cells of `target`, lobes as means of `points`² directions a cell; its flux is
    /// the interpolated τ. \[1/sr\]
    pub fn coefficient(&self, scheme: SunScheme, incident: Dir<Facade>, target: &Grid, points: usize) -> Vec<f64> {
        self.blend(scheme, incident).coefficient(&self.model, target, points)
    }

    /// Share of the transmitted flux that a scheme is stated to misplace for an incident direction; continuous in it.
    pub fn predicted_error(&self, scheme: SunScheme, incident: Dir<Facade>) -> f64 {
        self.choices().predicted_error(scheme, &self.model.lattice.locate(incident))
    }
}

#[cfg(test)]
mod tests;
