//! Introductory tour of the window in five steps on the user's content: the user executes each step in the window,
//! which is not blocked.

use crate::study::scene_file::TimeKey;
use crate::texts::{Text, shell};

/// Step of the introductory tour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// Select a product.
    Product,
    /// Move the sun in the sky tile or by the time of day.
    Sun,
    /// Maximise the LID tile or the room tile.
    Light,
    /// Add a candidate to the comparison.
    Compare,
    /// Open the export panel.
    Export,
}

impl Stop {
    /// All steps of the tour, in order.
    pub const ALL: [Self; 5] = [Self::Product, Self::Sun, Self::Light, Self::Compare, Self::Export];

    /// Returns the instruction for the step.
    pub const fn words(self) -> Text {
        match self {
            Self::Product => shell::TOUR_PRODUCT,
            Self::Sun => shell::TOUR_SUN,
            Self::Light => shell::TOUR_LIGHT,
            Self::Compare => shell::TOUR_COMPARE,
            Self::Export => shell::TOUR_EXPORT,
        }
    }
}

/// Command about the tour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TourAct {
    /// Start the tour, or continue after the last finished step.
    Start,
    /// Leave the tour.
    Leave,
    /// Decline the offer of the tour.
    Decline,
}

/// Values of the window by whose changes a finished step of the tour is recognised.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Seen {
    pub(super) product: String,
    pub(super) sun: (Option<TimeKey>, Option<f64>, Option<f64>),
    pub(super) light: bool,
    pub(super) candidates: usize,
    pub(super) is_export_open: bool,
}

impl Seen {
    /// Whether the user has done a step, judged by the changes from these values to `now`.
    pub(super) fn done(&self, now: &Self, stop: Stop) -> bool {
        match stop {
            Stop::Product => now.product != self.product,
            Stop::Sun => now.sun != self.sun,
            Stop::Light => now.light && !self.light,
            Stop::Compare => now.candidates > self.candidates,
            Stop::Export => now.is_export_open && !self.is_export_open,
        }
    }
}

/// State of the running tour.
#[derive(Debug, Clone, PartialEq)]
pub struct Tour {
    /// Step that the user is to do.
    pub stop: Stop,
    /// Values of the window in the last frame.
    pub(super) seen: Seen,
}
