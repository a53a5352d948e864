//! The catalogue panel: search field, filters, list, and the states of the selected product.

mod cards;
mod entry;
mod filters;
mod list;
mod menu;
mod names;

use crate::app::catalogue::command::CatalogueCommand;
use crate::app::catalogue::gallery::Gallery;
use crate::app::catalogue::shelf::Query;
use crate::app::command::Command;
use crate::app::display::theme;
use crate::app::panels::fields::select_all;
use crate::app::scene::control;
use crate::app::state::{CatalogueState, State};
use crate::app::title;
use crate::app::views::states;
use crate::catalogue::moving_part;
use crate::study::control::year::CONTROLLED;
use crate::texts::catalogue as text;
use egui::{Align, Key, Layout, Ui};

/// Draws the catalogue panel.
pub fn show(
    ui: &mut Ui,
    state: &mut State,
    (strip, gallery): (&mut states::State, &mut Gallery),
    commands: &mut Vec<Command>,
) {
    ui.horizontal(|ui| {
        ui.heading(text::CATALOGUE.get());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let toggle = ui.selectable_label(state.settings.gallery, text::GALLERY);
            if toggle.on_hover_text(text::GALLERY_TIP).clicked() {
                commands.push(Command::Catalogue(CatalogueCommand::Gallery));
            }
        });
    });
    match &state.catalogue {
        CatalogueState::Opening => {
            ui.add_space(20.0);
            // Without anything that turns: to draw that takes the computer from the work that is waited for.
            ui.vertical_centered(|ui| ui.label(text::OPENING));
            return;
        }
        CatalogueState::Failed(error) => {
            ui.add_space(12.0);
            ui.colored_label(theme::palette(ui).error, error);
            if ui.button(text::TRY_AGAIN).clicked() {
                commands.push(Command::RetryCatalogue);
            }
            return;
        }
        CatalogueState::Ready(_) => {}
    }
    let mut query = state.query.clone();
    let entered = search_field(ui, state, &mut query, commands);
    filters::facets(ui, state, &mut query);
    filters::order(ui, state, &mut query);
    if query != state.query {
        commands.push(Command::Find(query));
    }
    if entered {
        commands.push(Command::Catalogue(CatalogueCommand::First));
    }
    if let Some(error) = &state.search_error {
        ui.colored_label(theme::palette(ui).error, error);
    }
    filters::notes(ui, &state.found);
    filters::like(ui, state, commands);
    let below = below(ui, state);
    if state.found.entries.is_empty() {
        filters::nothing(ui, state, commands);
    } else {
        let listed = |state: &State| state.found.entries.iter().any(|one| one.key == state.document.selection.product);
        if state.focus_list && !listed(state) {
            // Nothing in the list could have the keyboard.
            state.focus_list = false;
        }
        if state.settings.gallery {
            cards::show(ui, state, gallery, below, commands);
        } else {
            list::show(ui, state, below, commands);
        }
    }
    // The chosen product keeps its states at hand, whatever is searched.
    states_strip(ui, state, strip, commands);
}

/// Draws the search field. Returns whether its text was confirmed by Enter.
fn search_field(ui: &mut Ui, state: &mut State, query: &mut Query, commands: &mut Vec<Command>) -> bool {
    let field =
        ui.add(egui::TextEdit::singleline(&mut query.text).hint_text(text::SEARCH_HINT).desired_width(f32::INFINITY));
    field.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::TextInput, true, text::SEARCH.get()));
    if state.focus_search && state.palette.is_none() {
        state.focus_search = !field.has_focus();
        field.request_focus();
        // The next letters replace the words, unless some have arrived meanwhile.
        if !field.changed() {
            select_all(ui, field.id, &query.text);
        }
    }
    if field.has_focus() {
        let (up, down) = ui.input(|input| (input.key_pressed(Key::ArrowUp), input.key_pressed(Key::ArrowDown)));
        if up || down {
            commands.push(Command::Row(if down { 1 } else { -1 }));
        }
    }
    field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter))
}

/// Returns the height of the parts of the panel under the list of products. \[points\]
fn below(ui: &Ui, state: &State) -> f32 {
    let line = ui.spacing().interact_size.y + 2.0 * ui.spacing().item_spacing.y;
    match title::selected(state).map_or(0, |product| product.states.len()) {
        0 | 1 => line,
        states => line + states::height(ui.available_width(), states) + ui.spacing().item_spacing.y,
    }
}

/// Draws the states of the selected product under the list of products.
fn states_strip(ui: &mut Ui, state: &State, strip: &mut states::State, commands: &mut Vec<Command>) {
    let Some(product) = title::selected(state) else { return };
    if product.states.len() < 2 {
        ui.weak(text::ONE_STATE.get());
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
    let line = text::state_of(words, marks.len(), does);
    ui.add(egui::Label::new(&line).truncate()).on_hover_text(text::step_states(&line));
    let input = states::Input { product: [&product.key, &product.system], describe: moving_part, marks: &marks, shown };
    if let Some(place) = states::show(ui, &input, strip) {
        commands.push(Command::SelectState(marks[place].key.clone()));
    }
}
