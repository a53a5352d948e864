//! Commands of the window on the text size.

use crate::app::display::text_size::{TextSize, fitting};
use crate::app::shell::Shell;
use crate::texts::shell;
use egui::Vec2;

/// Returns the size of the window, independent of its text size. \[points of the desktop\]
fn window(ctx: &egui::Context) -> Vec2 {
    ctx.content_rect().size() * ctx.zoom_factor()
}

/// Changes the text size, if the window has room for it.
pub fn change_text_size(shell: &mut Shell, change: TextSize) {
    // From what is shown: the window may have become too small for what was wanted once.
    let room = window(&shell.ctx);
    let shown = fitting(shell.state.settings.text_size, room);
    let wanted = change.after(shown);
    if change == TextSize::Larger && fitting(wanted, room) <= shown {
        shell.toasts.info(shell::NO_LARGER);
    } else {
        shell.state.settings.text_size = wanted;
    }
}

/// Sets the chosen text size in egui, or the largest smaller one that the window has room for.
pub fn follow_text_size(shell: &Shell, ctx: &egui::Context) {
    let size = fitting(shell.state.settings.text_size, window(ctx));
    if (size - ctx.zoom_factor()).abs() > 1e-3 {
        ctx.set_zoom_factor(size);
    }
}
