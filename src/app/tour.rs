//! A tour in five steps on what is really there: each is done by doing it, none stops anything else.

use crate::study::scene_file::TimeKey;
use crate::texts::{Text, shell};

/// A step of the tour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// Choose a product.
    Product,
    /// Move the sun.
    Sun,
    /// Look at LID or room.
    Light,
    /// Compare.
    Compare,
    /// Hand on.
    HandOn,
}

impl Stop {
    /// All, in order.
    pub const ALL: [Self; 5] = [Self::Product, Self::Sun, Self::Light, Self::Compare, Self::HandOn];

    /// What is to be done.
    pub const fn words(self) -> Text {
        match self {
            Self::Product => shell::TOUR_PRODUCT,
            Self::Sun => shell::TOUR_SUN,
            Self::Light => shell::TOUR_LIGHT,
            Self::Compare => shell::TOUR_COMPARE,
            Self::HandOn => shell::TOUR_HAND_ON,
        }
    }
}

/// What can be asked of the tour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TourAct {
    /// Begin, or go on after the last step that was done.
    Start,
    /// Leave it.
    Leave,
    /// Not now: the offer goes.
    Decline,
}

/// What a step is told by.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Seen {
    pub(super) product: String,
    pub(super) sun: (Option<TimeKey>, Option<f64>, Option<f64>),
    pub(super) light: bool,
    pub(super) candidates: usize,
    pub(super) handing_on: bool,
}

impl Seen {
    /// Was the step done between then and now?
    pub(super) fn done(&self, now: &Self, stop: Stop) -> bool {
        match stop {
            Stop::Product => now.product != self.product,
            Stop::Sun => now.sun != self.sun,
            Stop::Light => now.light && !self.light,
            Stop::Compare => now.candidates > self.candidates,
            Stop::HandOn => now.handing_on && !self.handing_on,
        }
    }
}

/// The tour that is under way.
#[derive(Debug, Clone, PartialEq)]
pub struct Tour {
    /// Where it is.
    pub stop: Stop,
    /// How things were in the last frame.
    pub(super) seen: Seen,
}
