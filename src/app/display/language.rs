//! Language of the window.

use crate::texts::{Language, Text, shell};

/// Choice of the window's language.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum LanguageChoice {
    /// Language of the desktop.
    #[default]
    System,
    /// English.
    English,
    /// German.
    German,
}

impl LanguageChoice {
    /// All choices, in the order of the menu.
    pub const ALL: [Self; 3] = [Self::System, Self::English, Self::German];

    /// Returns the label of the choice; languages have their native names.
    pub const fn word(self) -> Text {
        match self {
            Self::System => shell::AS_THE_DESKTOP,
            Self::English => Text::new("English", "English"),
            Self::German => Text::new("Deutsch", "Deutsch"),
        }
    }

    /// Returns the language of the window for this choice; `system`: language of the desktop.
    pub fn language(self, system: Language) -> Language {
        match self {
            Self::System => system,
            Self::English => Language::English,
            Self::German => Language::German,
        }
    }
}

/// Returns the language of the desktop.
pub fn of_desktop() -> Language {
    Language::of_locale(&sys_locale::get_locale().unwrap_or_default())
}
