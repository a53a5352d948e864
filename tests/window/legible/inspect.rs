//! What a frame of the window would put on the screen, looked through for text that cannot be read and for widgets that
//! are in each other's way. Nothing is drawn: shapes, clip rectangles and accessible names are enough.

use cfs::app::App;
use egui::accesskit::Role;
use egui::epaint::{ClippedShape, TextShape};
use egui::{Id, PanelState, Rect, Shape};
use egui_kittest::Harness;
use egui_kittest::kittest::NodeT;

/// Rounding to pixels, and antialiasing at the edges of letters. \[points\]
const TOLERANCE: f32 = 1.5;

/// A text on the screen.
struct Text {
    words: String,
    /// Where there is ink.
    ink: Rect,
    /// Outside of it nothing is drawn.
    clip: Rect,
    elided: bool,
    size: f32,
    /// The place among all shapes: later ones lie above.
    order: usize,
}

/// All that is painted.
#[derive(Default)]
struct Painted {
    texts: Vec<Text>,
    /// Opaque grounds, with their places among all shapes.
    grounds: Vec<(usize, Rect)>,
    count: usize,
}

impl Painted {
    fn add(&mut self, shape: &Shape, clip: Rect) {
        self.count += 1;
        match shape {
            Shape::Vec(shapes) => shapes.iter().for_each(|shape| self.add(shape, clip)),
            Shape::Text(text) => self.add_text(text, clip),
            Shape::Rect(rect) if rect.fill.is_opaque() => {
                self.grounds.push((self.count, rect.rect.intersect(clip)));
            }
            _ => {}
        }
    }

    fn add_text(&mut self, text: &TextShape, clip: Rect) {
        let ink = text.visual_bounding_rect();
        let words = text.galley.text().trim();
        if words.is_empty() || !ink.is_positive() || text.opacity_factor == 0.0 {
            return;
        }
        let sizes = text.galley.job.sections.iter().map(|section| section.format.font_id.size);
        self.texts.push(Text {
            words: words.to_owned(),
            ink,
            clip,
            elided: text.galley.elided,
            size: sizes.fold(f32::INFINITY, f32::min),
            order: self.count,
        });
    }

    /// Does an opaque ground that comes after `after` and before `before` lie over all of a place?
    fn hidden(&self, place: Rect, after: usize, before: usize) -> bool {
        let over = |(order, ground): &&(usize, Rect)| *order > after && *order < before && ground.contains_rect(place);
        self.grounds.iter().find(over).is_some()
    }
}

fn beyond(inner: Rect, outer: Rect) -> bool {
    !outer.expand(TOLERANCE).contains_rect(inner)
}

/// What cannot be read, or stands in the way of something, in the frame that was drawn last. One line each:
/// what is wrong, with the words.
pub fn problems(harness: &Harness<'_, App>) -> Vec<String> {
    let screen = harness.ctx.content_rect();
    let scrolled = scroll_regions(harness);
    let mut painted = Painted::default();
    for ClippedShape { clip_rect, shape, .. } in &harness.output().shapes {
        painted.add(shape, *clip_rect);
    }
    let mut list = Vec::new();
    let in_sight: Vec<&Text> = painted
        .texts
        .iter()
        .filter(|text| text.ink.intersects(text.clip) && text.clip.is_positive())
        .filter(|text| !painted.hidden(text.ink.intersect(text.clip), text.order, usize::MAX))
        .collect();
    for text in &in_sight {
        if text.elided {
            list.push(format!("cut with …: {:?}", text.words));
        }
        if text.size < 11.0 {
            list.push(format!("smaller than 11 points: {:?}", text.words));
        }
        // A row of a list may stand half out of sight: it is scrolled to.
        let across = text.ink.x_range();
        let in_list = scrolled.iter().any(|region| region.expand(TOLERANCE).contains_rect(text.clip));
        let sideways = across.min < text.clip.left() - TOLERANCE || across.max > text.clip.right() + TOLERANCE;
        if beyond(text.ink, text.clip) && (sideways || !in_list) {
            list.push(format!("out of its part of the window: {:?} {:?} in {:?}", text.words, text.ink, text.clip));
        } else if beyond(text.ink.intersect(text.clip), screen) {
            list.push(format!("out of the window: {:?}", text.words));
        }
    }
    for (k, a) in in_sight.iter().enumerate() {
        for b in &in_sight[k + 1..] {
            // What of both is in sight; letters have air around them.
            let seen = |text: &Text| text.ink.intersect(text.clip).shrink2(egui::vec2(0.5, 1.5));
            let both = seen(a).intersect(seen(b));
            if both.is_positive() && !painted.hidden(both, a.order, b.order) {
                list.push(format!("one over the other: {:?} and {:?}, {:?}", a.words, b.words, both));
            }
        }
    }
    list.extend(widget_problems(harness, screen, &scrolled));
    list
}

