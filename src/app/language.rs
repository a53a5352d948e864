//! In which language the window speaks.

use crate::texts::{Language, Text, shell};

/// Which language the user wants.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum LanguageChoice {
    /// What the desktop says.
    #[default]
    System,
    /// English.
    English,
    /// German.
    German,
}

impl LanguageChoice {
    /// All, in the order of the menu.
    pub const ALL: [Self; 3] = [Self::System, Self::English, Self::German];

    /// In words: languages by their own names.
    pub const fn word(self) -> Text {
        match self {
            Self::System => shell::AS_THE_DESKTOP,
            Self::English => Text::new("English", "English"),
            Self::German => Text::new("Deutsch", "Deutsch"),
        }
    }

    /// The language, where the desktop's is `system`.
    pub fn language(self, system: Language) -> Language {
        match self {
            Self::System => system,
            Self::English => Language::English,
            Self::German => Language::German,
        }
    }
}

/// The desktop's language.
pub fn of_desktop() -> Language {
    Language::of_locale(&sys_locale::get_locale().unwrap_or_default())
}
