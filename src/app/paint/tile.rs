//! Parts common to all tiles: title, unit, toggles, '?', the line with the value under the pointer, and the status
//! (empty, preliminary, outdated, with an error).

use super::palette::Palette;
use crate::texts::{Language, Text, language, tiles as say};
use egui::{Align, Align2, Color32, FontId, Id, Layout, Rect, RichText, Sense, Ui, UiBuilder, pos2};

/// Status of a tile's content.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Status<'a> {
    /// Whether the result shown is preliminary, computed with few samples or cells.
    pub coarse: bool,
    /// Whether the result shown is outdated, i.e. belongs to an earlier scene; it is drawn faded.
    pub stale: bool,
    /// Whether no newer result is being computed, so that an outdated or preliminary result stays.
    pub idle: bool,
    /// Whether the user is dragging something, during which colour scales and axes must not change.
    pub hold_scale: bool,
    /// Computation that a newer result waits for, in a few words; shown while the result is outdated.
    pub doing: Option<&'a str>,
    /// Reason why there is no result to show.
    pub error: Option<&'a str>,
}

impl<'a> Status<'a> {
    /// Returns the text in the place of a picture that does not exist: that it is being computed, or else `empty`, the
    /// reason why there is none.
    pub fn missing(&self, empty: Text) -> &'a str {
        match (self.stale, self.idle) {
            (true, false) => self.doing.unwrap_or_else(|| say::PICTURE_COMING.get()),
            _ => empty.get(),
        }
    }

    /// Returns the note on a picture that is outdated or preliminary; `None` for a final one.
    pub fn tag(&self) -> Option<&'a str> {
        match (self.stale, self.coarse, self.idle) {
            (true, _, false) => match self.doing {
                Some(doing) => Some(doing),
                None => Some(say::UPDATING.get()),
            },
            (true, _, true) => Some(say::OUTDATED.get()),
            (false, true, false) => Some(say::COARSE_FOR_NOW.get()),
            (false, true, true) => Some(say::COARSE.get()),
            (false, false, _) => None,
        }
    }
}

/// Line of text under the picture of a tile, such as the value under the pointer, in wordings from the fullest to the
/// shortest; the first that fits is shown.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Foot(Vec<String>);

impl Foot {
    /// Returns the fullest wording of the line.
    pub fn full(&self) -> &str {
        self.0.first().map_or("", String::as_str)
    }

    /// Returns the line with `start` put before each of its wordings.
    pub fn after(self, start: &str) -> Self {
        Self(self.0.into_iter().map(|text| format!("{start}{text}")).collect())
    }

    /// Returns the line with a shorter wording added, which is shown if none of the others fits.
    pub fn or(mut self, shortest: &str) -> Self {
        self.0.push(shortest.to_owned());
        self
    }

    /// Returns the first wording that is at most `room` wide \[points\]; if there is none, the last wording, shortened
    /// by as many of its parts after " · " as necessary.
    fn fitting(&self, ui: &Ui, room: f32) -> String {
        let fits = |text: &str| width(ui, text, SMALL) <= room;
        if let Some(text) = self.0.iter().find(|text| fits(text)) {
            return text.clone();
        }
        let mut rest = self.0.last().map_or("", String::as_str);
        while let Some((start, _)) = rest.rsplit_once(" · ").filter(|_| !fits(rest)) {
            rest = start;
        }
        rest.to_owned()
    }
}

impl From<String> for Foot {
    fn from(text: String) -> Self {
        Self(vec![text])
    }
}

impl From<&str> for Foot {
    fn from(text: &str) -> Self {
        Self(vec![text.to_owned()])
    }
}

impl From<Text> for Foot {
    fn from(text: Text) -> Self {
        Self(vec![text.into()])
    }
}

impl<const N: usize> From<[String; N]> for Foot {
    fn from(texts: [String; N]) -> Self {
        Self(texts.into())
    }
}

/// Texts of a tile, and the width of its controls.
#[derive(Debug, Clone, Copy)]
pub struct Words<'a> {
    /// Title of the tile, in sentence case.
    pub title: &'a str,
    /// Subtitle: quantity and unit, or the product's name.
    pub subtitle: &'a str,
    /// Tooltip of '?': one sentence about the quantity, and the source of its definition.
    pub help: &'a str,
    /// Text shown instead of the picture while there is nothing to draw.
    pub empty: Option<&'a str>,
    /// Width that the controls need side by side \[points\]; in less space they are put into a menu.
    pub controls_width: f32,
}

