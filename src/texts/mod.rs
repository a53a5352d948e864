//! Every word that the window, its pictures and its reports say, in English and in German, side by side.
//!
//! A text without figures is a [`Text`], which may stand in a constant table; one with figures is a function that takes
//! them. Which language a thread speaks is set where its work begins ([`speak`]); until then it is English, so that
//! what the command line prints and what stands in data files does not depend on where the program runs.
//!
//! What comes from data (names of products, paths) and units are no texts. Names of things are the field's own:
//! CIE S 017 (ILV) and DIN 5034 for German.

use std::cell::Cell;
use std::fmt;
use std::marker::PhantomData;

/// A language of the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// German.
    German,
}

impl Language {
    /// All, in the order in which they are offered.
    pub const ALL: [Self; 2] = [Self::English, Self::German];

    /// Its name in itself.
    pub fn name(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::German => "Deutsch",
        }
    }

    /// The language for a locale's name such as "de_AT.UTF-8" or "de-CH"; English for those that are not spoken.
    pub fn of_locale(locale: &str) -> Self {
        match locale.split(['_', '-', '.', '@']).next() {
            Some(tag) if tag.eq_ignore_ascii_case("de") => Self::German,
            _ => Self::English,
        }
    }
}

thread_local! {
    static SPOKEN: Cell<Language> = const { Cell::new(Language::English) };
}

/// What this thread speaks.
pub fn language() -> Language {
    SPOKEN.get()
}

/// Speaks a language on this thread until the answer is dropped.
#[must_use = "the language is spoken until this is dropped"]
pub fn speak(language: Language) -> Speaking {
    Speaking { before: SPOKEN.replace(language), here: PhantomData }
}

/// A thread's language as long as it is set, see [`speak`].
#[derive(Debug)]
pub struct Speaking {
    before: Language,
    /// It belongs to its thread.
    here: PhantomData<*const ()>,
}

impl Drop for Speaking {
    fn drop(&mut self) {
        SPOKEN.set(self.before);
    }
}

/// A text in every language; it shows as the one that is spoken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Text {
    english: &'static str,
    german: &'static str,
}

impl Text {
    /// From the text in English and in German.
    pub const fn new(english: &'static str, german: &'static str) -> Self {
        Self { english, german }
    }

    /// The text in the language that is spoken.
    pub fn get(self) -> &'static str {
        match language() {
            Language::English => self.english,
            Language::German => self.german,
        }
    }

    /// The text in English, for names that must not change with the language (files, identifiers).
    pub const fn english(self) -> &'static str {
        self.english
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.get())
    }
}

impl From<Text> for String {
    fn from(text: Text) -> Self {
        text.get().to_owned()
    }
}

impl From<Text> for &'static str {
    fn from(text: Text) -> Self {
        text.get()
    }
}

/// What stands between ones and tenths in the language that is spoken.
///
/// For what people read; files keep the point.
pub fn decimal_sign() -> char {
    match language() {
        Language::English => '.',
        Language::German => ',',
    }
}

/// A number that was written with a decimal point, as the language that is spoken writes it.
pub fn decimal(written: String) -> String {
    match decimal_sign() {
        '.' => written,
        sign => written.replace('.', sign.encode_utf8(&mut [0; 4])),
    }
}

/// `value` with `decimals` digits behind the decimal sign, as the language that is spoken writes it.
pub fn fixed(value: f64, decimals: usize) -> String {
    decimal(format!("{value:.decimals$}"))
}

/// Texts of one file: constants, and functions of what they name in braces (anything that [`fmt::Display`]s; numbers
/// come written, see [`fixed`]).
macro_rules! texts {
    ($($kind:tt $name:ident $(($($arg:ident),+ $(,)?))? = $english:literal | $german:literal;)*) => {
        $($crate::texts::text! { $kind $name $(($($arg),+))? = $english | $german })*

        /// Every text of this file in English and in German, with the names of what is filled in.
        pub(super) const PAIRS: &[(&str, &str)] = &[$(($english, $german)),*];
    };
}

/// One text of [`texts!`].
macro_rules! text {
    (const $name:ident = $english:literal | $german:literal) => {
        #[doc = concat!("“", $english, "”")]
        pub const $name: $crate::texts::Text = $crate::texts::Text::new($english, $german);
    };
    (fn $name:ident ($($arg:ident),+) = $english:literal | $german:literal) => {
        #[doc = concat!("“", $english, "”")]
        pub fn $name($($arg: impl std::fmt::Display),+) -> String {
            match $crate::texts::language() {
                $crate::texts::Language::English => format!($english),
                $crate::texts::Language::German => format!($german),
            }
        }
    };
}

use text;

pub mod catalogue;
pub mod commands;
pub mod compare;
pub mod goniophotometer;
pub mod hand_on;
pub mod scene;
pub mod shell;
pub mod stages;
pub mod take_in;
pub mod tiles;
pub mod words;

/// Every text in English and in German, with the names of what is filled in, by the file that says it.
pub fn pairs() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
    let files: [(&str, &[(&str, &str)]); 11] = [
        ("catalogue", catalogue::PAIRS),
        ("commands", commands::PAIRS),
        ("compare", compare::PAIRS),
        ("goniophotometer", goniophotometer::PAIRS),
        ("hand_on", hand_on::PAIRS),
        ("scene", scene::PAIRS),
        ("shell", shell::PAIRS),
        ("stages", stages::PAIRS),
        ("take_in", take_in::PAIRS),
        ("tiles", tiles::PAIRS),
        ("words", words::PAIRS),
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
