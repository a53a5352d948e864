//! Products of a list with their figures, and their ranking.

use super::figures::{Found, Outcome};
use crate::compute::estimate::Estimate;
use crate::compute::rank::{Objective, Ranking};

/// A product of a list.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Key of the product in the catalogue.
    pub product: String,
    /// Key of the row: a hash of all input of the figures.
    pub key: String,
    /// Figures, or the reason why the product is excluded.
    pub outcome: Outcome,
}

/// A list: products in one scene, climate and azimuth.
#[derive(Debug, Clone, PartialEq)]
pub struct List {
    /// Index of the list among all lists.
    pub number: usize,
    /// Name of the scene.
    pub scene: String,
    /// Name of the weather.
    pub climate: String,
    /// Bearing of the façade's outward normal. \[°\]
    pub azimuth: f64,
    /// Keys of the figures, one for each objective.
    pub figures: Vec<String>,
    /// Objectives of the ranking, in the order of the figures.
    pub objectives: Vec<Objective>,
    /// Rows in any order.
    pub rows: Vec<Row>,
}

impl List {
    /// Returns the rows with figures.
    pub fn ranked(&self) -> Vec<(&Row, &Found)> {
        self.rows.iter().filter_map(|row| row.outcome.as_ref().ok().map(|found| (row, found))).collect()
    }

    /// Returns the excluded rows, with the reason.
    pub fn excluded(&self) -> Vec<(&Row, &str)> {
        self.rows.iter().filter_map(|row| row.outcome.as_ref().err().map(|reason| (row, reason.as_str()))).collect()
    }

    /// Returns the ranking of [`Self::ranked`] by objectives, which may have other weights and scale limits than the
    /// list's own.
    pub fn ranking(&self, objectives: &[Objective]) -> Ranking {
        let ranked = self.ranked();
        let figures: Vec<&[Estimate]> = ranked.iter().map(|(_, found)| found.figures.as_slice()).collect();
        let parts: Vec<Vec<Vec<f64>>> =
            ranked.iter().map(|(_, found)| found.parts.iter().map(|parts| parts.values.clone()).collect()).collect();
        Ranking::of(objectives, &figures, &parts.iter().map(Vec::as_slice).collect::<Vec<_>>())
    }

    /// Sorts the rows by product key: the only order in which a list is written and ranked, independent of where its
    /// rows come from.
    pub fn sort(&mut self) {
        self.rows.sort_by(|a, b| a.product.cmp(&b.product));
    }
}
