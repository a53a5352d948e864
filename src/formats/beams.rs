//! The description that goes with the numbers of a file, from which beams are computed again.
//!
//! Cells spread a beam over their width; where the numbers were computed from a description, what happens to a beam is
//! better asked of that. A file says so with the version of this addition ("cfs-beams 1"), the text of a system file
//! that names no other files, the key of the state, and a fingerprint of all of it with the numbers. Numbers that
//! somebody changed are no longer those of the description: it is left out then, and a finding tells.

use crate::compute::btdf::{DescribedState, Finding};
use crate::formats::system_toml;

/// Name of the addition.
pub(super) const NAME: &str = "cfs-beams";
/// The version that is written, and the newest that is read.
pub(super) const VERSION: u32 = 1;

/// What a file says: a description, its state, and the fingerprint that was written with them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Told {
    /// Description and state.
    pub described: DescribedState,
    /// As it was written; hexadecimal.
    pub fingerprint: String,
}

impl Told {
    /// The description, when it is that of the numbers that the file holds now.
    pub fn restored(self, fingerprint: &str) -> Result<DescribedState, Finding> {
        let Self { described: DescribedState { text, state }, fingerprint: written } = self;
        if written != fingerprint {
            return Err(not_restored("the numbers or the description were changed after they had been written"));
        }
        let unknown = || not_restored("this program does not understand the description");
        system_toml::described(&text, &state).ok_or_else(unknown)
    }
}

/// Why beams stay what the cells say.
pub(super) fn not_restored(why: &str) -> Finding {
    Finding::warning(
        "beams-not-restored",
        format!("The description in the file was left out: {why}. Beams are what the cells say, no sharper."),
    )
}

/// A hash that does not change with blanks, line ends or the way a number is written.
pub(super) struct Fingerprint(blake3::Hasher);

impl Fingerprint {
    /// Begins with a description and its state.
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

    /// Numbers by their value, all else by its letters.
    pub fn text(&mut self, text: &str) {
        for part in text.split(|c: char| c.is_ascii_whitespace() || c == ',').filter(|part| !part.is_empty()) {
            match part.parse::<f64>() {
                Ok(number) => self.number(number),
                Err(_) => self.word(part),
            }
        }
    }

    /// 32 hexadecimal digits.
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