/// Where lists and forms are scrolled.
fn scroll_regions(harness: &Harness<'_, App>) -> Vec<Rect> {
    let panels = ["catalogue", "scene", "sheet"].into_iter();
    let known = panels.filter_map(|name| PanelState::load(&harness.ctx, Id::unique(name)).map(|state| state.outer_rect));
    // The goniophotometer's page takes the place of the bench.
    let page = harness.state().state.sheet == Some(cfs::app::state::Sheet::Goniophotometer);
    known.chain(page.then(|| harness.ctx.content_rect())).collect()
}

/// A widget by its name.
struct Widget {
    name: String,
    rect: Rect,
    /// The part that can be clicked.
    seen: Rect,
}

/// Buttons, fields and the like that overlap, are cut or lie outside the window.
fn widget_problems(harness: &Harness<'_, App>, screen: Rect, scrolled: &[Rect]) -> Vec<String> {
    const ROLES: [Role; 8] = [
        Role::Button,
        Role::CheckBox,
        Role::ComboBox,
        Role::Link,
        Role::RadioButton,
        Role::Slider,
        Role::SpinButton,
        Role::TextInput,
    ];
    let rects: Vec<egui::WidgetRect> = harness.ctx.viewport(|viewport| {
        viewport.prev_pass.widgets.layers().flat_map(|(_, widgets)| widgets.iter().copied()).collect()
    });
    let mut widgets = Vec::new();
    let root = harness.root();
    for node in root.children_recursive() {
        let node = node.accesskit_node();
        let id = node.locate().0;
        let Some(rect) = rects.iter().find(|rect| rect.id.accesskit_id() == id) else { continue };
        let name = node.label().or_else(|| node.value()).unwrap_or_default();
        // The head of a tile takes double clicks; what stands on it is above it.
        if ROLES.contains(&node.role()) && !name.starts_with("Tile ") && rect.interact_rect.is_positive() {
            widgets.push(Widget { name, rect: rect.rect, seen: rect.interact_rect });
        }
    }
    let mut list = Vec::new();
    for (k, a) in widgets.iter().enumerate() {
        let in_list = scrolled.iter().any(|region| region.expand(TOLERANCE).contains_rect(a.seen));
        let sideways = a.seen.left() > a.rect.left() + TOLERANCE || a.seen.right() < a.rect.right() - TOLERANCE;
        if beyond(a.rect, a.seen) && (sideways || !in_list) {
            list.push(format!("a widget is cut: {:?} {:?} {:?}", a.name, a.rect, a.seen));
        } else if beyond(a.seen, screen) {
            list.push(format!("a widget is out of the window: {:?}", a.name));
        }
        for b in &widgets[k + 1..] {
            let both = a.seen.intersect(b.seen).shrink(TOLERANCE);
            if both.is_positive() {
                list.push(format!("widgets over each other: {:?} and {:?}", a.name, b.name));
            }
        }
    }
    list
}
