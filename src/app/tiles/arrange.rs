//! Commands that change the arrangement of the tiles.

use crate::texts::{Text, tiles as say};

/// Predefined arrangement of the tiles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Preset {
    /// All tiles side by side, the arrangement of the first start.
    All,
    /// Tiles for planning a room.
    Designer,
    /// Tiles for developing a system.
    Maker,
    /// Tiles for comparing methods and data.
    Science,
}

impl Preset {
    /// All arrangements, in the order of the menu.
    pub const ALL: [Self; 4] = [Self::All, Self::Designer, Self::Maker, Self::Science];

    /// Returns the label of the arrangement in menu and command palette.
    pub const fn word(self) -> Text {
        match self {
            Self::All => say::LAYOUT_ALL,
            Self::Designer => say::LAYOUT_DESIGNER,
            Self::Maker => say::LAYOUT_MAKER,
            Self::Science => say::LAYOUT_SCIENCE,
        }
    }

    /// Returns the tooltip of the arrangement, one sentence.
    pub const fn tip(self) -> Text {
        match self {
            Self::All => say::LAYOUT_ALL_TIP,
            Self::Designer => say::LAYOUT_DESIGNER_TIP,
            Self::Maker => say::LAYOUT_MAKER_TIP,
            Self::Science => say::LAYOUT_SCIENCE_TIP,
        }
    }
}

/// Side of a tile: left, right, upper or lower.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Left side.
    Left,
    /// Right side.
    Right,
    /// Upper side.
    Up,
    /// Lower side.
    Down,
}

impl Way {
    /// All sides.
    pub const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Up, Self::Down];

    /// Returns the name of the side, e.g. "left".
    pub const fn word(self) -> Text {
        match self {
            Self::Left => say::LEFT,
            Self::Right => say::RIGHT,
            Self::Up => say::UP,
            Self::Down => say::DOWN,
        }
    }
}

/// Command that changes the arrangement of the tiles; most concern the tile that was active last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arrange {
    /// Apply a predefined arrangement.
    Preset(Preset),
    /// Move the keyboard focus to the next (+1) or previous (−1) visible tile.
    Focus(i32),
    /// Move the keyboard focus to the tile on this side.
    FocusOn(Way),
    /// Bring the next (+1) or previous (−1) tab beside the active tile to the front.
    Tab(i32),
    /// Swap the active tile with the tile on this side.
    Move(Way),
    /// Make the active tile a tab of the next tile.
    Join,
    /// Move the active tile from its group of tabs to a position beside it.
    Split,
    /// Make the active tile wider (`true`) or narrower.
    Width(bool),
    /// Make the active tile higher (`true`) or lower.
    Height(bool),
}
