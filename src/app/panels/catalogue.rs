//! What is there: search field, chips, list.

mod menu;

use crate::app::command::Command;
use crate::app::shelf::{Entry, Query};
use crate::app::state::{CatalogueState, State};
use crate::app::theme;
use crate::study::control::year::CONTROLLED;
use egui::{Align2, FontId, Key, Pos2, Rect, RichText, ScrollArea, Sense, Shape, Stroke, Ui, Vec2, pos2, vec2};

/// Draws the panel.
pub fn show(ui: &mut Ui, state: &mut State, commands: &mut Vec<Command>) {
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
    chips(ui, state, &mut query);
    if query != state.query {
        commands.push(Command::Find(query));
    }
    if let Some(error) = &state.search_error {
        ui.colored_label(theme::palette(ui).error, error);
    }
    ui.weak(format!("{} of {} products", state.found.entries.len(), state.found.total));
    if state.found.entries.is_empty() {
        ui.add_space(20.0);
        ui.vertical_centered(|ui| {
            ui.label("Nothing has all these words.");
            if ui.button("Show all").clicked() {
                commands.push(Command::Find(Query::default()));
            }
        });
        return;
    }
    rows(ui, state, commands);
    states(ui, state, commands);
}

fn search_field(ui: &mut Ui, state: &mut State, query: &mut Query, commands: &mut Vec<Command>) {
    let field =
        ui.add(egui::TextEdit::singleline(&mut query.text).hint_text("Search (Ctrl+F)").desired_width(f32::INFINITY));
    field.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::TextInput, true, "Search"));
    if std::mem::take(&mut state.focus_search) {
        field.request_focus();
    }
    if field.has_focus() {
        let (up, down) = ui.input(|input| (input.key_pressed(Key::ArrowUp), input.key_pressed(Key::ArrowDown)));
        if up || down {
            commands.push(Command::Row(if down { 1 } else { -1 }));
        }
    }
}

fn chips(ui: &mut Ui, state: &State, query: &mut Query) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
        if ui.selectable_label(query.favourites, "★ starred").clicked() {
            query.favourites = !query.favourites;
        }
        for (kind, count) in &state.found.kinds {
            let chosen = query.kinds.contains(kind);
            let word = if kind.is_empty() { "other" } else { kind };
            if ui.selectable_label(chosen, format!("{word} {count}")).clicked() {
                if chosen {
                    query.kinds.retain(|other| other != kind);
                } else {
                    query.kinds.push(kind.clone());
                }
            }
        }
    });
}

