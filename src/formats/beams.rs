//! System descriptions inside data files, from which sharp beams are computed again when the file is read.
//!
//! Patch-averaged data spread a beam over the width of a cell; the description that they were computed from gives the
//! beam exactly. For this purpose a file contains a version ("cfs-beams 1"), the text of a system file that names no
//! other files, the key of the state, and a fingerprint of all this with the data. If the data were changed since, they
//! no longer belong to the description: it is then ignored, and a finding reports it.

use crate::compute::btdf::{DescribedState, Finding};
use crate::formats::system_toml;

/// Name of the extension of data files that holds a description.
pub(super) const NAME: &str = "cfs-beams";
/// Version of the extension that is written, and the newest that is read.
pub(super) const VERSION: u32 = 1;

/// System description in a data file, with its state and the fingerprint that was written with them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct StoredDescription {
    /// System description and key of the state.
    pub described: DescribedState,
    /// Fingerprint that the file states, hexadecimal.
    pub fingerprint: String,
}

impl StoredDescription {
    /// Returns the description if its stored fingerprint equals `fingerprint`, that of the file's present content;
    /// otherwise a finding that reports the difference.
    pub fn restored(self, fingerprint: &str) -> Result<DescribedState, Finding> {
        let Self { described: DescribedState { text, state }, fingerprint: written } = self;
        if written != fingerprint {
            return Err(not_restored("the numbers or the description were changed after they had been written"));
        }
        let unknown = || not_restored("this program does not understand the description");
        system_toml::described(&text, &state).ok_or_else(unknown)
    }
}

/// Returns the finding that reports that the description was ignored, for the reason `why`.
pub(super) fn not_restored(why: &str) -> Finding {
    Finding::warning(
        "beams-not-restored",
        format!("The description in the file was left out: {why}. Beams are what the cells say, no sharper."),
    )
}

/// Hash of numbers and texts that does not depend on white space, line ends or the notation of numbers.
pub(super) struct Fingerprint(blake3::Hasher);

impl Fingerprint {
    /// Creates the hash of a system description and its state, to which the data are then added.
    pub fn new(described: &DescribedState) -> Self {
        let mut new = Self(blake3::Hasher::new());
        // Line ends differ between machines.
        new.word(&described.text.replace('\r', ""));
        new.word(&described.state);
        new
    }

    /// Adds a word to the hash.
    pub fn word(&mut self, word: &str) {
        self.0.update(word.as_bytes()).update(b"\0");
    }

    /// Adds the value of a number to the hash.
    pub fn number(&mut self, number: f64) {
        // Minus zero is zero.
        self.0.update(&(number + 0.0).to_bits().to_le_bytes());
    }

    /// Adds a text to the hash: its numbers by their value, all else by its characters.
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
