//! Every scheme alone, with what they share: no choice is made here.

use super::between::Between;
use super::blend::Blend;
use super::words::SunScheme;
use super::{matched, transport, whole};
use crate::compute::incidence::model::Model;
use glam::DVec3;
use std::sync::Arc;

/// All schemes over one model, each for itself.
pub struct Plain {
    pub(in crate::compute::incidence) model: Arc<Model>,
    /// Mean direction of every indicatrix by flux; `None` where nothing gets through.
    centroid: Vec<Option<DVec3>>,
    clusters: Vec<Vec<transport::Cluster>>,
}

impl Plain {
    /// Prepares what the schemes share.
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
            model,
        }
    }

    /// One scheme, τ imposed.
    pub(in crate::compute::incidence) fn blend(&self, scheme: SunScheme, between: &Between) -> Blend {
        let responses = || Blend::of_recipe(&self.model, &between.recipe);
        let shape = match scheme {
            SunScheme::Nearest => whole::nearest(&self.model, &self.centroid, between),
            SunScheme::DisplacedNearest => whole::displaced_nearest(&self.model, &self.centroid, between),
            SunScheme::Superposed => whole::superposed(&self.model, &self.centroid, between),
            SunScheme::MatchedLobes => matched::blend(&self.model, between),
            SunScheme::Transport => transport::blend(&self.model, &self.clusters, between),
            SunScheme::Responses | SunScheme::Auto => responses(),
        };
        // Without any light at the vertices there is no shape; then the model's own says what there is.
        shape.with_flux(between.tau).unwrap_or_else(responses)
    }
}
