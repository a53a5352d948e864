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
    /// All formats, in the order in which lists show them; IES LM-63 in the edition that most programs read.
    pub const ALL: [Self; 2] = [Self::Eulumdat, Self::Ies(IesEdition::Lm63_2002)];

    /// Returns the name of the format.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Eulumdat => "EULUMDAT",
            Self::Ies(_) => "IES LM-63",
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::extension_of;
    use crate::formats::luminaire::{Description, Opening, Photometry};

    #[test]
    fn what_a_format_writes_is_of_this_format_alone() {
        let luminaire = Luminaire {
            format: String::new(),
            text: Description { name: "Downlight 7".into(), ..Description::default() },
            photometry: Photometry::C,
            opening: Opening::default(),
            c_deg: vec![0.0],
            gamma_deg: vec![0.0, 45.0, 90.0],
            intensity: vec![100.0, 70.0, 0.0],
            lamp_flux: None,
            power: 0.0,
            findings: Vec::new(),
        };
        for format in LuminaireFormat::ALL {
            let bytes = format.write(&luminaire);
            let read = format.read(&bytes).unwrap();
            assert_eq!(read.text.name, luminaire.text.name);
            // EULUMDAT has intensities per lamp flux, which has a limited number of digits.
            assert!(read.intensity.iter().zip(&luminaire.intensity).all(|(a, b)| (a - b).abs() <= 1e-4));
            assert!(LuminaireFormat::ALL.into_iter().filter(|one| one.may_be(&bytes)).eq([format]));
            assert_eq!(extension_of(&bytes), format.extension());
            let name = format!("a{}", format.extension().to_uppercase());
            assert_eq!(LuminaireFormat::from_name(&name), Some(format));
        }
        assert_eq!(LuminaireFormat::from_name("ldt"), None);
    }
}
