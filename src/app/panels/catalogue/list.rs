//! The products of the catalogue as a list.

use super::{entry, names};
use crate::app::catalogue::shelf::Found;
use crate::app::command::Command;
use crate::app::display::theme;
use crate::app::state::State;
use egui::{FontId, Rect, ScrollArea, Sense, Ui, Vec2, pos2, vec2};

/// Height that a second line of the product's name adds to a row. \[points\]
const SECOND_LINE: f32 = 18.0;
/// Mean width of a letter of a product's name. \[points\]
const LETTER: f32 = 6.6;

/// Returns the common height of all rows of the list \[points\], larger if the longest name \[characters\] may need a
/// second line. Rows of equal height allow drawing visible rows only.
fn row_height(ui: &Ui, longest_name: usize) -> f32 {
    let room = ui.available_width() - theme::ROW_HEIGHT - 26.0;
    let second = if longest_name as f32 * LETTER > room { SECOND_LINE } else { 0.0 };
    theme::ROW_HEIGHT + second
}

/// Draws the list, with a height of `below` \[points\] left free under it.
pub(super) fn show(ui: &mut Ui, state: &mut State, below: f32, commands: &mut Vec<Command>) {
    let found = state.found.clone();
    let entries = &found.entries;
    let height = (ui.available_height() - below).max(80.0);
    let row_height = row_height(ui, found.longest_name);
    let mut area = ScrollArea::vertical().id_salt("rows").max_height(height).auto_shrink([false, false]);
    let product = &state.document.selection.product;
    if state.scrolled_to != *product
        && let Some(row) = entries.iter().position(|entry| entry.key == *product)
    {
        // Bring a new selection into view, with a row above it for context.
        state.scrolled_to.clone_from(product);
        let step = row_height + ui.spacing().item_spacing.y;
        if area_hides(ui, row, height, step) {
            area = area.vertical_scroll_offset((row as f32 - 1.0).max(0.0) * step);
        }
    }
    let output = area.show_rows(ui, row_height, entries.len(), |ui, range| {
        for place in range {
            row(ui, state, (&found, place), row_height, commands);
        }
    });
    let key = offset_key(ui);
    ui.data_mut(|data| data.insert_temp(key, output.state.clamped_offset().y));
}

fn offset_key(ui: &Ui) -> egui::Id {
    ui.scope_id().with("rows-offset")
}

/// Whether a row, given by its index, is outside the part of the list that was visible in the last frame. `height` of a
/// row and `step` from row to row \[points\].
fn area_hides(ui: &Ui, row: usize, height: f32, step: f32) -> bool {
    let key = offset_key(ui);
    let offset = ui.data(|data| data.get_temp::<f32>(key)).unwrap_or(0.0);
    let top = row as f32 * step;
    top < offset || top + step > offset + height
}

/// Draws a row of the list: picture, name, figures, star and comparison button of one product.
fn row(ui: &mut Ui, state: &mut State, (found, place): (&Found, usize), height: f32, commands: &mut Vec<Command>) {
    let entries = &found.entries;
    let entry = &*entries[place];
    let chosen = entry.key == state.document.selection.product;
    let palette = theme::palette(ui);
    let size = vec2(ui.available_width(), height);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let response = entry::respond(response, (found, place), (chosen, false), state, commands);
    if chosen && std::mem::take(&mut state.focus_list) {
        response.request_focus();
    }
    state.focus_list |= entry::arrows(ui, &response, (found, place), 1, commands);
    let distance = found.like.as_ref().and_then(|like| like.distances.get(place));
    let painter = ui.painter_at(rect);
    let fill = palette.behind(chosen, &response);
    painter.rect_filled(rect.shrink2(vec2(0.0, 1.0)), 4, fill);
    let side = theme::ROW_HEIGHT - 14.0;
    let picture = Rect::from_min_size(pos2(rect.left() + 5.0, rect.center().y - 0.5 * side), Vec2::splat(side));
    entry::thumbnail(&painter, picture, entry, palette);
    let left = picture.right() + 8.0;
    let width = rect.right() - 26.0 - left;
    let name = |place: usize| entries.get(place).map(|entry| entry.name.as_str());
    let beside = [place.checked_sub(1).and_then(name), name(place + 1)];
    let look = (FontId::proportional(13.5), palette.text);
    let name = names::layout(&painter, &entry.name, beside, look, width);
    // How far it is from what it should be like says more than its own figures.
    let words = distance.map_or_else(|| entry::figures(entry, state.query.sort), |distance| distance.words());
    let words = theme::one_line(&painter, &words, FontId::proportional(13.0), palette.weak, width);
    // Both in the middle of the row, however many lines the name has.
    let top = rect.center().y - 0.5 * (name.size().y + 2.0 + words.size().y);
    let under = top + name.size().y + 2.0;
    painter.galley(pos2(left, top), name, palette.text);
    painter.galley(pos2(left, under), words, palette.weak);
    let signs = pos2(rect.right() - 14.0, rect.center().y);
    entry::star(ui, signs - vec2(0.0, 12.0), entry, commands);
    entry::compare_sign(ui, signs + vec2(0.0, 12.0), entry, entry::place_in_comparison(state, &entry.key), commands);
}
