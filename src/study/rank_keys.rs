//! `[rank]` of a scene as typed: which products are ranked in it, and by what.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// `[rank]`
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RankKeys {
    /// Words as in the window's search; empty: the whole catalogue.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub products: String,
    /// By whose rule products move.
    #[serde(default, skip_serializing_if = "RankControlKey::is_default")]
    pub control: RankControlKey,
    /// Weather files instead of `year.weather`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub weather: Vec<PathBuf>,
    /// Bearings of the façade's outward normal instead of `site.azimuth`. \[°\]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub azimuths: Vec<f64>,
    /// At least one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub objective: Vec<ObjectiveKeys>,
}

/// `rank.control`
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RankControlKey {
    /// Each product's own rule where it has one, else `[control]`.
    #[default]
    Product,
    /// `[control]` for all that move.
    Scene,
}

impl RankControlKey {
    /// The key's default, which is not written.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// `[[rank.objective]]`
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObjectiveKeys {
    /// Key of a figure of the year, as `cfs year --json` names it under "metrics"; of a list its mean counts.
    pub figure: String,
    /// Which way is better.
    pub better: BetterKey,
    /// Where the utility is 0.
    pub worst: f64,
    /// Where the utility is 1.
    pub best: f64,
    /// Counts relative to the sum of all.
    #[serde(default = "one")]
    pub weight: f64,
}

const fn one() -> f64 {
    1.0
}

/// `rank.objective.better`
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BetterKey {
    /// The less the better.
    Less,
    /// The more the better.
    More,
}