/// Font size of all text of a tile except its title. \[points\]
const SMALL: f32 = 13.0;
/// Font size of a tile's title. \[points\]
const TITLE: f32 = 14.0;
/// Width of the two buttons in the head of a tile, including the space round them. \[points\]
const BUTTONS: f32 = 96.0;
/// Minimum width of the subtitle \[points\]; in less space it appears in the title's tooltip only.
const LEAST_SUBTITLE: f32 = 54.0;
/// Height of the head of a tile. \[points\]
const HEAD: f32 = 26.0;
/// Height of the line under the picture of a tile. \[points\]
const FOOT: f32 = 20.0;

/// Draws a tile over all available space. `controls` draws the toggles in the head; `body` draws the picture into its
/// rectangle and returns the line under it, whose space is always reserved so that the picture does not move.
pub fn show<F: Into<Foot>>(
    ui: &mut Ui,
    words: &Words<'_>,
    status: &Status<'_>,
    controls: impl FnOnce(&mut Ui),
    body: impl FnOnce(&mut Ui, Rect) -> F,
) {
    let full = ui.available_rect_before_wrap().shrink2(egui::vec2(6.0, 2.0));
    let head = Rect::from_min_max(full.min, pos2(full.right(), full.top() + HEAD));
    let foot = Rect::from_min_max(pos2(full.left(), full.bottom() - FOOT), full.max);
    let inner = Rect::from_min_max(pos2(full.left(), head.bottom() + 2.0), pos2(full.right(), foot.top() - 2.0));
    let palette = Palette::of(ui.visuals());
    ui.push_id(words.title, |ui| {
        let tagged = head_ui(ui, head, words, status, controls);
        if let Some(text) = status.error {
            notice(ui, inner, text, ui.visuals().error_fg_color);
        } else if let Some(text) = words.empty {
            notice(ui, inner, text, palette.weak);
        } else if inner.is_positive() {
            let mut child = ui.new_child(UiBuilder::new().max_rect(inner));
            child.set_clip_rect(inner.intersect(ui.clip_rect()));
            if status.stale {
                child.multiply_opacity(0.5);
            }
            let mut text: Foot = body(&mut child, inner).into();
            // What the head has no room for is said here: a picture never looks newer than it is.
            if let Some(tag) = status.tag().filter(|_| !tagged) {
                text = text.after(&format!("{tag} · ")).or(tag);
            }
            if ui.rect_contains_pointer(inner) {
                ui.data_mut(|data| data.insert_temp(pointed_id(), text.full().to_owned()));
            }
            let mut line = ui.new_child(UiBuilder::new().max_rect(foot).layout(Layout::left_to_right(Align::Center)));
            let short = text.fitting(ui, foot.width());
            let shortened = short != text.full();
            // Figures of an earlier scene stand back as their picture does.
            let colour = if status.stale { palette.weak } else { palette.ink };
            let label = egui::Label::new(RichText::new(&short).size(SMALL).color(colour)).truncate();
            let response = line.add(label.show_tooltip_when_elided(!shortened));
            if shortened {
                response.on_hover_text(text.full());
            }
        }
    });
    ui.allocate_rect(full.expand2(egui::vec2(6.0, 2.0)), Sense::hover());
}

/// Returns the id under which egui stores the line of the tile that was last under the pointer.
fn pointed_id() -> Id {
    Id::unique("line of the tile under the pointer")
}

/// Returns the fullest wording of the line under the picture of the tile that was last under the pointer; `None` if
/// there was none.
pub fn pointed_foot(ctx: &egui::Context) -> Option<String> {
    ctx.data(|data| data.get_temp(pointed_id()))
}

/// Returns the width of one line of text at a font size. \[points\]
fn width(ui: &Ui, text: &str, size: f32) -> f32 {
    ui.painter().layout_no_wrap(text.to_owned(), FontId::proportional(size), Color32::PLACEHOLDER).size().x
}

