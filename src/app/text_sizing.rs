//! Commands of the window on the text size.

use super::text_size::{TextSize, fitting};
use super::window::App;
use crate::texts::shell;
use egui::Vec2;

/// Returns the size of the window, independent of its text size. \[points of the desktop\]
fn window(ctx: &egui::Context) -> Vec2 {
    ctx.content_rect().size() * ctx.zoom_factor()
}

impl App {
    /// Changes the text size, if the window has room for it.
    pub(super) fn change_text_size(&mut self, change: TextSize) {
        // From what is shown: the window may have become too small for what was wanted once.
        let room = window(&self.ctx);
        let shown = fitting(self.state.settings.text_size, room);
        let wanted = change.after(shown);
        if change == TextSize::Larger && fitting(wanted, room) <= shown {
            self.toasts.info(shell::NO_LARGER);
        } else {
            self.state.settings.text_size = wanted;
        }
    }

    /// Sets the chosen text size in egui, or the largest smaller one that the window has room for.
    pub(super) fn follow_text_size(&self, ctx: &egui::Context) {
        let size = fitting(self.state.settings.text_size, window(ctx));
        if (size - ctx.zoom_factor()).abs() > 1e-3 {
            ctx.set_zoom_factor(size);
        }
    }
}
