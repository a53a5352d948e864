//! Searches for fonts in a job when the window shows characters that it has no font for.

use crate::app::display::fonts::{FindFonts, MissingCharacters};
use crate::app::display::theme::fallback;
use crate::app::results::work::Outcome;
use crate::app::shell::Shell;
use crate::app::shell::jobs::Lane;
use crate::texts::{character_names, shell};
use egui::FontData;
use std::sync::Arc;

/// Search for fonts with the characters that the window shows and has no font for.
pub struct FontSearch {
    /// Function that searches the fonts of the system.
    find: FindFonts,
    /// Characters missing in the built-in fonts.
    missing: Arc<MissingCharacters>,
}

impl FontSearch {
    /// Creates a search by a function.
    pub fn new(find: FindFonts) -> Self {
        Self { find, missing: Arc::default() }
    }

    /// Lets egui record the characters that it has no font for.
    pub fn install(&self, ctx: &egui::Context) {
        ctx.add_font_provider(self.missing.clone());
    }

    /// Starts the search for fonts with the characters that this frame could not draw.
    pub fn ask(&self, shell: &mut Shell) {
        // A newer job would replace the one that is under way.
        if shell.jobs.busy(Lane::Fonts) {
            return;
        }
        let characters = self.missing.take();
        if !characters.is_empty() {
            let find = self.find;
            shell.start(Lane::Fonts, move |_| {
                let (fonts, missing) = find(&characters);
                Outcome::Fonts(fonts, missing)
            });
        }
    }

    /// Installs the fonts that were found, and names the characters that no font has, once per script.
    pub fn take(&self, shell: &mut Shell, fonts: Vec<(String, FontData)>, missing: Vec<char>) {
        for (name, data) in fonts {
            shell.ctx.add_font(fallback(&name, data));
        }
        let missing = self.missing.to_notice(missing);
        if !missing.is_empty() {
            shell.toasts.warning(shell::no_font(character_names(&missing)));
        }
    }
}
