//! Parts shared by the pages of the year tile.

use super::input::Action;
use crate::app::paint::palette::Palette;
use crate::texts::year as say;
use egui::{ProgressBar, Ui, Vec2, vec2};

/// Space round the content of a page (x, y). \[points\]
pub(super) const GAP: Vec2 = vec2(6.0, 4.0);

/// Draws the progress `share`, 0 … 1, of a running annual simulation, and a button that stops it.
pub(super) fn progress(ui: &mut Ui, share: f32, out: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let width = (ui.available_width() - 80.0).max(40.0);
        ui.add(ProgressBar::new(share).desired_width(width).show_percentage());
        if ui.button(say::STOP).on_hover_text(say::STOP_TIP).clicked() {
            out.push(Action::Stop);
        }
    });
}

/// Draws a line of text in the colour of secondary text.
pub(super) fn weak(ui: &mut Ui, text: &str) {
    let colour = Palette::of(ui.visuals()).weak;
    ui.add(egui::Label::new(egui::RichText::new(text).size(13.0).color(colour)).wrap());
}
