//! Display settings of the room tile, stored between starts of the program.

use crate::texts::{Text, tiles as say};
use serde::{Deserialize, Serialize};

/// View of the room in its tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RoomView {
    /// Floor plan, with the illuminances on the work plane in false colours.
    #[default]
    Plan,
    /// Vertical section, with the illuminance along the depth of the room.
    Section,
    /// Perspective that can be rotated, with the illuminances or luminances of the room's surfaces.
    Perspective,
}

impl RoomView {
    /// All views, in the order of their toggle.
    pub const ALL: [Self; 3] = [Self::Plan, Self::Section, Self::Perspective];

    /// Returns the label of the view on the toggle.
    pub const fn word(self) -> Text {
        match self {
            Self::Plan => say::PLAN,
            Self::Section => say::SECTION,
            Self::Perspective => say::PERSPECTIVE,
        }
    }

    /// Returns the tooltip of the view, one sentence.
    pub const fn tip(self) -> Text {
        match self {
            Self::Plan => say::PLAN_TIP,
            Self::Section => say::SECTION_TIP,
            Self::Perspective => say::PERSPECTIVE_TIP,
        }
    }
}

/// Display settings of the room tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct RoomLook {
    /// View of the room: plan, section or perspective.
    pub view: RoomView,
    /// Whether the daylight factor is shown instead of illuminance.
    pub daylight_factor: bool,
    /// Whether the perspective shows luminances as an observer would see them instead of false colours.
    pub as_seen: bool,
}
