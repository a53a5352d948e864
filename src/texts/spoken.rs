//! Language of a thread, and how texts and numbers are written in it.

use std::cell::Cell;
use std::fmt;
use std::marker::PhantomData;

/// Language of the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// German.
    German,
}

impl Language {
    /// All languages, in the order in which they are offered.
    pub const ALL: [Self; 2] = [Self::English, Self::German];

    /// Returns the name of the language in that language.
    pub fn name(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::German => "Deutsch",
        }
    }

    /// Returns the language for a locale's name such as "de_AT.UTF-8" or "de-CH"; English for languages without texts.
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

/// Returns the current language of this thread.
pub fn language() -> Language {
    SPOKEN.get()
}

/// Sets the language of this thread until the returned value is dropped.
#[must_use = "the language is spoken until this is dropped"]
pub fn speak(language: Language) -> Speaking {
    Speaking { before: SPOKEN.replace(language), here: PhantomData }
}

/// Guard for a thread's language as long as it is set, see [`speak`].
#[derive(Debug)]
pub struct Speaking {
    before: Language,
    /// Marker that keeps the value on its thread.
    here: PhantomData<*const ()>,
}

impl Drop for Speaking {
    fn drop(&mut self) {
        SPOKEN.set(self.before);
    }
}

/// Text in every language; it is displayed in the current one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Text {
    english: &'static str,
    german: &'static str,
}

impl Text {
    /// Creates a text from its English and German forms.
    pub const fn new(english: &'static str, german: &'static str) -> Self {
        Self { english, german }
    }

    /// Returns the text in the current language.
    pub fn get(self) -> &'static str {
        match language() {
            Language::English => self.english,
            Language::German => self.german,
        }
    }

    /// Returns the text in English, for names that must not change with the language (files, identifiers).
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

/// Returns the sign between ones and tenths in the current language.
///
/// It is used in texts for people; files keep the point.
pub fn decimal_sign() -> char {
    match language() {
        Language::English => '.',
        Language::German => ',',
    }
}

/// Returns a number that was written with a decimal point in the notation of the current language.
pub fn decimal(written: String) -> String {
    match decimal_sign() {
        '.' => written,
        sign => written.replace('.', sign.encode_utf8(&mut [0; 4])),
    }
}

/// Returns `value` with `decimals` digits after the decimal sign of the current language.
pub fn fixed(value: f64, decimals: usize) -> String {
    decimal(format!("{value:.decimals$}"))
}
