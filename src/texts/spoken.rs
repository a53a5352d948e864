//! Which language a thread speaks, and how it writes texts and numbers in it.

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
