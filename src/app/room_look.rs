//! How the room is drawn: kept from one start to the next.

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
    pub const fn word(self) -> &'static str {
        match self {
            Self::Plan => "Plan",
            Self::Section => "Section",
            Self::Perspective => "Perspective",
        }
    }

    /// One sentence.
    pub const fn tip(self) -> &'static str {
        match self {
            Self::Plan => "The sensor plane from above",
            Self::Section => "The room from the side: windows, sensor plane",
            Self::Perspective => "The surfaces as they are lit; drag to turn, wheel to zoom",
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
