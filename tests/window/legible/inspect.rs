//! What a frame of the window would put on the screen, looked through for text that cannot be read and for widgets that
//! are in each other's way. Nothing is drawn: shapes, clip rectangles and accessible names are enough.

use cfs::app::{App, title};
use egui::accesskit::Role;
use egui::epaint::{ClippedShape, TextShape};
use egui::{Rect, Shape};
use egui_kittest::Harness;
use egui_kittest::kittest::NodeT;

/// Rounding to pixels, and antialiasing at the edges of letters. \[points\]
const TOLERANCE: f32 = 1.5;

/// Text must not be smaller. \[points\]
const LEAST_SIZE: f32 = 13.0;
const LEAST_NUMBER: f32 = 11.0;

/// A text on the screen.
struct Text {
    words: String,
    /// Where there is ink.
    ink: Rect,
    /// Outside of it nothing is drawn.
    clip: Rect,
    elided: bool,
    /// A line ends within a word.
    broken: bool,
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
            broken: is_broken(&text.galley),
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

/// All words that the last frame would put on the screen.
pub fn words<S>(harness: &Harness<'_, S>) -> Vec<String> {
    words_within(harness, harness.ctx.content_rect())
}

/// Those whose middle lies in a part of it.
pub fn words_within<S>(harness: &Harness<'_, S>, part: Rect) -> Vec<String> {
    let mut painted = Painted::default();
    for ClippedShape { clip_rect, shape, .. } in &harness.output().shapes {
        painted.add(shape, *clip_rect);
    }
    let in_sight = |text: &Text| text.ink.intersects(text.clip) && part.contains(text.ink.center());
    painted.texts.into_iter().filter(in_sight).map(|text| text.words).collect()
}

/// Does a line end within a word?
fn is_broken(galley: &egui::Galley) -> bool {
    galley.rows.windows(2).any(|rows| {
        let [end, start] = [rows[0].text(), rows[1].text()];
        let within = end.chars().last().zip(start.chars().next());
        !rows[0].ends_with_newline && within.is_some_and(|(a, b)| a.is_alphanumeric() && b.is_alphanumeric())
    })
}

fn beyond(inner: Rect, outer: Rect) -> bool {
    !outer.expand(TOLERANCE).contains_rect(inner)
}

/// What cannot be read, or stands in the way of something, in the frame that was drawn last. One line each:
/// what is wrong, with the words.
pub fn problems(harness: &Harness<'_, App>) -> Vec<String> {
    let screen = harness.ctx.content_rect();
    let mut painted = Painted::default();
    for ClippedShape { clip_rect, shape, .. } in &harness.output().shapes {
        painted.add(shape, *clip_rect);
    }
    let tiles = tiles(harness, &painted);
    let scrolled = |clip: Rect| !tiles.iter().any(|tile| tile.expand(TOLERANCE).contains_rect(clip));
    let may_be_cut = cut_with_a_tip(harness);
    let mut list = Vec::new();
    let in_sight: Vec<&Text> = painted
        .texts
        .iter()
        .filter(|text| text.ink.intersects(text.clip) && text.clip.is_positive())
        .filter(|text| !painted.hidden(text.ink.intersect(text.clip), text.order, usize::MAX))
        .collect();
    for text in &in_sight {
        // The catalogue's rows have their full names in a tip.
        let row = text.ink.right() < catalogue_edge(harness, &tiles);
        if text.elided && !row && !may_be_cut.iter().any(|start| text.words.starts_with(start)) {
            list.push(format!("cut with …: {:?}", text.words));
        }
        if text.broken {
            list.push(format!("broken within a word: {:?}", text.words));
        }
        // The bare numbers of small swatches may be a little smaller.
        let number = text.words.parse::<f64>().is_ok();
        if text.size < if number { LEAST_NUMBER } else { LEAST_SIZE } {
            list.push(format!("smaller than {LEAST_SIZE} points: {:?}", text.words));
        }
        // A row of a list may stand half out of sight: it is scrolled to.
        let across = text.ink.x_range();
        let sideways = across.min < text.clip.left() - TOLERANCE || across.max > text.clip.right() + TOLERANCE;
        if beyond(text.ink, text.clip) && (sideways || !scrolled(text.clip)) {
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

/// Where tiles stand: the grounds that begin where their heads do. Everything else is scrolled, or a bar.
fn tiles(harness: &Harness<'_, App>, painted: &Painted) -> Vec<Rect> {
    let root = harness.root();
    let heads = root.children_recursive().filter(|node| {
        node.accesskit_node().label().is_some_and(|label| label.starts_with("Tile ") && !label.contains(','))
    });
    let ground = |head: Rect| {
        let from_there = |ground: &&Rect| ground.min.distance(head.min) < 2.0 && ground.contains_rect(head.shrink(2.0));
        let grounds: Vec<Rect> = painted.grounds.iter().map(|(_, ground)| *ground).collect();
        grounds.iter().filter(from_there).copied().max_by(|a, b| a.area().total_cmp(&b.area()))
    };
    heads.filter_map(|head| ground(head.rect())).collect()
}

/// Where the bench begins, thus the catalogue ends.
fn catalogue_edge(harness: &Harness<'_, App>, tiles: &[Rect]) -> f32 {
    let open = harness.state().shell.state.settings.catalogue_open;
    if open { tiles.iter().map(|tile| tile.left()).fold(f32::INFINITY, f32::min) } else { 0.0 }
}

/// Beginnings of texts that may be cut, since all of them is in a tip: the second titles of tiles, the selection in the
/// menu bar, and in the narrowest tile the words for a sun behind the façade.
fn cut_with_a_tip(harness: &Harness<'_, App>) -> Vec<String> {
    let state = &harness.state().shell.state;
    let sun_behind = "the sun is not in front of the façade".to_owned();
    let selection = title::title(state).replace("cfs – ", "");
    // Names in the rows of a ranking, with their marks, and why others are left out.
    let ranked = harness.state().shell.results.rank.value.as_ref();
    let reasons = ranked.into_iter().flat_map(|figures| figures.known.values());
    let reasons = reasons.filter_map(|known| known.outcome.as_ref().err().cloned());
    let ranked = ranked.into_iter().flat_map(|figures| figures.products.iter());
    let ranked =
        ranked.flat_map(|product| ["", "◆ ", "≈ ", "⌂ ", "◆ ≈ ", "◆ ⌂ "].map(|mark| format!("{mark}{}", product.name)));
    [title::selection(state), title::sky(&state.document.scene), selection, sun_behind]
        .into_iter()
        .chain(ranked)
        .chain(reasons)
        .filter(|start| !start.is_empty())
        .collect()
}

/// A widget by its name.
struct Widget {
    name: String,
    rect: Rect,
    /// The part that can be clicked.
    seen: Rect,
    layer: egui::LayerId,
}

/// Buttons, fields and the like that overlap, are cut or lie outside the window.
fn widget_problems(harness: &Harness<'_, App>, screen: Rect, scrolled: &dyn Fn(Rect) -> bool) -> Vec<String> {
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
            widgets.push(Widget { name, rect: rect.rect, seen: rect.interact_rect, layer: rect.layer_id });
        }
    }
    let mut list = Vec::new();
    for (k, a) in widgets.iter().enumerate() {
        let sideways = a.seen.left() > a.rect.left() + TOLERANCE || a.seen.right() < a.rect.right() - TOLERANCE;
        if beyond(a.rect, a.seen) && (sideways || !scrolled(a.seen)) {
            list.push(format!("a widget is cut: {:?} {:?} {:?}", a.name, a.rect, a.seen));
        } else if beyond(a.seen, screen) {
            list.push(format!("a widget is out of the window: {:?}", a.name));
        }
        for b in &widgets[k + 1..] {
            let both = a.seen.intersect(b.seen).shrink(TOLERANCE);
            // A list that is open lies over what is under it.
            if both.is_positive() && a.layer == b.layer {
                list.push(format!("widgets over each other: {:?} and {:?}", a.name, b.name));
            }
        }
    }
    list
}
