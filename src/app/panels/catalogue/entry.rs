//! Parts of a product's entry that list and gallery share: its figures as text, its tooltip, its star (favourite) and
//! its comparison button.

use super::menu;
use crate::app::catalogue::shelf::{Entry, Found};
use crate::app::command::Command;
use crate::app::compare::view::Act;
use crate::app::display::theme;
use crate::app::state::State;
use crate::catalogue::Sort;
use crate::study::scene_file::SystemKeys;
use crate::texts::{catalogue as text, fixed};
use egui::{Align2, EventFilter, FontId, Key, Pos2, Rect, Response, Sense, Shape, Stroke, Ui, Vec2, pos2};

pub(super) fn figure(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), |value| fixed(value, 2))
}

/// Returns the state of the product that the figures of its entry belong to, as text; empty for a product with one
/// state.
fn figures_of(entry: &Entry) -> String {
    match entry.state() {
        _ if !entry.moves() => String::new(),
        state if state.parse::<f64>().is_ok() => text::at_angle(state),
        state => text::in_state(state),
    }
}

/// Returns the line of figures under a product's name, the most important first, since the end may be cut: the figure
/// that the list is ordered by, the transmittances at normal incidence and under uniform light, the number of states,
/// source and kind.
pub(super) fn figures(entry: &Entry, sort: Sort) -> String {
    let mut words = String::new();
    // What the list is ordered by is seen.
    if let Sort::By(figure) = sort
        && !figure.words().starts_with('τ')
    {
        words = format!("{} {} · ", figure.words(), self::figure(entry.figure(figure)));
    }
    words += &format!("τ {} · {}{}", figure(entry.tau_normal), figure(entry.tau_hemispherical), figures_of(entry));
    if entry.moves() {
        words += &format!(" · {}", text::states(entry.states.len()));
    }
    if !entry.subscribed.is_empty() {
        let folder = entry.subscribed.rsplit(['/', '\\']).next().unwrap_or_default();
        words += &format!(" · {}", text::from_folder(folder));
    }
    let kind = if entry.kind.is_empty() || sort == Sort::Maker { &entry.manufacturer } else { &entry.kind };
    if !kind.is_empty() {
        words += &format!(" · {}", kind.replace('-', " "));
    }
    words
}

/// Returns the tooltip of a product: its whole name, and what its figures mean.
pub(super) fn tip(entry: &Entry) -> String {
    let mut words = entry.name.clone();
    if !entry.subscribed.is_empty() {
        words += &format!("\n{}", text::only_read(&entry.subscribed));
    }
    for line in [&entry.manufacturer, &entry.kind.replace('-', " ")] {
        if !line.is_empty() {
            words += &format!("\n{line}");
        }
    }
    let state = figures_of(entry);
    let taus = text::tau_tip(figure(entry.tau_normal), figure(entry.tau_hemispherical));
    words += &format!("\n{taus}{state}");
    if entry.moves() {
        words += &format!("\n{}", text::states_tip(entry.states.len(), state));
    }
    words
}

/// Adds tooltip, menu and accessible name to the entry of a product; a click selects the product. `place`: index of the
/// entry in the results; `chosen`: whether the product is selected; `picture`: whether the entry has a picture.
pub(super) fn respond(
    response: Response,
    (found, place): (&Found, usize),
    (chosen, picture): (bool, bool),
    state: &State,
    commands: &mut Vec<Command>,
) -> Response {
    let entry = &*found.entries[place];
    let response = response.on_hover_ui(|ui| {
        ui.label(tip(entry));
        if picture {
            ui.label(text::PICTURE_TIP);
        }
        if let Some(like) = &found.like
            && let Some(distance) = like.distances.get(place)
        {
            ui.label(text::from_like(&like.name, distance.words()));
        }
    });
    response
        .widget_info(|| egui::WidgetInfo::selected(egui::accesskit::Role::ListBoxOption, true, chosen, &entry.name));
    if response.clicked() {
        commands.push(Command::Select(entry.key.clone()));
    }
    menu::show(&response, entry, &state.sets.collections, commands);
    response
}

