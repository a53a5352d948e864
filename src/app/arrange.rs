//! What can be asked of the arrangement of the tiles.

use crate::texts::{Text, tiles as say};

/// A ready arrangement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Preset {
    /// All tiles side by side, as at a first start.
    All,
    /// For who plans a room.
    Designer,
    /// For who makes a system.
    Maker,
    /// For who compares methods and data.
    Science,
}

impl Preset {
    /// All, in the order of the menu.
    pub const ALL: [Self; 4] = [Self::All, Self::Designer, Self::Maker, Self::Science];

    /// As menu and palette call it.
    pub const fn word(self) -> Text {
        match self {
            Self::All => say::LAYOUT_ALL,
            Self::Designer => say::LAYOUT_DESIGNER,
            Self::Maker => say::LAYOUT_MAKER,
            Self::Science => say::LAYOUT_SCIENCE,
        }
    }

    /// One sentence.
    pub const fn tip(self) -> Text {
        match self {
            Self::All => say::LAYOUT_ALL_TIP,
            Self::Designer => say::LAYOUT_DESIGNER_TIP,
            Self::Maker => say::LAYOUT_MAKER_TIP,
            Self::Science => say::LAYOUT_SCIENCE_TIP,
        }
    }
}

/// A side of a tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// To the left.
    Left,
    /// To the right.
    Right,
    /// Upwards.
    Up,
    /// Downwards.
    Down,
}

impl Way {
    /// All.
    pub const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Up, Self::Down];

    /// In words: "left".
    pub const fn word(self) -> Text {
        match self {
            Self::Left => say::LEFT,
            Self::Right => say::RIGHT,
            Self::Up => say::UP,
            Self::Down => say::DOWN,
        }
    }
}

/// A change of the arrangement; most are of the tile that was in hand last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arrange {
    /// A ready one.
    Preset(Preset),
    /// The keyboard goes to the next (+1) or previous (−1) tile in sight.
    Focus(i32),
    /// The keyboard goes to the tile on this side.
    FocusOn(Way),
    /// The next (+1) or previous (−1) tab comes to the front.
    Tab(i32),
    /// Changes places with the tile on this side.
    Move(Way),
    /// Becomes a tab of the next tile.
    Join,
    /// Leaves its tabs and stands beside them.
    Split,
    /// Wider or higher (true), narrower or lower.
    Width(bool),
    /// The same of the height.
    Height(bool),
}
