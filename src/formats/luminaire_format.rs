//! Formats of luminaire files, and what differs between them.

use super::ies::IesEdition;
use super::luminaire::Luminaire;
use super::{FormatError, eulumdat, ies};

/// Format of the luminaire files that the program reads and writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LuminaireFormat {
    /// EULUMDAT.
    Eulumdat,
    /// IES LM-63, written in this edition and read in any.
    Ies(IesEdition),
}

impl LuminaireFormat {
    /// All formats, in the order in which lists show them.
    pub const ALL: [Self; 2] = [Self::Eulumdat, Self::Ies(IesEdition::Lm63_2002)];

    /// Returns the name of the format, with the edition in which it is written.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Eulumdat => "EULUMDAT",
            Self::Ies(IesEdition::Lm63_2002) => "IES LM-63-2002",
            Self::Ies(IesEdition::Lm63_2019) => "IES LM-63-2019",
        }
    }

    /// Returns the name of a file of the format with its article, for messages.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Eulumdat => "an EULUMDAT file",
            Self::Ies(_) => "an IES file",
        }
    }

    /// Returns the file name extension of the format, in lower case with its dot.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Eulumdat => ".ldt",
            Self::Ies(_) => ".ies",
        }
    }

    /// Returns the format with the extension of a file's name; `None` for other extensions.
    pub fn from_name(name: &str) -> Option<Self> {
        let name = name.to_ascii_lowercase();
        Self::ALL.into_iter().find(|format| name.ends_with(format.extension()))
    }

    /// Whether bytes can be a file of the format, judged by the first of them.
    pub fn may_be(self, head: &[u8]) -> bool {
        match self {
            Self::Eulumdat => eulumdat::read(head).is_ok(),
            Self::Ies(_) => head.trim_ascii_start().starts_with(b"IES"),
        }
    }

    /// Reads a luminaire file.
    ///
    /// # Errors
    /// Returns an error if the file is not valid.
    pub fn read(self, bytes: &[u8]) -> Result<Luminaire, FormatError> {
        match self {
            Self::Eulumdat => eulumdat::read(bytes),
            Self::Ies(_) => ies::read(bytes),
        }
    }

    /// Returns a file of a luminaire of photometry C whose planes cover the full turn (or are a single one).
    pub fn write(self, luminaire: &Luminaire) -> Vec<u8> {
        match self {
            Self::Eulumdat => eulumdat::write(luminaire),
            Self::Ies(edition) => ies::write(luminaire, edition),
        }
    }
}
