//! Comparing, as the window knows it: what can be done with the tray, and how the comparison is looked at. The tray itself
//! is part of the scene ([`CompareKeys`](crate::study::scene_file::CompareKeys)).

use crate::texts::compare as texts;

/// One thing to do about what is compared. Numbers are places in the tray, from 0.
#[derive(Debug, Clone, PartialEq)]
pub enum Act {
    /// Add what is shown: product and state, or rule. The rest goes with the scene.
    Add,
    /// The same of a product by its key, as it is first shown.
    AddProduct(String),
    /// Add what is shown, under the sky and sun of this moment for good.
    AddMoment,
    /// Add what is shown with everything: room, apertures, sensors, place, sky.
    AddScene,
    /// Make one the scene, with what it has of its own.
    Take(usize),
    /// Take one out.
    Remove(usize),
    /// Move one to another place.
    Move(usize, isize),
    /// Type the name of one; `None`: as it was.
    EditName(Option<(usize, String)>),
    /// Give one another name.
    Rename(usize, String),
    /// Empty the tray.
    Clear,
    /// Compare in the bench's place, or go back to the tiles.
    Show,
    /// How it is compared.
    Look(Look),
    /// Which tile, by its title.
    Tile(&'static str),
    /// Logarithmic scales in all tiles, or linear ones.
    Log(bool),
    /// From which one the differences are taken.
    Base(usize),
    /// Show the other one in the tiles, or go back.
    Swap,
    /// Show this one in the tiles.
    SwapWith(usize),
    /// The table of figures into the clipboard.
    Copy,
    /// Go on computing after a stop.
    Resume,
}

/// How candidates are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Look {
    /// The same tile for each, on one scale.
    #[default]
    Beside,
    /// Each less a base, with sign.
    Difference,
    /// Curves in one plot.
    Curves,
    /// Figures with errors.
    Figures,
}

impl Look {
    /// All, in the order of the bar.
    pub const ALL: [Self; 4] = [Self::Beside, Self::Difference, Self::Curves, Self::Figures];

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Beside => texts::BESIDE,
            Self::Difference => texts::DIFFERENCE,
            Self::Curves => texts::CURVES,
            Self::Figures => texts::FIGURES,
        }
        .get()
    }

    /// One sentence.
    pub fn tip(self) -> &'static str {
        match self {
            Self::Beside => texts::BESIDE_TIP,
            Self::Difference => texts::DIFFERENCE_TIP,
            Self::Curves => texts::CURVES_TIP,
            Self::Figures => texts::FIGURES_TIP,
        }
        .get()
    }
}

/// How the comparison is looked at.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct View {
    /// In the bench's place.
    pub open: bool,
    /// How.
    pub look: Look,
    /// Title of the tile; empty: the room's.
    pub tile: &'static str,
    /// Logarithmic scales in all tiles side by side; `None`: as each begins.
    pub log: Option<bool>,
    /// The base of differences.
    pub base: usize,
    /// Shown in the tiles instead of the scene's own.
    pub swapped: Option<usize>,
    /// The one that was chosen to swap with.
    pub other: Option<usize>,
    /// The name that is being typed.
    pub naming: Option<(usize, String)>,
}

/// A part of what is known of a candidate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Product, state, dataset, sky and sun.
    Shelf,
    /// The light of the first aperture.
    Lid,
    /// Its largest intensities.
    Peaks,
    /// The room.
    Room,
    /// The year of control.
    Year,
    /// The room's surfaces, where the perspective shows them.
    Surfaces,
    /// Figures of the dataset.
    Data,
}
