//! What jobs work on, and who goes first.

use crate::texts::{Text, catalogue as products, choose, scene, shell, year};

/// What a job works on. Later requests of a lane replace earlier ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Lane {
    /// Opening the catalogue and searching in it.
    Catalogue,
    /// Searching for what the palette's words fit.
    Palette,
    /// Reading files that the user opened.
    Import,
    /// Taking what was read for other products.
    Arrange,
    /// Repairs of what was read.
    Mend,
    /// Looking for fonts of the system.
    Fonts,
    /// Asking the desktop for paths.
    Dialog,
    /// What the checks say about the selected dataset.
    Findings,
    /// Pictures of products.
    Gallery,
    /// Writing into the catalogue.
    Store,
    /// Reading folders of packages that are subscribed to.
    Subscribed,
    /// From the scene as typed to sky, sun and systems.
    Scene,
    /// The luminous-intensity distribution.
    Lid,
    /// Illuminances in the room.
    Room,
    /// Illuminances of the room's surfaces.
    Surfaces,
    /// What control chooses over the year.
    Year,
    /// A year of weather in the room.
    Annual,
    /// Products through a year, put in order.
    Rank,
    /// Reading the weather that hours are picked from.
    Weather,
    /// The data of one incidence in another form.
    DataForm,
    /// How light is interpolated between the directions of the data.
    Schemes,
    /// Error against run time.
    Accuracy,
    /// Effects of obstructions.
    Obstructions,
    /// Computing the data of the chosen state, which the catalogue does not hold yet.
    Product,
    /// Computing data of built-in products that nobody has asked for yet.
    Builtin,
    /// What is compared.
    Compare,
    /// Data computed from a description.
    Goniophotometer,
    /// What would be handed on.
    Preview,
    /// A picture for the clipboard.
    Copy,
    /// Writing files.
    Export,
}

impl Lane {
    /// What the status line calls it.
    pub const fn word(self) -> Text {
        match self {
            Self::Catalogue => shell::LANE_CATALOGUE,
            Self::Palette => shell::LANE_PALETTE,
            Self::Import => shell::LANE_IMPORT,
            Self::Arrange => shell::LANE_ARRANGE,
            Self::Mend => shell::LANE_MEND,
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

    /// Who goes first.
    pub const fn priority(self) -> Priority {
        match self {
            Self::Builtin => Priority::Background,
            // These ask for paths.
            Self::Import | Self::Export => Priority::Asking,
            // A share may take its time.
            Self::Subscribed => Priority::Asking,
            _ => Priority::InSight,
        }
    }
}

/// Who goes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Priority {
    /// What is in sight hangs on it.
    InSight,
    /// May stand waiting for an answer of the user: neither gives way nor is given way to.
    Asking,
    /// Nobody looks at it: rests while anything in sight is under way.
    Background,
}
