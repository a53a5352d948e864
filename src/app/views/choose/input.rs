//! Input of the ranking tile, and the requests of its user.

use crate::app::paint::tile::Status;
use crate::study::rank::{Look, Reason, Shortlist};
use crate::study::rank_keys::ObjectiveKeys;
use std::path::Path;

/// Request of the user of the ranking tile.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Request to rank, to continue, or to rank again.
    Rank,
    /// Request to stop the ranking.
    Stop,
    /// New display settings of the ranking.
    Look(Box<Look>),
    /// New list of objectives, and whether an objective was added or removed (`true`) or only numbers were changed.
    Objectives(Vec<ObjectiveKeys>, bool),
    /// Choice of a product, by its key, as the system in the apertures of the scene.
    IntoRoom(String),
    /// Addition of a product, by its key, to the comparison.
    Compare(String),
}

/// Figure that can be added as an objective.
#[derive(Debug, Clone, PartialEq)]
pub struct Offer {
    /// Objective for the figure, with default weight and scale limits.
    pub keys: ObjectiveKeys,
    /// Name of the figure.
    pub name: String,
    /// Whether the figure has been computed for all ranked products already.
    pub known: bool,
}

/// Progress of the computation of products for a ranking.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Running {
    /// Whether the current pass is a preliminary one with patch-averaged data, which one with sharp beams follows.
    pub coarse: bool,
    /// Number of products computed.
    pub done: usize,
    /// Number of all products to compute.
    pub all: usize,
    /// Estimated time for the remaining products; `None` if it cannot be estimated. \[s\]
    pub left: Option<f64>,
}

impl Running {
    /// Returns the fraction of the products that are computed, 0 … 1.
    pub fn share(&self) -> f32 {
        self.done as f32 / self.all.max(1) as f32
    }
}

/// Reason why the ranking has to be computed, or computed again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Due {
    /// No reason: the ranking is complete and up to date.
    #[default]
    Nothing,
    /// Change of room, weather, catalogue or search since the figures were computed.
    Changed,
    /// Products not computed yet: their number.
    Unfinished(usize),
    /// Objective whose figure has not been computed yet.
    Figure,
}

/// Input of the ranking tile in one frame.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Ranked products; `None` before there is a ranking.
    pub list: Option<&'a Shortlist>,
    /// Explanation of the rank of the selected product; `None` without one.
    pub reason: Option<&'a Reason>,
    /// Display settings of the ranking.
    pub look: &'a Look,
    /// Objectives of the ranking.
    pub objectives: &'a [ObjectiveKeys],
    /// Figures that can be added as objectives.
    pub offers: &'a [Offer],
    /// Path or name of the weather data of the annual simulations.
    pub weather: &'a Path,
    /// Short description of the scene.
    pub name: &'a str,
    /// Key of the product in the apertures of the scene.
    pub in_room: &'a str,
    /// Number of products that the search of the catalogue finds; `None` if the catalogue is not restricted by a
    /// search.
    pub search: Option<usize>,
    /// Number of the scene's apertures.
    pub apertures: usize,
    /// Progress of a running ranking; `None` if none is running.
    pub running: Option<Running>,
    /// Reason why the ranking has to be computed, or computed again.
    pub due: Due,
    /// Error that prevented a ranking, or a newer one, as text.
    pub error: Option<&'a str>,
    /// Status of the ranking: preliminary, outdated or complete.
    pub status: Status<'a>,
}

/// Returns a rank as text, given the first and last rank that are possible within the uncertainty: `3`, or `3–5`.
pub fn rank_words((first, last): (usize, usize)) -> String {
    if first == last { first.to_string() } else { format!("{first}–{last}") }
}
