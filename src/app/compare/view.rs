//! Comparison in the window: its commands and display settings. The list of candidates is part of the scene
//! ([`CompareKeys`](crate::study::scene_file::CompareKeys)).

use crate::texts::compare as texts;

/// Command about the comparison. Numbers are positions in the list of candidates, from 0.
#[derive(Debug, Clone, PartialEq)]
pub enum Act {
    /// Add the current product with its state or control rule as a candidate; everything else follows the scene.
    Add,
    /// Add the product with this key as a candidate, in its representative state or with the control rule that it
    /// defines.
    AddProduct(String),
    /// Add the current product as a candidate with the current sky and sun fixed.
    AddMoment,
    /// Add the whole current scene as a candidate: product, room, apertures, sensor points, location, sky.
    AddScene,
    /// Use a candidate as the scene, with everything that the candidate fixes.
    Take(usize),
    /// Remove a candidate.
    Remove(usize),
    /// Move a candidate in the list by this number of positions.
    Move(usize, isize),
    /// Set the text in the name field of a candidate; `None`: end editing without a change.
    EditName(Option<(usize, String)>),
    /// Rename a candidate.
    Rename(usize, String),
    /// Remove all candidates.
    Clear,
    /// Show the comparison instead of the tile area, or return to the tiles.
    Show,
    /// Set the display of the comparison.
    Look(Look),
    /// Set the tile that is compared, by its key.
    Tile(&'static str),
    /// Set logarithmic (`true`) or linear scales in the tiles of all candidates.
    Log(bool),
    /// Set the reference candidate, from which differences are taken.
    Base(usize),
    /// Show the candidate that was chosen to swap with in the tiles, or return to the scene.
    Swap,
    /// Show this candidate in the tiles instead of the scene.
    SwapWith(usize),
    /// Copy the table of figures to the clipboard.
    Copy,
    /// Continue the computation of the candidates after a stop.
    Resume,
}

/// Display of the comparison: tiles side by side, differences, curves or figures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Look {
    /// One tile per candidate, all on one colour scale.
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
    /// All displays of the comparison, in the order of the toolbar.
    pub const ALL: [Self; 4] = [Self::Beside, Self::Difference, Self::Curves, Self::Figures];

    /// Returns the label of the display.
    pub fn words(self) -> &'static str {
        match self {
            Self::Beside => texts::BESIDE,
            Self::Difference => texts::DIFFERENCE,
            Self::Curves => texts::CURVES,
            Self::Figures => texts::FIGURES,
        }
        .get()
    }

    /// Returns the tooltip of the display, one sentence.
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
    /// Whether the comparison is shown instead of the tile area.
    pub open: bool,
    /// Display of the comparison that is selected.
    pub look: Look,
    /// Key of the tile that is compared; empty: that of the room.
    pub tile: &'static str,
    /// Whether all tiles side by side have logarithmic scales; `None`: each tile's default.
    pub log: Option<bool>,
    /// Position in the list of the reference candidate, from which differences are taken.
    pub base: usize,
    /// Position in the list of the candidate that the tiles show instead of the scene, if any.
    pub swapped: Option<usize>,
    /// Position in the list of the candidate that was chosen to swap with, if any.
    pub other: Option<usize>,
    /// Position in the list of the candidate whose name is being typed, and the text.
    pub naming: Option<(usize, String)>,
}

/// Kind of results of a candidate, computed separately.
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
    /// States that shading control chooses over the year.
    Year,
    /// Illuminances of the room's surfaces, if the perspective shows them.
    Surfaces,
    /// Optical figures of the dataset.
    Data,
}
