//! Keys of `[rank]` in a scene, as typed: ranked products and objectives.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Keys of `[rank]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RankKeys {
    /// Search words for products, as in the window; empty: the whole catalogue.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub products: String,
    /// Source of the control rule of moving products.
    #[serde(default, skip_serializing_if = "RankControlKey::is_default")]
    pub control: RankControlKey,
    /// Weather files that replace `year.weather`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub weather: Vec<PathBuf>,
    /// Bearings of the façade's outward normal that replace `site.azimuth`. \[°\]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub azimuths: Vec<f64>,
    /// Objectives, at least one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub objective: Vec<ObjectiveKeys>,
}

/// Values of `rank.control`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RankControlKey {
    /// Each product's own rule if it has one, else `[control]`.
    #[default]
    Product,
    /// The scene's `[control]` for all moving products.
    Scene,
}

impl RankControlKey {
    /// Whether the key has its default value, which is not written.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// Keys of `[[rank.objective]]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObjectiveKeys {
    /// Key of an annual figure, as `cfs year --json` names it under "metrics"; of a list the mean counts.
    pub figure: String,
    /// Direction in which the figure is better.
    pub better: BetterKey,
    /// Value of the figure with score 0.
    pub worst: f64,
    /// Value of the figure with score 1.
    pub best: f64,
    /// Weight, relative to the sum of all weights.
    #[serde(default = "one")]
    pub weight: f64,
}

const fn one() -> f64 {
    1.0
}

/// Values of `rank.objective.better`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BetterKey {
    /// Smaller values are better.
    Less,
    /// Larger values are better.
    More,
}
