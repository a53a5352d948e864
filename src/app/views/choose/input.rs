//! Input and actions of the ranking tile.

use crate::app::paint::tile::Status;
use crate::study::rank::{Look, Reason, Shortlist};
use crate::study::rank_keys::ObjectiveKeys;
use std::path::Path;

/// Action of the user.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Request to rank, to continue, or to rank again.
    Rank,
    /// Request to stop the ranking.
    Stop,
    /// New settings of the view.
    Look(Box<Look>),
    /// New objectives; `true`: one more or one less, not only other numbers.
    Objectives(Vec<ObjectiveKeys>, bool),
    /// Choice of this product (by its key) as the system of the room.
    IntoRoom(String),
    /// Addition of this product (by its key) to the comparison.
    Compare(String),
}

/// Figure that may become an objective.
#[derive(Debug, Clone, PartialEq)]
pub struct Offer {
    /// The objective with its first settings.
    pub keys: ObjectiveKeys,
    /// Name of the figure.
    pub name: String,
    /// Whether the figure is known for all products already.
    pub known: bool,
}

/// Progress of products that are being computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Running {
    /// Whether the products are computed from patch-averaged data first, with sharp beams to follow.
    pub coarse: bool,
    /// Number of products that are done.
    pub done: usize,
    /// Number of all products to compute.
    pub all: usize,
    /// Estimated time for the remaining products; `None` if it cannot be estimated. \[s\]
    pub left: Option<f64>,
}

impl Running {
    /// Returns the share that is done, 0–1.
    pub fn share(&self) -> f32 {
        self.done as f32 / self.all.max(1) as f32
    }
}

/// Reason to compute something.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Due {
    /// No reason: nothing is to compute.
    #[default]
    Nothing,
    /// Room, weather, catalogue or search have changed since the figures were computed.
    Changed,
    /// Number of products that were not computed yet.
    Unfinished(usize),
    /// An objective's figure is not known yet.
    Figure,
}

/// Input of the tile.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Ranked products; `None` before there are any.
    pub list: Option<&'a Shortlist>,
    /// Reason for the rank of the selected product.
    pub reason: Option<&'a Reason>,
    /// Settings of the view.
    pub look: &'a Look,
    /// Objectives of the ranking.
    pub objectives: &'a [ObjectiveKeys],
    /// Figures that may become objectives.
    pub offers: &'a [Offer],
    /// Weather of the annual simulations.
    pub weather: &'a Path,
    /// The scene in a few words.
    pub name: &'a str,
    /// Key of the product that is in the room.
    pub in_room: &'a str,
    /// Number of products that the catalogue's search finds, where it is one.
    pub search: Option<usize>,
    /// Number of the scene's apertures.
    pub apertures: usize,
    /// Progress of the computation; `None` while none runs.
    pub running: Option<Running>,
    /// Reason to compute something.
    pub due: Due,
    /// Error because of which there is no ranking, or no newer one.
    pub error: Option<&'a str>,
    /// Status of the ranking: preliminary, outdated or complete.
    pub status: Status<'a>,
}

/// Returns the rank as text: `3`, or `3–5` where ranks lie within the uncertainty.
pub fn rank_words((first, last): (usize, usize)) -> String {
    if first == last { first.to_string() } else { format!("{first}–{last}") }
}
