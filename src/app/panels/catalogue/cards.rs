//! The products of the catalogue as a gallery: cards, each with a picture of the product's transmittance.

use super::{entry, names};
use crate::app::catalogue::gallery::Gallery;
use crate::app::catalogue::shelf::Found;
use crate::app::command::Command;
use crate::app::display::theme;
use crate::app::state::State;
use crate::texts::{catalogue as text, fixed};
use egui::{Color32, FontId, Rect, ScrollArea, Sense, Ui, Vec2, pos2, vec2};

/// Minimum width of a product's card. \[points\]
const LEAST: f32 = 106.0;
/// Gap between two neighbouring cards. \[points\]
const GAP: f32 = 4.0;
/// Width and height of the picture on a card. \[points\]
const PICTURE: f32 = 76.0;
/// Height of a card \[points\]: the picture, two lines for the name, one line for the figures.
const HEIGHT: f32 = PICTURE + 70.0;

/// Draws the gallery, with a height of `below` \[points\] left free under it. Only visible cards are drawn.
pub(super) fn show(ui: &mut Ui, state: &mut State, gallery: &mut Gallery, below: f32, commands: &mut Vec<Command>) {
    let found = state.found.clone();
    let entries = &found.entries;
    let height = (ui.available_height() - below).max(80.0);
    let bar = ui.spacing().scroll.allocated_width();
    let width = ui.available_width() - bar;
    let columns = (((width + GAP) / (LEAST + GAP)).floor() as usize).max(1);
    let card = (width + GAP) / columns as f32 - GAP;
    gallery.columns = columns;
    let mut area = ScrollArea::vertical().id_salt("cards").max_height(height).auto_shrink([false, false]);
    let key = ui.scope_id().with("cards-offset");
    let product = &state.document.selection.product;
    if state.scrolled_to != *product
        && let Some(place) = entries.iter().position(|entry| entry.key == *product)
    {
        state.scrolled_to.clone_from(product);
        let top = (place / columns) as f32 * (HEIGHT + GAP);
        let offset = ui.data(|data| data.get_temp::<f32>(key)).unwrap_or(0.0);
        if top < offset || top + HEIGHT > offset + height {
            area = area.vertical_scroll_offset((top - 0.5 * HEIGHT).max(0.0));
        }
    }
    ui.spacing_mut().item_spacing.y = GAP;
    let output = area.show_rows(ui, HEIGHT, entries.len().div_ceil(columns), |ui, rows| {
        for row in rows {
            let (line, _) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::hover());
            for place in row * columns..((row + 1) * columns).min(entries.len()) {
                let left = line.left() + (place % columns) as f32 * (card + GAP);
                let rect = Rect::from_min_size(pos2(left, line.top()), vec2(card, HEIGHT));
                one(ui, rect, (state, gallery), (&found, place), commands);
            }
        }
    });
    ui.data_mut(|data| data.insert_temp(key, output.state.clamped_offset().y));
}

/// Draws one card: picture, name, figures, star and comparison button of a product.
fn one(
    ui: &mut Ui,
    rect: Rect,
    (state, gallery): (&mut State, &mut Gallery),
    (found, place): (&Found, usize),
    commands: &mut Vec<Command>,
) {
    let entry = &*found.entries[place];
    let chosen = entry.key == state.document.selection.product;
    let palette = theme::palette(ui);
    let response = ui.interact(rect, ui.scope_id().with(("card", &entry.key)), Sense::click());
    let picture = gallery.of(entry).map(egui::TextureHandle::id);
    let response = entry::respond(response, (found, place), (chosen, picture.is_some()), state, commands);
    if chosen && std::mem::take(&mut state.focus_list) {
        response.request_focus();
    }
    state.focus_list |= entry::arrows(ui, &response, (found, place), gallery.columns, commands);
    let painter = ui.painter_at(rect);
    let fill = palette.behind(chosen, &response);
    painter.rect_filled(rect, 4, fill);
    let (left, width) = (rect.left() + 6.0, rect.width() - 12.0);
    let side = PICTURE.min(width - 20.0);
    let at = Rect::from_min_size(pos2(left, rect.top() + 5.0), Vec2::splat(side));
    match picture {
        Some(picture) => {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(picture, at, whole, Color32::WHITE);
        }
        // Until there is one: how much light comes through.
        None => entry::thumbnail(&painter, at, entry, palette),
    }
    let name = |place: usize| found.entries.get(place).map(|entry| entry.name.as_str());
    let beside = [place.checked_sub(1).and_then(name), name(place + 1)];
    let look = (FontId::proportional(13.0), palette.text);
    let name = names::layout(&painter, &entry.name, beside, look, width);
    painter.galley(pos2(left, rect.top() + PICTURE + 8.0), name, palette.text);
    let distance = found.like.as_ref().and_then(|like| like.distances.get(place));
    let words = distance.map_or_else(
        || {
            let tau = entry.tau_hemispherical.map_or_else(|| "–".to_owned(), |tau| fixed(tau, 2));
            let states =
                if entry.moves() { format!(" · {}", text::states(entry.states.len())) } else { String::new() };
            format!("τ {tau}{states}")
        },
        |distance| distance.words(),
    );
    let words = theme::one_line(&painter, &words, FontId::proportional(13.0), palette.weak, width);
    painter.galley(pos2(left, rect.bottom() - 4.0 - words.size().y), words, palette.weak);
    let signs = pos2(rect.right() - 13.0, rect.top() + 16.0);
    entry::star(ui, signs, entry, commands);
    entry::compare_sign(ui, signs + vec2(0.0, 24.0), entry, entry::place_in_comparison(state, &entry.key), commands);
}