/// Selects another product by arrow keys while the entry of a product has the keyboard focus. `columns`: number of
/// entries side by side. Returns whether another product was selected, whose entry then takes the focus.
pub(super) fn arrows(
    ui: &Ui,
    response: &Response,
    (found, place): (&Found, usize),
    columns: usize,
    commands: &mut Vec<Command>,
) -> bool {
    if !response.has_focus() {
        return false;
    }
    let beside = columns > 1;
    let own = EventFilter { vertical_arrows: true, horizontal_arrows: beside, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, own));
    let steps = [
        (Key::ArrowUp, -(columns as isize)),
        (Key::ArrowDown, columns as isize),
        (Key::ArrowLeft, if beside { -1 } else { 0 }),
        (Key::ArrowRight, if beside { 1 } else { 0 }),
    ];
    let step = ui.input(|input| steps.into_iter().find(|(key, _)| input.key_pressed(*key)));
    let to = step.and_then(|(_, step)| place.checked_add_signed(step)).filter(|to| *to != place);
    let Some(to) = to.and_then(|to| found.entries.get(to)) else { return false };
    commands.push(Command::Select(to.key.clone()));
    true
}

/// Draws the star, a button that adds the product to the favourites or removes it, centred at a screen position.
pub(super) fn star(ui: &mut Ui, at: Pos2, entry: &Entry, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    let rect = Rect::from_center_size(at, Vec2::splat(23.0));
    let response = ui.interact(rect, ui.scope_id().with(("star", &entry.key)), Sense::click());
    let label = if entry.favourite { text::take_star(&entry.name) } else { text::set_star(&entry.name) };
    response.widget_info(|| egui::WidgetInfo::selected(egui::accesskit::Role::Button, true, entry.favourite, &label));
    let (glyph, colour) = if entry.favourite { ("★", palette.sun) } else { ("☆", palette.weak) };
    ui.painter().text(rect.center(), Align2::CENTER_CENTER, glyph, FontId::proportional(15.0), colour);
    if response.clicked() {
        commands.push(Command::Favourite(entry.key.clone(), !entry.favourite));
    }
}

/// Returns the index, in the comparison, of the first candidate with the product of a key; `None` if there is none.
pub(super) fn place_in_comparison(state: &State, key: &str) -> Option<usize> {
    let is = |system: &SystemKeys| matches!(system, SystemKeys::Catalogue { key: own, .. } if own == key);
    state.document.scene.compare.iter().position(|one| one.system.as_ref().is_some_and(is))
}

/// Draws the button that adds a product to the comparison, or removes it if it is there (`compared`: its index there),
/// centred at a screen position.
pub(super) fn compare_sign(ui: &mut Ui, at: Pos2, entry: &Entry, compared: Option<usize>, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    let rect = Rect::from_center_size(at, Vec2::splat(23.0));
    let response = ui.interact(rect, ui.scope_id().with(("compare", &entry.key)), Sense::click());
    let (what, tip, colour) = match compared {
        Some(_) => (text::REMOVE_FROM_COMPARISON, text::REMOVE_FROM_COMPARISON_TIP, palette.accent),
        None => (text::COMPARE, text::COMPARE_TIP, palette.weak),
    };
    let label = text::about(what, &entry.name);
    let chosen = compared.is_some();
    response.widget_info(|| egui::WidgetInfo::selected(egui::accesskit::Role::Button, true, chosen, &label));
    let glyph = if chosen { "⊖" } else { "⊕" };
    ui.painter().text(rect.center(), Align2::CENTER_CENTER, glyph, FontId::proportional(15.0), colour);
    if response.on_hover_text(tip).clicked() {
        commands.push(Command::Compare(match compared {
            Some(place) => Act::Remove(place),
            None => Act::AddProduct(entry.key.clone()),
        }));
    }
}

/// Draws a small curve of the directional-hemispherical transmittance τ for incident directions in the vertical plane
/// normal to the aperture, from light from below (left) to light from above (right).
pub(super) fn thumbnail(painter: &egui::Painter, rect: Rect, entry: &Entry, palette: &theme::Palette) {
    painter.rect_filled(rect, 3, palette.raised);
    let last = entry.tau_profile.len().saturating_sub(1);
    if last == 0 {
        return;
    }
    let point = |(i, tau): (usize, &f64)| -> Pos2 {
        let x = rect.left() + 2.0 + (rect.width() - 4.0) * i as f32 / last as f32;
        pos2(x, rect.bottom() - 2.0 - (rect.height() - 4.0) * tau.clamp(0.0, 1.0) as f32)
    };
    let line: Vec<Pos2> = entry.tau_profile.iter().enumerate().map(point).collect();
    painter.add(Shape::line(line, Stroke::new(1.5, palette.accent)));
}
