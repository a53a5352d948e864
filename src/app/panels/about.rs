//! Version of the program, and memory of its stored results.

use crate::app::command::Command;
use crate::app::shell::settings::MEGABYTE;
use crate::app::window::App;
use crate::texts::{commands as words, shell};
use egui::{DragValue, Label, Ui};
use std::ops::RangeInclusive;

/// Limits of the memory of stored results. \[MB\]
const LIMITS: RangeInclusive<usize> = 16..=65_536;

/// Draws the sheet.
pub(super) fn show(ui: &mut Ui, app: &App, commands: &mut Vec<Command>) {
    ui.label(shell::version(env!("CARGO_PKG_VERSION")));
    let Some(store) = app.shell.services.engine.store() else { return };
    ui.add_space(8.0);
    ui.strong(shell::STORED_RESULTS);
    ui.add(Label::new(shell::STORED_RESULTS_HELP.get()).wrap());
    egui::Grid::new("stored results").num_columns(3).show(ui, |ui| {
        ui.label(shell::STORE_IN_USE);
        ui.label(format!("{} MB", store.bytes().div_ceil(MEGABYTE)));
        if ui.button(words::CLEAR_STORE).on_hover_text(words::CLEAR_STORE_TIP).clicked() {
            commands.push(Command::ClearStore);
        }
        ui.end_row();
        let name = ui.label(shell::STORE_LIMIT);
        let mut limit = app.shell.state.settings.store_limit;
        let field =
            ui.add(DragValue::new(&mut limit).range(LIMITS).update_while_editing(false).speed(4.0).suffix(" MB"));
        if field.labelled_by(name.id).on_hover_text(shell::STORE_LIMIT_TIP).changed() {
            commands.push(Command::StoreLimit(limit));
        }
        ui.end_row();
    });
}
