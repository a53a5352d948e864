//! System fonts for characters that the built-in fonts lack. They are searched only when a visible text has such
//! characters, in a job, because listing the fonts of a system takes long.

use crate::texts::is_syllable;
use egui::epaint::text::{FallbackRequest, FontInsert, FontProvider};
use egui::{FontData, FontFamily};
use egui_system_font_provider::SystemFontProvider;
use std::collections::BTreeSet;
use std::sync::{LazyLock, Mutex, PoisonError};

/// Function that searches fonts with the given characters; returns them by name, and the characters that no font has.
pub type FindFonts = fn(&[char]) -> (Vec<(String, FontData)>, Vec<char>);

/// Record of characters in visible texts that no loaded font has.
#[derive(Default)]
pub struct MissingCharacters(Mutex<Characters>);

#[derive(Default)]
struct Characters {
    /// Characters for which fonts have been searched.
    known: BTreeSet<char>,
    new: Vec<char>,
    /// Scripts for which a notice has been shown.
    noticed: BTreeSet<u32>,
}

impl MissingCharacters {
    fn with<T>(&self, act: impl FnOnce(&mut Characters) -> T) -> T {
        act(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Returns the characters found missing since the last call.
    pub(in crate::app) fn take(&self) -> Vec<char> {
        self.with(|characters| std::mem::take(&mut characters.new))
    }

    /// Returns those characters for whose script no notice has been shown yet.
    pub(in crate::app) fn to_notice(&self, characters: Vec<char>) -> Vec<char> {
        // One font serves all of Chinese, Japanese and Korean; other scripts have blocks of their own.
        let script = |c: char| if is_syllable(c) { 0 } else { u32::from(c) >> 8 };
        self.with(|all| {
            let new: Vec<char> = characters.into_iter().filter(|c| !all.noticed.contains(&script(*c))).collect();
            all.noticed.extend(new.iter().map(|c| script(*c)));
            new
        })
    }
}

impl FontProvider for MissingCharacters {
    /// Records the character and returns no font, since the window would wait for the search.
    fn font_for(&self, request: &FallbackRequest<'_>) -> Option<FontInsert> {
        let character = request.cluster.chars().next()?;
        self.with(|characters| {
            if characters.known.insert(character) {
                characters.new.push(character);
            }
        });
        None
    }
}

/// Searches the fonts of the operating system for the given characters. Returns fonts by name, and the characters that
/// none has.
pub fn system_fonts(characters: &[char]) -> (Vec<(String, FontData)>, Vec<char>) {
    static SYSTEM: LazyLock<SystemFontProvider> = LazyLock::new(SystemFontProvider::new);
    let (mut fonts, mut missing) = (Vec::new(), Vec::new());
    for character in characters {
        let cluster = &*character.to_string();
        match SYSTEM.font_for(&FallbackRequest { cluster, family: &FontFamily::Proportional }) {
            Some(font) if fonts.iter().any(|(name, _)| *name == font.name) => {}
            Some(font) => fonts.push((font.name, font.data)),
            None => missing.push(*character),
        }
    }
    (fonts, missing)
}

/// Returns no fonts: replacement of [`system_fonts`] for tests, which must look the same on every machine.
pub fn no_fonts(characters: &[char]) -> (Vec<(String, FontData)>, Vec<char>) {
    (Vec::new(), characters.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::display::theme::{fallback, install};
    use std::sync::Arc;

    #[test]
    fn only_what_no_font_has_is_missed_and_only_once() {
        let ctx = egui::Context::default();
        install(&ctx);
        let missing = Arc::new(MissingCharacters::default());
        ctx.add_font_provider(missing.clone());
        let show = |text: &str| {
            let output = ctx.run_ui(egui::RawInput::default(), |ui| {
                ui.label(text);
                ui.monospace(text);
            });
            output.drop_without_applying_deltas();
            missing.take()
        };
        assert_eq!(
            show("Raffstore, Жалюзи, Περσίδα, תריס, ستارة, ½ → 80 °"),
            [' '; 0],
            "no font of the system is needed"
        );
        assert_eq!(show("铝百叶窗 80"), ['铝', '百', '叶', '窗']);
        assert_eq!(show("铝窗"), [' '; 0]);
        // A font that is found makes egui ask for everything again.
        ctx.add_font(fallback("found", FontData::from_static(crate::drawing::font::DEJAVU)));
        assert_eq!(show("铝百叶窗 帘"), ['帘']);
        assert!(ctx.fonts(|fonts| fonts.definitions().font_data.contains_key("found")));
        assert_eq!(missing.to_notice(vec!['铝', 'क', '百']), ['铝', 'क', '百']);
        assert_eq!(missing.to_notice(vec!['帘', 'ख', 'ก']), ['ก'], "one notice for a script");
    }

    #[test]
    fn a_font_of_the_system_is_found_or_its_characters_are_named() {
        let (fonts, missing) = system_fonts(&['窗', '\u{10ffff}']);
        assert!(missing.contains(&'\u{10ffff}'), "nobody may have a font for it");
        assert!(fonts.is_empty() == missing.contains(&'窗'));
    }
}
