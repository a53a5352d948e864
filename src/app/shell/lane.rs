//! Lanes of jobs, and their priority.

use crate::texts::{Text, catalogue as products, choose, scene, shell, year};

/// Lane: subject of a job, e.g. the room's illuminances. A new job of a lane replaces the earlier one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Lane {
    /// Opening the catalogue, and searching it for the product list.
    Catalogue,
    /// Searching the catalogue for the palette.
    Palette,
    /// Reading of files that the user opened.
    Import,
    /// Grouping of imported files into products.
    Arrange,
    /// Repairs of imported products.
    Repair,
    /// Searching for fonts of the system.
    Fonts,
    /// Asking for paths in a dialog of the desktop.
    Dialog,
    /// Data check of the selected dataset.
    Findings,
    /// Pictures of products.
    Gallery,
    /// Writing into the catalogue.
    Store,
    /// Reading folders of packages that are subscribed to.
    Subscribed,
    /// Sky, sun and selected product of the current scene.
    Scene,
    /// Luminous intensity distribution of the first aperture.
    Lid,
    /// Illuminances at the sensor points of the room.
    Room,
    /// Illuminances of the room's surfaces.
    Surfaces,
    /// States that shading control chooses over the year.
    Year,
    /// Annual simulation of the room.
    Annual,
    /// Ranking of products by their annual simulations.
    Rank,
    /// Reading of the weather file from which hours are chosen.
    Weather,
    /// Filtered or compressed data of one incident direction for the BTDF tile.
    DataForm,
    /// Map of interpolation schemes between the directions of the data.
    Schemes,
    /// Error against computing time, by runs with rising effort.
    Accuracy,
    /// Effects of the obstructions on the illuminance of the apertures.
    Obstructions,
    /// Computation of the selected state's data, which the catalogue does not contain yet.
    Product,
    /// Computation of data of built-in products in advance.
    Builtin,
    /// Results of the candidates of the comparison.
    Compare,
    /// Computation of data from a system description (virtual goniophotometer).
    Goniophotometer,
    /// Preview of an export.
    Preview,
    /// Picture of a tile for the clipboard.
    Copy,
    /// Writing files.
    Export,
}

impl Lane {
    /// Returns the label of the lane in the status line.
    pub const fn word(self) -> Text {
        match self {
            Self::Catalogue => shell::LANE_CATALOGUE,
            Self::Palette => shell::LANE_PALETTE,
            Self::Import => shell::LANE_IMPORT,
            Self::Arrange => shell::LANE_ARRANGE,
            Self::Repair => shell::LANE_REPAIR,
            Self::Fonts => shell::LANE_FONTS,
            Self::Dialog => shell::LANE_DIALOG,
            Self::Findings => products::LANE_FINDINGS,
            Self::Gallery => products::LANE_GALLERY,
            Self::Store => shell::LANE_STORE,
            Self::Subscribed => shell::LANE_SUBSCRIBED,
            Self::Scene => shell::LANE_SCENE,
            Self::Lid => shell::LANE_LID,
            Self::Room => shell::LANE_ROOM,
            Self::Surfaces => shell::LANE_SURFACES,
            Self::Year => shell::LANE_YEAR,
            Self::Annual => year::LANE_ANNUAL,
            Self::Rank => choose::LANE_RANK,
            Self::Weather => year::LANE_WEATHER,
            Self::DataForm => shell::LANE_DATA_FORM,
            Self::Schemes => shell::LANE_SCHEMES,
            Self::Accuracy => shell::LANE_ACCURACY,
            Self::Obstructions => scene::LANE_OBSTRUCTIONS,
            Self::Product => shell::LANE_PRODUCT,
            Self::Builtin => shell::LANE_BUILTIN,
            Self::Compare => shell::LANE_COMPARE,
            Self::Goniophotometer => shell::LANE_GONIOPHOTOMETER,
            Self::Preview => shell::LANE_PREVIEW,
            Self::Copy => shell::LANE_COPY,
            Self::Export => shell::LANE_EXPORT,
        }
    }

    /// Returns the priority of the lane's jobs.
    pub const fn priority(self) -> Priority {
        match self {
            Self::Builtin => Priority::Background,
            // These ask for paths.
            Self::Import | Self::Export => Priority::Asking,
            // A share may take its time.
            Self::Subscribed => Priority::Asking,
            _ => Priority::Visible,
        }
    }
}

/// Priority of a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Priority {
    /// Priority of jobs that visible results depend on.
    Visible,
    /// Priority of jobs that may wait for an answer of the user: they do not pause, nor do other jobs pause for them.
    Asking,
    /// Priority of jobs without visible results: they pause while any visible result is being computed.
    Background,
}
