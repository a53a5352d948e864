//! Steps of the introductory tour, and commands about it.

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
