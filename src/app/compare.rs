//! Comparison in the window: its commands, and how it is shown. The list of candidates is part of the scene
//! ([`CompareKeys`](crate::study::scene_file::CompareKeys)).

use crate::texts::compare as texts;

/// Command about the comparison. Numbers are places in the list of candidates, from 0.
#[derive(Debug, Clone, PartialEq)]
pub enum Act {
    /// Add what is shown: product and state, or control rule. Everything else follows the scene.
    Add,
    /// Add a product by its key, in the state or with the control rule that it is first shown with.
    AddProduct(String),
    /// Add what is shown, with the current sky and sun fixed.
    AddMoment,
    /// Add what is shown with everything: room, apertures, sensor points, place, sky.
    AddScene,
    /// Make a candidate the scene, with everything that the candidate fixes.
    Take(usize),
    /// Remove a candidate.
    Remove(usize),
    /// Move a candidate by this number of places.
    Move(usize, isize),
    /// Edit the name of a candidate; `None`: leave it unchanged.
    EditName(Option<(usize, String)>),
    /// Rename a candidate.
    Rename(usize, String),
    /// Remove all candidates.
    Clear,
    /// Show the comparison in place of the tile area, or return to the tiles.
    Show,
    /// Set how the candidates are compared.
    Look(Look),
    /// Set the compared tile, by its title.
    Tile(&'static str),
    /// Set logarithmic or linear scales in all tiles.
    Log(bool),
    /// Set the reference candidate that differences are taken from.
    Base(usize),
    /// Show the other candidate in the tiles, or return to the scene.
    Swap,
    /// Show this candidate in the tiles.
    SwapWith(usize),
    /// Copy the table of figures to the clipboard.
    Copy,
    /// Continue computing after a stop.
    Resume,
}

/// Form of the comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Look {
    /// One tile per candidate, all on one scale.
    #[default]
    Beside,
    /// Difference of each candidate minus the reference, with sign.
    Difference,
    /// Curves of all candidates in one plot.
    Curves,
    /// Table of figures with uncertainties.
    Figures,
}

impl Look {
    /// All forms, in the order of the bar.
    pub const ALL: [Self; 4] = [Self::Beside, Self::Difference, Self::Curves, Self::Figures];

    /// Returns the label.
    pub fn words(self) -> &'static str {
        match self {
            Self::Beside => texts::BESIDE,
            Self::Difference => texts::DIFFERENCE,
            Self::Curves => texts::CURVES,
            Self::Figures => texts::FIGURES,
        }
        .get()
    }

    /// Returns the tooltip, one sentence.
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

/// Display settings of the comparison.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct View {
    /// Whether the comparison is shown in place of the tile area.
    pub open: bool,
    /// Form of the comparison.
    pub look: Look,
    /// Title of the compared tile; empty: that of the room.
    pub tile: &'static str,
    /// Whether all tiles side by side have logarithmic scales; `None`: each tile's default.
    pub log: Option<bool>,
    /// Place of the reference candidate of differences.
    pub base: usize,
    /// Candidate that is shown in the tiles instead of the scene.
    pub swapped: Option<usize>,
    /// Candidate that was chosen to swap with.
    pub other: Option<usize>,
    /// Candidate whose name is being typed, and the text.
    pub naming: Option<(usize, String)>,
}

/// Part of the results of a candidate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Product, state, dataset, sky and sun.
    Shelf,
    /// LID of the first aperture.
    Lid,
    /// Largest intensities of the LID.
    Peaks,
    /// Illuminances in the room.
    Room,
    /// Year of shading control.
    Year,
    /// Illuminances of the room's surfaces, if the perspective shows them.
    Surfaces,
    /// Figures of the dataset.
    Data,
}