/// Draws the head of a tile: title, subtitle, note on the status, controls. Returns `true` if there was room for the
/// note.
fn head_ui(ui: &mut Ui, rect: Rect, words: &Words<'_>, status: &Status<'_>, controls: impl FnOnce(&mut Ui)) -> bool {
    let palette = Palette::of(ui.visuals());
    let mut head = ui.new_child(UiBuilder::new().max_rect(rect).layout(Layout::right_to_left(Align::Center)));
    let with_controls = words.empty.is_none() && words.controls_width > 0.0;
    // German words are longer.
    let longer = if language() == Language::German { 1.2 } else { 1.0 };
    let controls_width = longer * words.controls_width;
    let wide = rect.width() > controls_width + 190.0;
    // Where title and two buttons do not fit side by side, one menu holds all.
    let title = width(ui, words.title, TITLE);
    let narrow = with_controls && !wide && title + longer * BUTTONS > rect.width();
    // German nouns keep their capitals.
    let about = match language() {
        Language::English => say::about(words.title.to_lowercase()),
        Language::German => say::about(words.title),
    };
    if narrow {
        let menu = head.menu_button("…", |ui| {
            controls(ui);
            ui.separator();
            ui.add(egui::Label::new(RichText::new(words.help).size(SMALL)).wrap());
        });
        menu.response.on_hover_text(say::VIEW_AND_ABOUT).accessible_name(about);
    } else {
        head.button("?").on_hover_text(words.help).accessible_name(about);
        if with_controls && wide {
            // Laid out from the right: reversed here, so that the closure writes them in reading order.
            head.allocate_ui_with_layout(
                egui::vec2(controls_width, HEAD),
                Layout::left_to_right(Align::Center),
                controls,
            );
        } else if with_controls {
            head.menu_button(say::VIEW, controls);
        }
    }
    head.with_layout(Layout::left_to_right(Align::Center), |ui| {
        let title = ui.add(egui::Label::new(RichText::new(words.title).size(TITLE).strong()));
        title.on_hover_text(words.subtitle);
        let mut tagged = true;
        // Where there is no picture the words in its place say it.
        if let Some(tag) = status.tag().filter(|_| words.empty.is_none()) {
            tagged = width(ui, tag, SMALL) + 2.0 <= ui.available_width();
            if tagged {
                let tag = RichText::new(tag).size(SMALL).italics().color(palette.second);
                ui.add(egui::Label::new(tag).extend());
            }
        }
        if ui.available_width() > LEAST_SUBTITLE {
            ui.add(egui::Label::new(RichText::new(words.subtitle).size(SMALL).color(palette.weak)).truncate());
        }
        tagged
    })
    .inner
}

/// Returns the layout of a text in the place of a picture: in its middle, without spreading the letters of full lines
/// over their width, as egui's layout for something centred does.
pub fn middle() -> Layout {
    Layout::top_down(Align::Center).with_main_align(Align::Center).with_main_justify(true)
}

/// Draws text in the middle of a tile instead of its picture.
fn notice(ui: &mut Ui, rect: Rect, text: &str, colour: Color32) {
    let mut child = ui.new_child(UiBuilder::new().max_rect(rect).layout(middle()));
    child.add(egui::Label::new(RichText::new(text).size(SMALL).color(colour)).wrap());
}

/// Draws a whole tile that has no picture yet: its head, and `text` in the middle.
pub fn waiting(ui: &mut Ui, title: &str, help: &str, text: &str, is_error: bool) {
    let status = Status { error: is_error.then_some(text), ..Status::default() };
    let words = Words { title, subtitle: "", help, empty: Some(text), controls_width: 0.0 };
    show(ui, &words, &status, |_| {}, |_, _| "");
}

/// Draws a caption over a part of a picture.
pub fn caption(ui: &Ui, at: egui::Pos2, align: Align2, text: &str) -> Rect {
    ui.painter().text(at, align, text, FontId::proportional(13.0), Palette::of(ui.visuals()).weak)
}

/// Sets the name and value of a painted object for screen readers and for tests.
pub fn name(ui: &Ui, response: &egui::Response, name: impl Into<String>, value: &str) {
    let name: String = name.into();
    response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Image, true, name.as_str()));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_value(value));
}
