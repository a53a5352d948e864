//! Searches for fonts in a job when the window shows characters that it has no font for.

use super::jobs::Lane;
use super::theme::fallback;
use super::window::App;
use super::work::Outcome;
use crate::texts::{character_names, shell};
use egui::FontData;

impl App {
    /// Starts the search for fonts with the characters that this frame could not draw.
    pub(super) fn ask_fonts(&mut self) {
        // A newer job would replace the one that is under way.
        if self.jobs.busy(Lane::Fonts) {
            return;
        }
        let characters = self.missing_characters.take();
        if !characters.is_empty() {
            let find = self.find_fonts;
            self.start(Lane::Fonts, move |_| {
                let (fonts, missing) = find(&characters);
                Outcome::Fonts(fonts, missing)
            });
        }
    }

    /// Installs the fonts that were found, and names the characters that no font has, once per script.
    pub(super) fn take_fonts(&mut self, fonts: Vec<(String, FontData)>, missing: Vec<char>) {
        for (name, data) in fonts {
            self.ctx.add_font(fallback(&name, data));
        }
        let missing = self.missing_characters.to_notice(missing);
        if !missing.is_empty() {
            self.toasts.warning(shell::no_font(character_names(&missing)));
        }
    }
}
