//! Tour in five steps on real content: each step is done by doing it, none blocks anything else.

use crate::study::scene_file::TimeKey;
use crate::texts::{Text, shell};

/// Step of the tour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// Choose a product.
    Product,
    /// Move the sun.
    Sun,
    /// Look at LID or room.
    Light,
    /// Add a candidate to the comparison.
    Compare,
    /// Export.
    Export,
}

impl Stop {
    /// All steps, in order.
    pub const ALL: [Self; 5] = [Self::Product, Self::Sun, Self::Light, Self::Compare, Self::Export];

    /// Returns the instruction.
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
    /// Start, or continue after the last finished step.
    Start,
    /// Leave the tour.
    Leave,
    /// Decline the offer of the tour.
    Decline,
}

/// Values by which a finished step is recognised.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Seen {
    pub(super) product: String,
    pub(super) sun: (Option<TimeKey>, Option<f64>, Option<f64>),
    pub(super) light: bool,
    pub(super) candidates: usize,
    pub(super) is_export_open: bool,
}

impl Seen {
    /// Whether a step was done between this and `now`.
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

/// Running tour.
#[derive(Debug, Clone, PartialEq)]
pub struct Tour {
    /// Current step.
    pub stop: Stop,
    /// Values in the last frame.
    pub(super) seen: Seen,
}
