//! What the tile draws, and what it is asked for.

use crate::app::paint::tile::Status;

/// An objective.
#[derive(Debug, Clone, PartialEq)]
pub struct Objective {
    /// What it is called.
    pub name: String,
    /// Unit of its values; `%` for shares, which are 0 … 1.
    pub unit: &'static str,
    /// Is less better?
    pub less_is_better: bool,
    /// How much it counts.
    pub weight: f64,
}

/// A product that was ranked, or excluded.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChooseRow {
    /// Its key in the catalogue.
    pub product: String,
    /// What it is called.
    pub label: String,
    /// Value and error of every objective; empty for what is excluded.
    pub values: Vec<(f64, f64)>,
    /// What it is worth and its error, 0 … 1.
    pub utility: (f64, f64),
    /// First and last rank that the errors leave it, from 1.
    pub ranks: (usize, usize),
    /// Is no other better in every objective?
    pub front: bool,
    /// Are its figures coarse, or partly taken over from other data?
    pub approximate: bool,
    /// Why it takes no part; `None` where it does.
    pub excluded: Option<String>,
    /// Why it stands where it does, in words whose figures add up.
    pub why: String,
}

/// What there is to choose from.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChooseRows {
    /// In the order of weights.
    pub objectives: Vec<Objective>,
    /// In the order of ranks, what is excluded last.
    pub rows: Vec<ChooseRow>,
    /// How many of all were computed.
    pub done: (usize, usize),
}

/// What the user did.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// This product (by its key) into the room.
    IntoRoom(String),
    /// This product (by its key) into the comparison's tray.
    Compare(String),
    /// An objective's weight.
    Weight(usize, f64),
}

/// What the tile draws.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// What there is.
    pub rows: &'a ChooseRows,
    /// Key of the product that is in the room.
    pub in_room: &'a str,
    /// How far it is to be trusted.
    pub status: Status<'a>,
}

/// `3`, or `3–5` where the errors leave it open.
pub fn rank_words((first, last): (usize, usize)) -> String {
    if first == last { first.to_string() } else { format!("{first}–{last}") }
}
