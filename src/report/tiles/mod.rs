//! The tiles of the bench on paper, each drawn into a frame.

mod control;
mod hemispheres;
mod lid;
mod room;
mod section;
mod sky;

pub use hemispheres::indicatrix;
pub use section::section;

use super::error::ReportError;
use crate::drawing::colours::Inks;
use crate::drawing::{Drawing, Frame};
use crate::study::subject::{Subject, Wanted};
use std::str::FromStr;

/// A tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum TileKind {
    /// One incidence and where its light goes.
    Btdf,
    /// τ over the incident hemisphere.
    Transmittance,
    /// The dome.
    Sky,
    /// The aperture as a luminaire.
    Lid,
    /// Illuminances.
    Room,
    /// States over profile angle and year.
    Control,
}

impl TileKind {
    /// All, in the order of the bench.
    pub const ALL: [Self; 6] = [Self::Btdf, Self::Transmittance, Self::Sky, Self::Lid, Self::Room, Self::Control];

    /// The title of the tile.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Btdf => "BTDF",
            Self::Transmittance => "Transmittance",
            Self::Sky => "Sky",
            Self::Lid => "LID",
            Self::Room => "Room",
            Self::Control => "Control",
        }
    }

    /// The word on the command line and in file names.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Btdf => "btdf",
            Self::Transmittance => "transmittance",
            Self::Sky => "sky",
            Self::Lid => "lid",
            Self::Room => "room",
            Self::Control => "control",
        }
    }

    /// The tile of a title.
    pub fn titled(title: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.title() == title)
    }

    /// What has to be computed for it.
    pub const fn needs(self) -> Wanted {
        Wanted {
            lid: matches!(self, Self::Lid | Self::Sky),
            room: matches!(self, Self::Room),
            control: matches!(self, Self::Control),
        }
    }
}

impl FromStr for TileKind {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let words = || Self::ALL.map(Self::word).join(", ");
        let found = Self::ALL.into_iter().find(|kind| kind.word() == text);
        found.ok_or_else(|| format!("no tile; expected one of {}", words()))
    }
}

/// Draws a tile; what it says in a line.
pub(super) fn draw(
    drawing: &mut Drawing,
    frame: Frame,
    subject: &Subject,
    tile: TileKind,
    inks: &Inks,
) -> Result<String, ReportError> {
    let told = |why: String| ReportError::Nothing(tile.title(), why);
    match tile {
        TileKind::Btdf => hemispheres::btdf(drawing, frame, subject, inks),
        TileKind::Transmittance => hemispheres::transmittance(drawing, frame, subject, inks),
        TileKind::Sky => Ok(sky::sky(drawing, frame, subject, inks)),
        TileKind::Lid => lid::lid(drawing, frame, subject, inks),
        TileKind::Room => room::room(drawing, frame, subject, inks),
        TileKind::Control => control::control(drawing, frame, subject, inks),
    }
    .map_err(told)
}
