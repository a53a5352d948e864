//! What is there: search field, filters, list, and the states of what is chosen.

mod filters;
mod names;

mod menu;

use crate::app::command::Command;
use crate::app::compare::Act;
use crate::app::control;
use crate::app::shelf::{Entry, Found, Query};
use crate::app::state::{CatalogueState, State};
use crate::app::views::states;
use crate::app::{theme, title};
use crate::catalogue::{Sort, moving_part};
use crate::study::control::year::CONTROLLED;
use crate::study::scene_file::SystemKeys;
use egui::{Align2, FontId, Key, Pos2, Rect, ScrollArea, Sense, Shape, Stroke, Ui, Vec2, pos2, vec2};

/// What a second line of a name adds to a row. \[points\]
const SECOND_LINE: f32 = 18.0;
/// Mean width of a letter of a name. \[points\]
const LETTER: f32 = 6.6;

/// Draws the panel.
pub fn show(ui: &mut Ui, state: &mut State, strip: &mut states::State, commands: &mut Vec<Command>) {
    ui.heading("Catalogue");
    match &state.catalogue {
        CatalogueState::Opening => {
            ui.add_space(20.0);
            // Without anything that turns: to draw that takes the computer from the work that is waited for.
            ui.vertical_centered(|ui| ui.label("Opening the catalogue…"));
            return;
        }
        CatalogueState::Failed(error) => {
            ui.add_space(12.0);
            ui.colored_label(theme::palette(ui).error, error);
            if ui.button("Try again").clicked() {
                commands.push(Command::RetryCatalogue);
            }
            return;
        }
        CatalogueState::Ready(_) => {}
    }
    let mut query = state.query.clone();
    search_field(ui, state, &mut query, commands);
    filters::facets(ui, state, &mut query);
    filters::order(ui, state, &mut query);
    if query != state.query {
        commands.push(Command::Find(query));
    }
    if let Some(error) = &state.search_error {
        ui.colored_label(theme::palette(ui).error, error);
    }
    filters::read_as(ui, &state.found);
    filters::like(ui, state, commands);
    let below = below(ui, state);
    if state.found.entries.is_empty() {
        filters::nothing(ui, state, commands);
    } else {
        rows(ui, state, below, commands);
    }
    // The chosen product keeps its states at hand, whatever is searched.
    states_strip(ui, state, strip, commands);
}

fn search_field(ui: &mut Ui, state: &mut State, query: &mut Query, commands: &mut Vec<Command>) {
    let field =
        ui.add(egui::TextEdit::singleline(&mut query.text).hint_text("Search (Ctrl+F)").desired_width(f32::INFINITY));
    field.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::TextInput, true, "Search"));
    if state.focus_search && state.palette.is_none() {
        state.focus_search = !field.has_focus();
        field.request_focus();
    }
    if field.has_focus() {
        let (up, down) = ui.input(|input| (input.key_pressed(Key::ArrowUp), input.key_pressed(Key::ArrowDown)));
        if up || down {
            commands.push(Command::Row(if down { 1 } else { -1 }));
        }
    }
}

/// Height of the list's rows: all the same, so that only those in sight are drawn. Higher where a name of the list may
/// need a second line.
fn row_height(ui: &Ui, longest_name: usize) -> f32 {
    let room = ui.available_width() - theme::ROW_HEIGHT - 26.0;
    let second = if longest_name as f32 * LETTER > room { SECOND_LINE } else { 0.0 };
    theme::ROW_HEIGHT + second
}

fn rows(ui: &mut Ui, state: &mut State, below: f32, commands: &mut Vec<Command>) {
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
            let chosen = entries[place].key == state.document.selection.product;
            let compared = in_tray(state, &entries[place].key);
            row(ui, &found, place, row_height, (chosen, compared, state.query.sort), commands);
        }
    });
    let key = offset_key(ui);
    ui.data_mut(|data| data.insert_temp(key, output.state.clamped_offset().y));
}

fn offset_key(ui: &Ui) -> egui::Id {
    ui.scope_id().with("rows-offset")
}

/// Is a row out of sight, as the list stood in the last frame?
fn area_hides(ui: &Ui, row: usize, height: f32, step: f32) -> bool {
    let key = offset_key(ui);
    let offset = ui.data(|data| data.get_temp::<f32>(key)).unwrap_or(0.0);
    let top = row as f32 * step;
    top < offset || top + step > offset + height
}

