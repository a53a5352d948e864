//! Everything that reads bytes or text, each with what makes a valid file and damages it.
//!
//! An input is a file as it is; or, behind the byte [`MADE`], decisions from which a file is made by this program's own
//! writers and then changed in a few places, so that what lies behind the readers' door is reached too. Whatever the bytes:
//! a reader returns or says one clear sentence, and what it returns keeps what its type promises. Anything else panics.
//!
//! Used by the tests of `tests/formats`, which replay `tests/corpus` and make some thousand random runs, and by
//! `examples/fuzz.rs`, which looks for more.

#![allow(dead_code, reason = "every program uses its own part")]

mod choices;
mod data;
mod dataset_files;
mod edits;
mod luminaires;
mod scenes;
mod tables;

use choices::Choices;
use std::fmt::Display;

/// First byte of an input that is decisions, not a file: none of the formats begins with it.
pub const MADE: u8 = 0xF8;

/// A reader.
#[derive(Clone, Copy)]
pub struct Target {
    /// Its name, and that of its folder of the corpus.
    pub name: &'static str,
    /// A file, valid or nearly so.
    make: fn(&mut Choices) -> Vec<u8>,
    /// Reads a file; panics where something is not as promised. Was it taken?
    read: fn(&[u8]) -> bool,
}

/// All of them.
pub const TARGETS: [Target; 17] = [
    Target { name: "bsdf-matrix", make: dataset_files::make_matrix, read: dataset_files::read_xml },
    Target { name: "bsdf-tree", make: dataset_files::make_tree, read: dataset_files::read_xml },
    Target { name: "btdf-text", make: dataset_files::make_text, read: dataset_files::read_text },
    Target { name: "cfsd", make: dataset_files::make_blob, read: dataset_files::read_blob },
    Target { name: "cfsp", make: dataset_files::make_package, read: dataset_files::read_package },
    Target { name: "eulumdat", make: luminaires::make_eulumdat, read: luminaires::read_eulumdat },
    Target { name: "ies", make: luminaires::make_ies, read: luminaires::read_ies },
    Target { name: "index", make: luminaires::make_index, read: luminaires::read_index },
    Target { name: "scene", make: scenes::make_scene, read: scenes::read_scene },
    Target { name: "system", make: scenes::make_system, read: scenes::read_system },
    Target { name: "session", make: scenes::make_session, read: scenes::read_session },
    Target { name: "typed", make: scenes::make_typed, read: scenes::read_typed },
    Target { name: "curve", make: tables::make_curve, read: tables::read_curve },
    Target { name: "scan", make: tables::make_scan, read: tables::read_scan_file },
    Target { name: "figures", make: tables::make_figures, read: tables::read_figures },
    Target { name: "places", make: tables::make_places, read: tables::read_places },
    Target { name: "archive", make: tables::make_archive, read: tables::read_archive },
];

impl Target {
    /// The one of that name.
    pub fn named(name: &str) -> Option<Self> {
        TARGETS.into_iter().find(|target| target.name == name)
    }

    /// The file that an input stands for.
    pub fn file(&self, input: &[u8]) -> Vec<u8> {
        match input {
            [MADE, rest @ ..] => (self.make)(&mut Choices::new(rest)),
            file => file.to_vec(),
        }
    }

    /// Reads the file that an input stands for. Was it taken?
    pub fn run(&self, input: &[u8]) -> bool {
        (self.read)(&self.file(input))
    }
}

/// An input of decisions drawn at random: the same for the same seed (splitmix64, Steele, Lea and Flood 2014).
pub fn random_input(seed: u64) -> Vec<u8> {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let mut next = move || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    };
    let words = 1 + next() as usize % 60;
    std::iter::once(MADE).chain((0..words).flat_map(|_| next().to_le_bytes())).collect()
}

/// Is this one clear sentence? `false`, for a file that was not taken.
fn told(error: &impl Display) -> bool {
    let text = error.to_string();
    assert!(!text.trim().is_empty(), "an error without words");
    assert!(text.len() < 2000, "an error of {} bytes: {}…", text.len(), text.chars().take(200).collect::<String>());
    false
}

/// Reads again what was written again.
fn again<T, E: Display>(what: &str, read: Result<T, E>) -> T {
    read.unwrap_or_else(|error| panic!("{what} that was read is written so that it cannot be read: {error}"))
}
