//! Display settings of the room, kept from one start to the next.

use crate::texts::{Text, tiles as say};
use serde::{Deserialize, Serialize};

/// View of the room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RoomView {
    /// Floor plan, the work plane in false colour.
    #[default]
    Plan,
    /// Section.
    Section,
    /// Perspective, rotated by hand, with the illuminated surfaces.
    Perspective,
}

impl RoomView {
    /// All views, in the order of the toggle.
    pub const ALL: [Self; 3] = [Self::Plan, Self::Section, Self::Perspective];

    /// Returns the label on the toggle.
    pub const fn word(self) -> Text {
        match self {
            Self::Plan => say::PLAN,
            Self::Section => say::SECTION,
            Self::Perspective => say::PERSPECTIVE,
        }
    }

    /// Returns the tooltip, one sentence.
    pub const fn tip(self) -> Text {
        match self {
            Self::Plan => say::PLAN_TIP,
            Self::Section => say::SECTION_TIP,
            Self::Perspective => say::PERSPECTIVE_TIP,
        }
    }
}

/// Display settings of the room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct RoomLook {
    /// View of the room.
    pub view: RoomView,
    /// Whether the daylight factor is shown instead of illuminance.
    pub daylight_factor: bool,
    /// Whether the perspective shows luminances as an observer would see them instead of false colours.
    pub as_seen: bool,
}