fn figure(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format!("{value:.2}"))
}

/// The state that a row's figures are of, in words; empty for a product of one.
fn figures_of(entry: &Entry) -> String {
    match entry.state() {
        _ if !entry.moves() => String::new(),
        state if state.parse::<f64>().is_ok() => format!(" at {state}°"),
        state => format!(" ({state})"),
    }
}

/// What a row says under the name, most important first: the end may be cut.
fn figures(entry: &Entry, sort: Sort) -> String {
    let mut text = String::new();
    // What the list is ordered by is seen.
    if let Sort::By(figure) = sort
        && !figure.words().starts_with('τ')
    {
        text = format!("{} {} · ", figure.words(), self::figure(entry.figure(figure)));
    }
    text += &format!("τ {} · {}{}", figure(entry.tau_normal), figure(entry.tau_hemispherical), figures_of(entry));
    if entry.moves() {
        text += &format!(" · {} states", entry.states.len());
    }
    if !entry.subscribed.is_empty() {
        text += &format!(" · from {}", entry.subscribed.rsplit(['/', '\\']).next().unwrap_or_default());
    }
    let kind = if entry.kind.is_empty() || sort == Sort::Maker { &entry.manufacturer } else { &entry.kind };
    if !kind.is_empty() {
        text += &format!(" · {}", kind.replace('-', " "));
    }
    text
}

/// A row's tip: the whole name, and what its figures are.
fn tip(entry: &Entry) -> String {
    let mut text = entry.name.clone();
    if !entry.subscribed.is_empty() {
        text += &format!("\nfrom {}, only read", entry.subscribed);
    }
    for line in [&entry.manufacturer, &entry.kind.replace('-', " ")] {
        if !line.is_empty() {
            text += &format!("\n{line}");
        }
    }
    let state = figures_of(entry);
    text += &format!(
        "\nτ at normal incidence {}, under uniform light {}{state}",
        figure(entry.tau_normal),
        figure(entry.tau_hemispherical)
    );
    if entry.moves() {
        text += &format!("\n{} states; the picture is of the one{state}", entry.states.len());
    }
    text
}

fn row(
    ui: &mut Ui,
    found: &Found,
    place: usize,
    height: f32,
    (chosen, compared, sort): (bool, Option<usize>, Sort),
    commands: &mut Vec<Command>,
) {
    let entries = &found.entries;
    let entry = &*entries[place];
    let palette = theme::palette(ui);
    let size = vec2(ui.available_width(), height);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let like = found.like.as_ref().and_then(|like| Some((&like.name, like.apart.get(place)?)));
    let response = response.on_hover_ui(|ui| {
        ui.label(tip(entry));
        if let Some((name, apart)) = like {
            ui.label(format!("From {name}: {}", apart.words()));
        }
    });
    response
        .widget_info(|| egui::WidgetInfo::selected(egui::accesskit::Role::ListBoxOption, true, chosen, &entry.name));
    if response.clicked() {
        commands.push(Command::Select(entry.key.clone()));
    }
    menu::show(&response, entry, commands);
    let painter = ui.painter_at(rect);
    let fill = if chosen {
        palette.chosen
    } else if response.hovered() || response.has_focus() {
        palette.raised
    } else {
        palette.surface
    };
    painter.rect_filled(rect.shrink2(vec2(0.0, 1.0)), 4, fill);
    let side = theme::ROW_HEIGHT - 14.0;
    let picture = Rect::from_min_size(pos2(rect.left() + 5.0, rect.center().y - 0.5 * side), Vec2::splat(side));
    thumbnail(&painter, picture, entry, palette);
    let left = picture.right() + 8.0;
    let width = rect.right() - 26.0 - left;
    let name = |place: usize| entries.get(place).map(|entry| entry.name.as_str());
    let beside = [place.checked_sub(1).and_then(name), name(place + 1)];
    let look = (FontId::proportional(13.5), palette.text);
    let name = names::layout(&painter, &entry.name, beside, look, width);
    // How far it is from what it should be like says more than its own figures.
    let words = like.map_or_else(|| figures(entry, sort), |(_, apart)| apart.words());
    let words = theme::one_line(&painter, &words, FontId::proportional(13.0), palette.weak, width);
    // Both in the middle of the row, however many lines the name has.
    let top = rect.center().y - 0.5 * (name.size().y + 2.0 + words.size().y);
    let under = top + name.size().y + 2.0;
    painter.galley(pos2(left, top), name, palette.text);
    painter.galley(pos2(left, under), words, palette.weak);
    star(ui, rect, entry, commands);
    compare_sign(ui, rect, entry, compared, commands);
}

