//! List of products with their figures, and their ranking.

use super::figures::{Found, Outcome};
use crate::compute::estimate::Estimate;
use crate::compute::rank::{Objective, Ranking};

/// Product of a ranked list, with its figures.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Key of the product in the catalogue.
    pub product: String,
    /// Key of the row: a hash of all input of the figures.
    pub key: String,
    /// Annual figures of the product, or the reason why it is excluded.
    pub outcome: Outcome,
}

/// Ranked list: products in one scene, one climate and one azimuth of the façade.
#[derive(Debug, Clone, PartialEq)]
pub struct List {
    /// Index of this list among all lists of the ranking.
    pub number: usize,
    /// Name of the scene.
    pub scene: String,
    /// Name of the weather.
    pub climate: String,
    /// Bearing of the façade's outward normal. \[°\]
    pub azimuth: f64,
    /// Keys of the annual figures, one for each objective.
    pub figures: Vec<String>,
    /// Objectives by which the products are ranked, in the order of the figures.
    pub objectives: Vec<Objective>,
    /// Products with their figures, in any order.
    pub rows: Vec<Row>,
}

impl List {
    /// Returns the products that have figures.
    pub fn ranked(&self) -> Vec<(&Row, &Found)> {
        self.rows.iter().filter_map(|row| row.outcome.as_ref().ok().map(|found| (row, found))).collect()
    }

    /// Returns the excluded products, each with the reason.
    pub fn excluded(&self) -> Vec<(&Row, &str)> {
        self.rows.iter().filter_map(|row| row.outcome.as_ref().err().map(|reason| (row, reason.as_str()))).collect()
    }

    /// Returns the ranking of the products of [`Self::ranked`] by objectives, whose weights and scale limits may differ
    /// from those of the list.
    pub fn ranking(&self, objectives: &[Objective]) -> Ranking {
        let ranked = self.ranked();
        let figures: Vec<&[Estimate]> = ranked.iter().map(|(_, found)| found.figures.as_slice()).collect();
        let parts: Vec<Vec<Vec<f64>>> =
            ranked.iter().map(|(_, found)| found.parts.iter().map(|parts| parts.values.clone()).collect()).collect();
        Ranking::of(objectives, &figures, &parts.iter().map(Vec::as_slice).collect::<Vec<_>>())
    }

    /// Sorts the products by their keys: the only order in which a list is written and ranked, so that results do not
    /// depend on where rows come from.
    pub fn sort(&mut self) {
        self.rows.sort_by(|a, b| a.product.cmp(&b.product));
    }
}
