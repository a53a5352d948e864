//! Descriptions in data files, from which sharp beams are computed again.
//!
//! Cells spread a beam over their width; where the numbers were computed from a description, that gives the beam more
//! exactly. A file contains for this the version of the addition ("cfs-beams 1"), the text of a system file that names
//! no other files, the key of the state, and a fingerprint of all of it with the numbers. If the numbers were changed
//! since, they are no longer those of the description: it is left out then, and a finding reports it.

use crate::compute::btdf::{DescribedState, Finding};
use crate::formats::system_toml;

/// Name of the addition.
pub(super) const NAME: &str = "cfs-beams";
/// Version that is written, and the newest that is read.
pub(super) const VERSION: u32 = 1;

/// Description in a file, with its state and the fingerprint that was written with them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct StoredDescription {
    /// Description and state.
    pub described: DescribedState,
    /// Fingerprint in the file, hexadecimal.
    pub fingerprint: String,
}

impl StoredDescription {
    /// Returns the description if it is that of the numbers that the file holds now, else a finding.
    pub fn restored(self, fingerprint: &str) -> Result<DescribedState, Finding> {
        let Self { described: DescribedState { text, state }, fingerprint: written } = self;
        if written != fingerprint {
            return Err(not_restored("the numbers or the description were changed after they had been written"));
        }
        let unknown = || not_restored("this program does not understand the description");
        system_toml::described(&text, &state).ok_or_else(unknown)
    }
}

/// Returns the finding that the description was left out, for the reason `why`.
pub(super) fn not_restored(why: &str) -> Finding {
    Finding::warning(
        "beams-not-restored",
        format!("The description in the file was left out: {why}. Beams are what the cells say, no sharper."),
    )
}

/// Hash of numbers and texts that does not depend on blanks, line ends or the notation of a number.
pub(super) struct Fingerprint(blake3::Hasher);

impl Fingerprint {
    /// Creates a hash of a description and its state, to which more is added.
    pub fn new(described: &DescribedState) -> Self {
        let mut new = Self(blake3::Hasher::new());
        // Line ends differ between machines.
        new.word(&described.text.replace('\r', ""));
        new.word(&described.state);
        new
    }

    /// Adds a word.
    pub fn word(&mut self, word: &str) {
        self.0.update(word.as_bytes()).update(b"\0");
    }

    /// Adds a number by its value.
    pub fn number(&mut self, number: f64) {
        // Minus zero is zero.
        self.0.update(&(number + 0.0).to_bits().to_le_bytes());
    }

    /// Adds a text: its numbers by their value, all else by its letters.
    pub fn text(&mut self, text: &str) {
        for part in text.split(|c: char| c.is_ascii_whitespace() || c == ',').filter(|part| !part.is_empty()) {
            match part.parse::<f64>() {
                Ok(number) => self.number(number),
                Err(_) => self.word(part),
            }
        }
    }

    /// Returns the hash as 32 hexadecimal digits.
    pub fn finish(self) -> String {
        self.0.finalize().to_hex()[..32].to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_count_and_not_how_they_are_written() {
        let of = |text: &str| {
            let mut print = Fingerprint::new(&DescribedState::default());
            print.text(text);
            print.finish()
        };
        assert_eq!(of("{ 1.5, 0 2e-3 }"), of("{\r\n1.50\t-0.0  0.002 }"));
        assert_ne!(of("1.5 0"), of("1.5 0.1"));
        assert_ne!(of("1.5 0"), of("0 1.5"));
    }
}