fn star(ui: &mut Ui, row: Rect, entry: &Entry, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    let rect = Rect::from_center_size(pos2(row.right() - 14.0, row.center().y - 12.0), Vec2::splat(23.0));
    let response = ui.interact(rect, ui.scope_id().with(("star", &entry.key)), Sense::click());
    let label = format!("{} {}", if entry.favourite { "Take the star of" } else { "Star" }, entry.name);
    response.widget_info(|| egui::WidgetInfo::selected(egui::accesskit::Role::Button, true, entry.favourite, &label));
    let (glyph, colour) = if entry.favourite { ("★", palette.sun) } else { ("☆", palette.weak) };
    ui.painter().text(rect.center(), Align2::CENTER_CENTER, glyph, FontId::proportional(15.0), colour);
    if response.clicked() {
        commands.push(Command::Favourite(entry.key.clone(), !entry.favourite));
    }
}

/// Place in the tray of the first candidate that is a product.
fn in_tray(state: &State, key: &str) -> Option<usize> {
    let is = |system: &SystemKeys| matches!(system, SystemKeys::Catalogue { key: own, .. } if own == key);
    state.document.scene.compare.iter().position(|one| one.system.as_ref().is_some_and(is))
}

/// Puts a product into the tray, or takes it out.
fn compare_sign(ui: &mut Ui, row: Rect, entry: &Entry, compared: Option<usize>, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    let rect = Rect::from_center_size(pos2(row.right() - 14.0, row.center().y + 12.0), Vec2::splat(23.0));
    let response = ui.interact(rect, ui.scope_id().with(("compare", &entry.key)), Sense::click());
    let (what, tip, colour) = match compared {
        Some(_) => ("Take out of the comparison", "In the tray; a click takes it out", palette.accent),
        None => ("Compare", "Add to the tray of what is compared", palette.weak),
    };
    let label = format!("{what}: {}", entry.name);
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

/// τ in the vertical plane, sun from below on the left to above on the right.
fn thumbnail(painter: &egui::Painter, rect: Rect, entry: &Entry, palette: &theme::Palette) {
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

/// Height of what stands under the list.
fn below(ui: &Ui, state: &State) -> f32 {
    let line = ui.spacing().interact_size.y + 2.0 * ui.spacing().item_spacing.y;
    match title::selected(state).map_or(0, |product| product.states.len()) {
        0 | 1 => line,
        states => line + states::height(ui.available_width(), states) + ui.spacing().item_spacing.y,
    }
}

/// Under the list: the states of the selected product.
fn states_strip(ui: &mut Ui, state: &State, strip: &mut states::State, commands: &mut Vec<Command>) {
    let Some(product) = title::selected(state) else { return };
    if product.states.len() < 2 {
        ui.weak("One state");
        return;
    }
    let selection = &state.document.selection;
    let key = match selection.state.as_str() {
        "" | CONTROLLED => &state.shown_state,
        fixed => fixed,
    };
    let shown = product.states.iter().position(|one| one.key == key);
    let mark = |one: &crate::catalogue::State| states::Mark {
        key: one.key.clone(),
        words: control::state_words(one),
        angle: one.value,
        tau: one.tau_hemispherical,
    };
    let marks: Vec<states::Mark> = product.states.iter().map(mark).collect();
    let words = shown.map_or("–", |place| marks[place].words.as_str());
    let does = control::words(state.control_mode()).does;
    let line = format!("State {words} of {}, {does}", marks.len());
    ui.add(egui::Label::new(&line).truncate()).on_hover_text(format!("{line}; [ and ] step through the states"));
    let input = states::Input { product: [&product.key, &product.system], describe: moving_part, marks: &marks, shown };
    if let Some(place) = states::show(ui, &input, strip) {
        commands.push(Command::SelectState(marks[place].key.clone()));
    }
}
