//! Side panels, of which at most one is open: imports, findings, shortcuts, paths. None of them blocks the rest of the
//! window.

use super::fields::take_keyboard;
use super::{about, import, messages, product, sets};
use crate::app::command::Command;
use crate::app::display::theme;
use crate::app::offer::{key_words, listed};
use crate::app::shell::jobs::Lane;
use crate::app::shell::typed_path::typed_path;
use crate::app::state::{CatalogueState, PathUse, Results, Sheet, State};
use crate::app::views::accuracy;
use crate::app::window::App;
use crate::texts::{catalogue as texts, shell};
use egui::{Id, Key, RichText, ScrollArea, TextEdit, Ui};

/// Draws the open side panel.
pub fn show(ui: &mut Ui, app: &mut App, sheet: Sheet, commands: &mut Vec<Command>) {
    let title = match sheet {
        Sheet::Import => shell::IMPORT,
        Sheet::Findings => shell::FINDINGS,
        Sheet::Keys => shell::KEYS,
        Sheet::About => shell::ABOUT,
        Sheet::Accuracy => shell::ACCURACY,
        Sheet::Goniophotometer => shell::GONIOPHOTOMETER,
        Sheet::Product => shell::PRODUCT,
        Sheet::Deleted => shell::DELETED,
        Sheet::Collections => texts::COLLECTIONS,
        Sheet::Subscriptions => texts::SUBSCRIPTIONS,
        Sheet::Messages => shell::MESSAGES,
        Sheet::Export => shell::EXPORT_SHEET,
        Sheet::Path(what) => what.title(),
    };
    ui.horizontal(|ui| {
        ui.heading(title);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let before = app.opened.sheet_before(ui.ctx().cumulative_frame_nr());
            let escaped =
                before && app.shell.state.palette.is_none() && ui.input(|input| input.key_pressed(Key::Escape));
            if ui.button(shell::CLOSE).on_hover_text(shell::CLOSE_TIP).clicked() || escaped {
                commands.push(Command::Sheet(None));
            }
        });
    });
    if sheet == Sheet::Import {
        // Its table scrolls by itself.
        return import::show(ui, &app.imports, commands);
    }
    ScrollArea::vertical().id_salt(title.english()).auto_shrink([false, false]).show(ui, |ui| match sheet {
        Sheet::Import => {}
        Sheet::Findings => match app.shell.state.dataset.value.as_ref() {
            Some(dataset) => {
                ui.strong(crate::app::title::selection(&app.shell.state));
                import::of_selection(ui, &app.shell.state, dataset);
            }
            None => {
                let words = match &app.shell.state.catalogue {
                    CatalogueState::Opening => shell::OPENING_THE_CATALOGUE.get(),
                    CatalogueState::Failed(error) => error.as_str(),
                    CatalogueState::Ready(_) => texts::NONE_SELECTED.get(),
                };
                ui.label(words);
            }
        },
        Sheet::Keys => keys(ui),
        Sheet::About => about::show(ui, app, commands),
        Sheet::Accuracy => {
            let running = app.shell.jobs.progress(Lane::Accuracy);
            ladder(ui, &app.shell.results, &mut app.accuracy_view, running, commands);
        }
        Sheet::Goniophotometer => {
            let running = app.shell.jobs.progress(Lane::Goniophotometer);
            super::goniophotometer::show(
                ui,
                &app.goniophotometer,
                &app.shell.state,
                &mut app.section_view,
                running,
                commands,
            );
        }
        Sheet::Product => product::edit(ui, app.products.editing(), commands),
        Sheet::Deleted => product::deleted(ui, app.products.deleted(), commands),
        Sheet::Collections => sets::collections(ui, &app.shell.state, app.products.collection(), commands),
        Sheet::Subscriptions => sets::subscriptions(ui, &app.shell.state, commands),
        Sheet::Messages => messages::list(ui, &app.shell.toasts, commands),
        Sheet::Export => super::export::show(ui, app, commands),
        Sheet::Path(what) => path(ui, &app.shell.state, what, commands),
    });
}

/// Draws the plot of error against computing time, and passes its commands on. `running`: finished
/// share of the current stage; `None` if nothing is running.
fn ladder(
    ui: &mut Ui,
    results: &Results,
    view: &mut accuracy::State,
    running: Option<f32>,
    commands: &mut Vec<Command>,
) {
    let shown = &results.accuracy;
    let input = accuracy::Input {
        accuracy: shown.value.as_deref(),
        revision: shown.revision,
        stale: shown.stale,
        error: shown.error.as_deref(),
        running,
        outside: results.room.value.as_ref().map_or(&[], |room| &room.outside),
    };
    for action in accuracy::show(ui, &input, view) {
        commands.push(match action {
            accuracy::Action::Run => Command::MeasureAccuracy,
            accuracy::Action::Cancel => Command::Cancel(Lane::Accuracy),
        });
    }
}

fn keys(ui: &mut Ui) {
    let wrap = 0.6 * ui.available_width();
    egui::Grid::new("keys").num_columns(2).striped(true).max_col_width(wrap).show(ui, |ui| {
        for (offer, keys) in listed().filter_map(|offer| Some((offer, offer.keys?))) {
            ui.label(RichText::new(key_words(&keys)).strong());
            ui.label(&offer.text);
            ui.end_row();
        }
    });
}

/// Draws the field for a path to open or write, and the question whether to replace an existing file.
fn path(ui: &mut Ui, state: &State, what: PathUse, commands: &mut Vec<Command>) {
    let (hint, action) = match what {
        PathUse::Open => (shell::OPEN_HINT, shell::OPEN),
        PathUse::ReplaceState => (shell::REPLACE_HINT, shell::REPLACE),
        PathUse::Subscribe => (texts::SUBSCRIBE_HINT, texts::SUBSCRIBE),
        PathUse::SaveScene => (shell::SAVE_HINT, shell::SAVE),
        PathUse::ExportLid => (shell::LID_HINT, shell::EXPORT),
        PathUse::ExportMeasured => (shell::MEASURED_HINT, shell::EXPORT),
        PathUse::ExportTile(_) => (shell::TILE_HINT, shell::EXPORT),
        // It has a sheet of its own.
        PathUse::Export => (shell::EXPORT_HINT, shell::WRITE),
    };
    ui.add(egui::Label::new(hint.get()).wrap());
    let mut text = state.path.clone();
    let name = ui.label(shell::PATH);
    // A name of its own: it keeps the keyboard whatever comes and goes around it.
    let field = TextEdit::singleline(&mut text).id(Id::unique("path of a sheet")).desired_width(f32::INFINITY);
    let field = ui.add(field).labelled_by(name.id);
    take_keyboard(&field, state, commands);
    if text != state.path {
        commands.push(Command::EditPath(text.clone()));
    }
    let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    let ready = !text.trim().is_empty();
    let path = typed_path(&text);
    if state.replace.as_ref() == Some(&path) {
        ui.colored_label(theme::palette(ui).warning, shell::EXISTS);
        ui.horizontal(|ui| {
            if ui.button(shell::REPLACE).on_hover_text(shell::WRITE_OVER).clicked() {
                commands.push(Command::Write(what, path.clone()));
            }
            if ui.button(shell::CHANGE_NAME).on_hover_text(shell::CHANGE_NAME_TIP).clicked() {
                commands.push(Command::KeepFile);
                field.request_focus();
            }
        });
    } else if (ui.add_enabled(ready, egui::Button::new(action)).clicked() || entered) && ready {
        commands.push(Command::WriteNew(what, path));
    }
}
