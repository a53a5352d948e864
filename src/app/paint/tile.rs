//! What every tile has: title, unit, toggles, '?', the line with the value under the cursor, and its states of being
//! (empty, coarse, stale, wrong).

use super::palette::Palette;
use egui::{Align, Align2, FontId, Layout, Rect, RichText, Sense, Ui, UiBuilder, pos2};

/// How far the content is to be trusted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Status<'a> {
    /// A first, rough result; the exact one is on its way.
    pub coarse: bool,
    /// Belongs to an earlier scene; drawn faded until replaced.
    pub stale: bool,
    /// Something is being dragged: colour scales and axes stand still.
    pub hold_scale: bool,
    /// What a newer picture waits for, in a few words; said while this one is stale.
    pub doing: Option<&'a str>,
    /// Why there is nothing to show.
    pub error: Option<&'a str>,
}

/// The words of a tile.
#[derive(Debug, Clone, Copy)]
pub struct Words<'a> {
    /// Title, sentence case.
    pub title: &'a str,
    /// Quantity and unit, or the product's name.
    pub subtitle: &'a str,
    /// What '?' says: one sentence and its source.
    pub help: &'a str,
    /// Shown instead of the picture while there is nothing to draw.
    pub empty: Option<&'a str>,
    /// Width that the toggles need side by side; below it they go into a menu. \[points\]
    pub controls_width: f32,
}

/// Height of the head. \[points\]
const HEAD: f32 = 26.0;
/// Height of the line under the picture. \[points\]
const FOOT: f32 = 20.0;

/// Lays out a tile over all the space there is. `body` draws into its rectangle and returns the text of the line
/// under the picture, which keeps its place so that nothing jumps.
pub fn show(
    ui: &mut Ui,
    words: &Words<'_>,
    status: &Status<'_>,
    controls: impl FnOnce(&mut Ui),
    body: impl FnOnce(&mut Ui, Rect) -> String,
) {
    let full = ui.available_rect_before_wrap().shrink2(egui::vec2(6.0, 2.0));
    let head = Rect::from_min_max(full.min, pos2(full.right(), full.top() + HEAD));
    let foot = Rect::from_min_max(pos2(full.left(), full.bottom() - FOOT), full.max);
    let inner = Rect::from_min_max(pos2(full.left(), head.bottom() + 2.0), pos2(full.right(), foot.top() - 2.0));
    let palette = Palette::of(ui.visuals());
    ui.push_id(words.title, |ui| {
        head_ui(ui, head, words, status, controls);
        let notice = status.error.or(words.empty);
        if let Some(text) = notice {
            let colour = if status.error.is_some() { ui.visuals().error_fg_color } else { palette.weak };
            let mut child = ui.new_child(
                UiBuilder::new().max_rect(inner).layout(Layout::centered_and_justified(egui::Direction::TopDown)),
            );
            child.add(egui::Label::new(RichText::new(text).size(13.0).color(colour)).wrap());
        } else if inner.is_positive() {
            let mut child = ui.new_child(UiBuilder::new().max_rect(inner));
            child.set_clip_rect(inner.intersect(ui.clip_rect()));
            if status.stale {
                child.multiply_opacity(0.5);
            }
            let text = body(&mut child, inner);
            let mut line = ui.new_child(UiBuilder::new().max_rect(foot).layout(Layout::left_to_right(Align::Center)));
            line.add(egui::Label::new(RichText::new(text).size(13.0).color(palette.ink)).truncate());
        }
    });
    ui.allocate_rect(full.expand2(egui::vec2(6.0, 2.0)), Sense::hover());
}

fn head_ui(ui: &mut Ui, rect: Rect, words: &Words<'_>, status: &Status<'_>, controls: impl FnOnce(&mut Ui)) {
    let palette = Palette::of(ui.visuals());
    let mut head = ui.new_child(UiBuilder::new().max_rect(rect).layout(Layout::right_to_left(Align::Center)));
    let wide = rect.width() > words.controls_width + 190.0;
    let about = format!("About {}", words.title.to_lowercase());
    head.button("?").on_hover_text(words.help).accessible_name(about);
    if words.empty.is_none() && words.controls_width > 0.0 {
        if wide {
            // Laid out from the right: reversed here, so that the closure writes them in reading order.
            head.allocate_ui_with_layout(
                egui::vec2(words.controls_width, HEAD),
                Layout::left_to_right(Align::Center),
                controls,
            );
        } else {
            head.menu_button("View", controls);
        }
    }
    head.with_layout(Layout::left_to_right(Align::Center), |ui| {
        ui.add(egui::Label::new(RichText::new(words.title).size(14.0).strong()));
        let tag = match (status.stale, status.coarse) {
            (true, _) => Some(status.doing.unwrap_or("updating…")),
            (_, true) => Some("coarse"),
            _ => None,
        };
        if let Some(tag) = tag {
            // Cut where the tile is narrow: what is beside it stays to be clicked.
            ui.add(egui::Label::new(RichText::new(tag).size(13.0).italics().color(palette.second)).truncate());
        }
        ui.add(egui::Label::new(RichText::new(words.subtitle).size(13.0).color(palette.weak)).truncate());
    });
}

/// A caption over a part of a picture.
pub fn caption(ui: &Ui, at: egui::Pos2, align: Align2, text: &str) -> Rect {
    ui.painter().text(at, align, text, FontId::proportional(13.0), Palette::of(ui.visuals()).weak)
}

/// Gives a painted thing its name and value for screen readers, and for tests.
pub fn name(ui: &Ui, response: &egui::Response, name: &str, value: &str) {
    response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Image, true, name));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_value(value));
}

/// A CSV field: quoted when it must be.
pub fn csv_field(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}
