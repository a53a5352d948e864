//! What the tile draws, and what it is asked for.

use crate::app::paint::tile::Status;
use crate::study::rank::{Look, Reason, Shortlist};
use crate::study::rank_keys::ObjectiveKeys;
use std::path::Path;

/// What the user did.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Rank, or go on, or rank anew.
    Rank,
    /// Stop it.
    Stop,
    /// Look at something else of it.
    Look(Box<Look>),
    /// Other objectives; `true`: one more or one less, not only other numbers.
    Objectives(Vec<ObjectiveKeys>, bool),
    /// This product (by its key) into the room.
    IntoRoom(String),
    /// This product (by its key) into the comparison's tray.
    Compare(String),
}

/// A figure that may become an objective.
#[derive(Debug, Clone, PartialEq)]
pub struct Offer {
    /// The objective as it begins.
    pub keys: ObjectiveKeys,
    /// What it is called.
    pub name: String,
    /// Is it known of all products already?
    pub known: bool,
}

/// Products that are being computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Running {
    /// By data on their cells, beams to come?
    pub coarse: bool,
    /// How many are done.
    pub done: usize,
    /// Of how many.
    pub all: usize,
    /// Time that the others will take, as far as can be told. \[s\]
    pub left: Option<f64>,
}

impl Running {
    /// Share done.
    pub fn share(&self) -> f32 {
        self.done as f32 / self.all.max(1) as f32
    }
}

/// Why there is something to compute.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Due {
    /// There is nothing.
    #[default]
    Nothing,
    /// Room, weather, catalogue or search are others than those of the figures.
    Changed,
    /// So many products were not reached.
    Unfinished(usize),
    /// An objective's figure is not known.
    Figure,
}

/// What the tile draws.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// The products in order; `None` before there are any.
    pub list: Option<&'a Shortlist>,
    /// Why the chosen product stands where it does.
    pub reason: Option<&'a Reason>,
    /// How it is looked at.
    pub look: &'a Look,
    /// What counts.
    pub objectives: &'a [ObjectiveKeys],
    /// What else may.
    pub offers: &'a [Offer],
    /// The weather that the years are of.
    pub weather: &'a Path,
    /// The scene in a few words.
    pub name: &'a str,
    /// Key of the product that is in the room.
    pub in_room: &'a str,
    /// How many products the catalogue's search finds, where it is one.
    pub search: Option<usize>,
    /// How many apertures the scene has.
    pub apertures: usize,
    /// What is being computed.
    pub running: Option<Running>,
    /// What there is to compute.
    pub due: Due,
    /// Why there is nothing, or nothing newer.
    pub error: Option<&'a str>,
    /// How far it is to be trusted.
    pub status: Status<'a>,
}

/// `3`, or `3–5` where the errors leave it open.
pub fn rank_words((first, last): (usize, usize)) -> String {
    if first == last { first.to_string() } else { format!("{first}–{last}") }
}
