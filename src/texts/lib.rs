//! Texts of the window, its pictures and its reports, in English and in German, side by side.
//!
//! A text without figures is a [`Text`], which may stand in a constant table; one with figures is a function that takes
//! them. The language of a thread is set where its work begins ([`speak`]); until then it is English, so that the
//! output of the command line and the content of data files do not depend on where the program runs.
//!
//! Data (names of products, paths) and units are not texts of this crate. Terms are the field's own: CIE S 017 (ILV)
//! and DIN 5034 for German.

#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::disallowed_methods))]

mod ascii;
mod bidi;
mod csv_cell;
mod plain;
mod spoken;
#[cfg(feature = "egui")]
mod widgets;

pub use ascii::{ascii_letters, ascii_words, composed, folded, is_syllable};
pub use bidi::{has_right_to_left, visual_parts};
pub use csv_cell::{csv_cell, inert_cell};
pub use plain::{character_names, message, one_line, short_numbers, visible};
pub use spoken::{Language, Speaking, Text, decimal, decimal_sign, fixed, language, speak};

/// Defines the texts of one file: constants, and functions of the arguments in braces (anything that
/// [`std::fmt::Display`]s; numbers are formatted before, see [`fixed`]).
macro_rules! texts {
    ($($kind:tt $name:ident $(($($arg:ident),+ $(,)?))? = $english:literal | $german:literal;)*) => {
        $($crate::text! { $kind $name $(($($arg),+))? = $english | $german })*

        /// Every text of this file in English and in German, with the names of the arguments.
        pub(super) const PAIRS: &[(&str, &str)] = &[$(($english, $german)),*];
    };
}

/// Defines one text of [`texts!`].
macro_rules! text {
    (const $name:ident = $english:literal | $german:literal) => {
        #[doc = concat!("`", $english, "`")]
        pub const $name: $crate::Text = $crate::Text::new($english, $german);
    };
    (fn $name:ident ($($arg:ident),+) = $english:literal | $german:literal) => {
        #[doc = concat!("`", $english, "`")]
        pub fn $name($($arg: impl std::fmt::Display),+) -> String {
            match $crate::language() {
                $crate::Language::English => format!($english),
                $crate::Language::German => format!($german),
            }
        }
    };
}

use text;

pub mod catalogue;
pub mod choose;
pub mod commands;
pub mod compare;
pub mod export;
pub mod findings;
pub mod goniophotometer;
pub mod import;
pub mod scene;
pub mod shell;
pub mod stages;
pub mod tiles;
pub mod words;
pub mod year;

/// Returns every text in English and in German, with the names of the arguments, and the name of its file.
pub fn pairs() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
    let files: [(&str, &[(&str, &str)]); 14] = [
        ("catalogue", catalogue::PAIRS),
        ("choose", choose::PAIRS),
        ("commands", commands::PAIRS),
        ("compare", compare::PAIRS),
        ("findings", findings::PAIRS),
        ("goniophotometer", goniophotometer::PAIRS),
        ("export", export::PAIRS),
        ("scene", scene::PAIRS),
        ("shell", shell::PAIRS),
        ("stages", stages::PAIRS),
        ("import", import::PAIRS),
        ("tiles", tiles::PAIRS),
        ("words", words::PAIRS),
        ("year", year::PAIRS),
    ];
    files.into_iter().flat_map(|(file, pairs)| pairs.iter().map(move |(english, german)| (file, *english, *german)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Names in braces.
    fn filled(text: &str) -> BTreeSet<&str> {
        text.split('{').skip(1).filter_map(|rest| rest.split('}').next()).collect()
    }

    #[test]
    fn both_languages_say_the_same_figures() {
        for (file, english, german) in pairs() {
            assert_eq!(filled(english), filled(german), "{file}: {english}");
            assert!(!german.is_empty() && german.trim() == german || english.trim() != english, "{file}: {english}");
        }
    }

    #[test]
    fn a_language_is_spoken_until_it_is_dropped_and_by_its_thread_alone() {
        let text = Text::new("sky", "Himmel");
        {
            let _german = speak(Language::German);
            assert_eq!((text.to_string().as_str(), fixed(2.5, 2).as_str()), ("Himmel", "2,50"));
            assert_eq!(std::thread::spawn(move || text.get()).join().unwrap(), "sky");
        }
        assert_eq!((text.get(), fixed(2.5, 2).as_str()), ("sky", "2.50"));
    }

    #[test]
    fn locales_by_their_language() {
        for (locale, language) in [
            ("de_DE.UTF-8", Language::German),
            ("de-CH", Language::German),
            ("DE", Language::German),
            ("en_GB", Language::English),
            ("den_CA", Language::English),
            ("C", Language::English),
            ("", Language::English),
        ] {
            assert_eq!(Language::of_locale(locale), language, "{locale}");
        }
    }
}
