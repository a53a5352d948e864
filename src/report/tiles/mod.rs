//! Tiles of the window drawn on paper, each into a frame.

mod choose;
mod control;
mod hemispheres;
mod lid;
pub(super) mod room;
mod section;
mod sky;
mod year;

pub use hemispheres::indicatrix;
pub use section::section;

use super::error::ReportError;
use crate::drawing::colours::Inks;
use crate::drawing::{Drawing, Frame};
use crate::study::comparison::scales::{self, Range};
use crate::study::subject::{Subject, Wanted};
use crate::texts::{Text, export as texts};
use std::str::FromStr;

/// Kind of a tile of the window, for pictures and reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum TileKind {
    /// BTDF: light distribution for one incident direction.
    Btdf,
    /// Direct-hemispherical transmittance τ over the incident hemisphere.
    Transmittance,
    /// Luminance of the sky dome.
    Sky,
    /// LID: luminous intensity distribution of the aperture as a luminaire.
    Lid,
    /// Illuminances in the room.
    Room,
    /// Shading control: states over profile angle and over the year.
    Control,
    /// Annual simulation: map of the hours of a year, or lighting energy.
    Year,
    /// Ranking of products.
    Choose,
}

impl TileKind {
    /// All kinds of tiles, in the order of the window.
    pub const ALL: [Self; 8] =
        [Self::Btdf, Self::Transmittance, Self::Sky, Self::Lid, Self::Room, Self::Control, Self::Year, Self::Choose];

    /// Returns the key of the tile in saved layouts of the window; it does not change with the labels.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Btdf => "BTDF",
            Self::Transmittance => "Transmittance",
            Self::Sky => "Sky",
            Self::Lid => "LID",
            Self::Room => "Room",
            Self::Control => "Control",
            Self::Year => "Year",
            Self::Choose => "Choose",
        }
    }

    /// Returns the translated title of the tile.
    pub const fn words(self) -> Text {
        match self {
            Self::Btdf => texts::TILE_BTDF,
            Self::Transmittance => texts::TILE_TRANSMITTANCE,
            Self::Sky => texts::TILE_SKY,
            Self::Lid => texts::TILE_LID,
            Self::Room => texts::TILE_ROOM,
            Self::Control => texts::TILE_CONTROL,
            Self::Year => crate::texts::year::YEAR,
            Self::Choose => crate::texts::choose::CHOOSE,
        }
    }

    /// Returns the key of the tile on the command line and in file names.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Btdf => "btdf",
            Self::Transmittance => "transmittance",
            Self::Sky => "sky",
            Self::Lid => "lid",
            Self::Room => "room",
            Self::Control => "control",
            Self::Year => "year",
            Self::Choose => "choose",
        }
    }

    /// Returns the tile with the key `title` in saved layouts, see [`Self::title`]; `None` for other keys.
    pub fn titled(title: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.title() == title)
    }

    /// Returns the computations whose results the tile shows.
    pub const fn needs(self) -> Wanted {
        Wanted {
            lid: matches!(self, Self::Lid | Self::Sky),
            room: matches!(self, Self::Room),
            control: matches!(self, Self::Control),
            year: matches!(self, Self::Year),
        }
    }
}

impl FromStr for TileKind {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        // A ranking does not show a scene: `cfs rank` makes it.
        let all: Vec<Self> = Self::ALL.into_iter().filter(|kind| *kind != Self::Choose).collect();
        let words = || all.iter().map(|kind| kind.word()).collect::<Vec<_>>().join(", ");
        let found = all.iter().copied().find(|kind| kind.word() == text);
        found.ok_or_else(|| texts::no_tile(words()))
    }
}

/// Draws a tile with the results of `subject` into a frame. Returns its summary as a line of text.
pub(super) fn draw(
    drawing: &mut Drawing,
    frame: Frame,
    subject: &Subject,
    tile: TileKind,
    inks: &Inks,
) -> Result<String, ReportError> {
    draw_on(drawing, frame, subject, (tile, None), inks)
}

/// Draws a tile on a colour scale that it has in common with other tiles; `range`: lowest and highest value as
/// [`scale_of`] returns them.
pub(super) fn draw_on(
    drawing: &mut Drawing,
    frame: Frame,
    subject: &Subject,
    (tile, range): (TileKind, Range),
    inks: &Inks,
) -> Result<String, ReportError> {
    match tile {
        TileKind::Btdf => hemispheres::btdf(drawing, frame, subject, range, inks),
        TileKind::Transmittance => hemispheres::transmittance(drawing, frame, subject, range, inks),
        TileKind::Sky => Ok(sky::sky(drawing, frame, subject, range, inks)),
        TileKind::Lid => lid::lid(drawing, frame, subject, range, inks),
        TileKind::Room => room::room(drawing, frame, subject, range, inks),
        TileKind::Control => control::control(drawing, frame, subject, inks),
        TileKind::Year => year::year(drawing, frame, subject, inks),
        TileKind::Choose => choose::choose(drawing, frame, subject, inks),
    }
    .map_err(|why| ReportError::Nothing(tile.words(), why))
}

/// Returns the lowest and highest value of a tile over all subjects, for a common colour scale; `None` where the scale
/// is fixed, or where there is no light.
pub(super) fn scale_of<'a>(tile: TileKind, subjects: impl Iterator<Item = &'a Subject>) -> Range {
    match tile {
        TileKind::Btdf => scales::of_q(subjects.filter_map(|one| Some((one.transmission()?, one.incidence.direction)))),
        TileKind::Transmittance => scales::of_tau(subjects.filter_map(Subject::transmission)),
        TileKind::Sky => scales::of_skies(subjects.map(|one| &one.scene.outside)),
        TileKind::Lid => scales::of_lids(subjects.filter_map(|one| Some(&one.lid.as_ref()?.0.lid))),
        TileKind::Room => {
            let sensors = subjects.filter_map(|one| one.room.as_ref()).flat_map(|room| &room.sensors);
            scales::of_illuminances(sensors.map(|sensor| sensor.total().value))
        }
        TileKind::Control | TileKind::Year | TileKind::Choose => None,
    }
}