fn rows(ui: &mut Ui, state: &mut State, commands: &mut Vec<Command>) {
    let found = state.found.clone();
    let entries = &found.entries;
    let height = (ui.available_height() - 54.0).max(80.0);
    let mut area = ScrollArea::vertical().id_salt("rows").max_height(height).auto_shrink([false, false]);
    let product = &state.document.selection.product;
    if state.scrolled_to != *product
        && let Some(row) = entries.iter().position(|entry| entry.key == *product)
    {
        // Bring a new selection into view, with a row above it for context.
        state.scrolled_to.clone_from(product);
        let step = theme::ROW_HEIGHT + ui.spacing().item_spacing.y;
        if area_hides(ui, row, height, step) {
            area = area.vertical_scroll_offset((row as f32 - 1.0).max(0.0) * step);
        }
    }
    let output = area.show_rows(ui, theme::ROW_HEIGHT, entries.len(), |ui, range| {
        for entry in &entries[range] {
            row(ui, entry, entry.key == state.document.selection.product, commands);
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

/// What a row says under the name, most important first: the end may be cut.
fn figures(entry: &Entry) -> String {
    let mut text = format!("τ {} · {}", figure(entry.tau_normal), figure(entry.tau_hemispherical));
    if entry.states.len() > 1 {
        text += &format!(" · {} states", entry.states.len());
    }
    let kind = if entry.kind.is_empty() { &entry.manufacturer } else { &entry.kind };
    if !kind.is_empty() {
        text += &format!(" · {}", kind.replace('-', " "));
    }
    text
}

fn row(ui: &mut Ui, entry: &Entry, chosen: bool, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    let size = vec2(ui.available_width(), theme::ROW_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let response = response.on_hover_text(format!(
        "{}\n{}\nτ at normal incidence · under uniform light",
        entry.name,
        figures(entry)
    ));
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
    let picture = Rect::from_min_size(rect.min + vec2(5.0, 7.0), Vec2::splat(theme::ROW_HEIGHT - 14.0));
    thumbnail(&painter, picture, entry, palette);
    let left = picture.right() + 8.0;
    let text = Rect::from_min_max(pos2(left, rect.top()), pos2(rect.right() - 26.0, rect.bottom()));
    let line = |y: f32, words: &str, size: f32, colour| {
        let galley = theme::one_line(&painter, words, FontId::proportional(size), colour, text.width());
        painter.galley(pos2(left, rect.top() + y - 0.5 * galley.size().y), galley, colour);
    };
    line(16.0, &entry.name, 13.5, palette.text);
    line(36.0, &figures(entry), 13.0, palette.weak);
    star(ui, rect, entry, commands);
}

fn star(ui: &mut Ui, row: Rect, entry: &Entry, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    let rect = Rect::from_center_size(pos2(row.right() - 14.0, row.center().y), Vec2::splat(24.0));
    let response = ui.interact(rect, ui.scope_id().with(("star", &entry.key)), Sense::click());
    let label = format!("{} {}", if entry.favourite { "Take the star of" } else { "Star" }, entry.name);
    response.widget_info(|| egui::WidgetInfo::selected(egui::accesskit::Role::Button, true, entry.favourite, &label));
    let (glyph, colour) = if entry.favourite { ("★", palette.sun) } else { ("☆", palette.weak) };
    ui.painter().text(rect.center(), Align2::CENTER_CENTER, glyph, FontId::proportional(15.0), colour);
    if response.clicked() {
        commands.push(Command::Favourite(entry.key.clone(), !entry.favourite));
    }
}

/// τ in the vertical plane, sun from below on the left to above on the right.
fn thumbnail(painter: &egui::Painter, rect: Rect, entry: &Entry, palette: &theme::Palette) {
    painter.rect_filled(rect, 3, palette.raised);
    let last = entry.profile.len().saturating_sub(1);
    if last == 0 {
        return;
    }
    let point = |(i, tau): (usize, &f32)| -> Pos2 {
        let x = rect.left() + 2.0 + (rect.width() - 4.0) * i as f32 / last as f32;
        pos2(x, rect.bottom() - 2.0 - (rect.height() - 4.0) * tau.clamp(0.0, 1.0))
    };
    let line: Vec<Pos2> = entry.profile.iter().enumerate().map(point).collect();
    painter.add(Shape::line(line, Stroke::new(1.5, palette.accent)));
}

/// Under the list: the states of the selected product.
fn states(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let selection = &state.document.selection;
    let Some(entry) = state.found.entries.iter().find(|entry| entry.key == selection.product) else { return };
    if entry.states.len() < 2 {
        ui.weak("One state");
        return;
    }
    ui.horizontal(|ui| {
        ui.label("State");
        ScrollArea::horizontal().id_salt("states").show(ui, |ui| {
            ui.horizontal(|ui| {
                for (i, key) in entry.states.iter().enumerate() {
                    let chosen = match selection.state.as_str() {
                        "" => i == 0,
                        CONTROLLED => *key == state.shown_state,
                        fixed => *key == fixed,
                    };
                    if ui.selectable_label(chosen, RichText::new(key)).clicked() {
                        commands.push(Command::SelectState(key.clone()));
                    }
                }
            });
        });
    });
}
