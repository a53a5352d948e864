//! How the room is drawn: kept from one start to the next.

use crate::texts::{Text, tiles as say};
use serde::{Deserialize, Serialize};

/// From where one looks at the room.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RoomView {
    /// From above, the sensor plane in false colour.
    #[default]
    Plan,
    /// From the side.
    Section,
    /// Turned by hand, its surfaces as they are lit.
    Perspective,
}

impl RoomView {
    /// All, in the order of the toggle.
    pub const ALL: [Self; 3] = [Self::Plan, Self::Section, Self::Perspective];

    /// In words, as on the toggle.
    pub const fn word(self) -> Text {
        match self {
            Self::Plan => say::PLAN,
            Self::Section => say::SECTION,
            Self::Perspective => say::PERSPECTIVE,
        }
    }

    /// One sentence.
    pub const fn tip(self) -> Text {
        match self {
            Self::Plan => say::PLAN_TIP,
            Self::Section => say::SECTION_TIP,
            Self::Perspective => say::PERSPECTIVE_TIP,
        }
    }
}

/// How the room is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct RoomLook {
    /// From where.
    pub view: RoomView,
    /// The daylight factor instead of illuminance.
    pub daylight_factor: bool,
    /// In perspective, luminances as one would see them instead of false colours.
    pub as_seen: bool,
}
