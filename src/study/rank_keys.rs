//! Keys `[rank]` of a scene file: products to be ranked and objectives.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Section `[rank]` of a scene file.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RankKeys {
    /// Search words for products, by the same rules as in the window; empty: the whole catalogue.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub products: String,
    /// Source of the control rule of moving products: product or scene.
    #[serde(default, skip_serializing_if = "RankControlKey::is_default")]
    pub control: RankControlKey,
    /// Weather files or built-in years that replace `year.weather`; one list is made for each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub weather: Vec<PathBuf>,
    /// Bearings of the façade's outward normal that replace `site.azimuth`; one list is made for each. \[°\]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub azimuths: Vec<f64>,
    /// Objectives of the ranking, at least one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub objective: Vec<ObjectiveKeys>,
}

/// Value of `rank.control`: source of the control rule of moving products.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RankControlKey {
    /// Rule of each product if it has one, else the scene's `[control]`.
    #[default]
    Product,
    /// `[control]` of the scene for all moving products.
    Scene,
}

impl RankControlKey {
    /// Whether the key has its default value, which is not written.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// Entry of `[[rank.objective]]`: annual figure with its scale and weight.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObjectiveKeys {
    /// Key of an annual figure, as `cfs year --json` names it under "metrics"; of a figure that is a list the mean is
    /// taken.
    pub figure: String,
    /// Whether smaller or larger values of the figure are better.
    pub better: BetterKey,
    /// Value of the figure that gives score 0.
    pub worst: f64,
    /// Value of the figure that gives score 1.
    pub best: f64,
    /// Weight of the objective, relative to the sum of all weights.
    #[serde(default = "one")]
    pub weight: f64,
}

const fn one() -> f64 {
    1.0
}

/// Value of `rank.objective.better`: which values of the figure are better.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BetterKey {
    /// Smaller values are better.
    Less,
    /// Larger values are better.
    More,
}
