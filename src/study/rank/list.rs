//! The products of a list with their figures, and their ranking.

use super::figures::{Found, Outcome};
use crate::compute::estimate::Estimate;
use crate::compute::rank::{Objective, Ranking};

/// A product of a list.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Its key in the catalogue.
    pub product: String,
    /// Says from what its figures were made.
    pub key: String,
    /// Figures, or why it is left out.
    pub outcome: Outcome,
}

/// A list: products in a scene, a climate and an azimuth.
#[derive(Debug, Clone, PartialEq)]
pub struct List {
    /// Place among all lists.
    pub number: usize,
    /// Name of the scene.
    pub scene: String,
    /// Name of the weather.
    pub climate: String,
    /// Bearing of the façade's outward normal. \[°\]
    pub azimuth: f64,
    /// Keys of the figures, one for each objective.
    pub figures: Vec<String>,
    /// What counts.
    pub objectives: Vec<Objective>,
    /// In any order.
    pub rows: Vec<Row>,
}

impl List {
    /// Those with figures.
    pub fn ranked(&self) -> Vec<(&Row, &Found)> {
        self.rows.iter().filter_map(|row| row.outcome.as_ref().ok().map(|found| (row, found))).collect()
    }

    /// Those that are left out, with the reason.
    pub fn excluded(&self) -> Vec<(&Row, &str)> {
        self.rows.iter().filter_map(|row| row.outcome.as_ref().err().map(|reason| (row, reason.as_str()))).collect()
    }

    /// The ranking of [`Self::ranked`] by objectives, which may have other weights and anchors than the list's own.
    pub fn ranking(&self, objectives: &[Objective]) -> Ranking {
        let ranked = self.ranked();
        let figures: Vec<&[Estimate]> = ranked.iter().map(|(_, found)| found.figures.as_slice()).collect();
        let parts: Vec<Vec<Vec<f64>>> =
            ranked.iter().map(|(_, found)| found.parts.iter().map(|parts| parts.values.clone()).collect()).collect();
        Ranking::of(objectives, &figures, &parts.iter().map(Vec::as_slice).collect::<Vec<_>>())
    }

    /// Rows by their products' keys: the one order in which a list is written and ranked, wherever its rows come from.
    pub fn sort(&mut self) {
        self.rows.sort_by(|a, b| a.product.cmp(&b.product));
    }
}
