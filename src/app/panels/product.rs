//! Sheets about products that are stored: their words, and those out of sight.

use crate::app::clock;
use crate::app::command::Command;
use crate::app::import::ImportFields;
use crate::app::state::State;
use crate::app::theme;
use egui::{TextEdit, Ui};

/// Fields for the words about a product; the new ones when something was typed.
pub(super) fn words(ui: &mut Ui, fields: &ImportFields) -> Option<ImportFields> {
    let mut typed = fields.clone();
    egui::Grid::new("about").num_columns(2).show(ui, |ui| {
        for (label, text) in [
            ("Name", &mut typed.name),
            ("Manufacturer", &mut typed.manufacturer),
            ("Kind", &mut typed.kind),
            ("Tags", &mut typed.tags),
        ] {
            let name = ui.label(label);
            ui.add(TextEdit::singleline(text).desired_width(200.0)).labelled_by(name.id);
            ui.end_row();
        }
    });
    (typed != *fields).then_some(typed)
}

/// Draws the sheet for the words about a product.
pub(super) fn edit(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(editing) = &state.editing else {
        ui.label("No product is selected.");
        return;
    };
    ui.weak(format!("Key in scenes: {}", editing.key));
    if editing.builtin {
        ui.label(
            "It comes with the program and keeps its name, kind and tags. It can be deleted, which takes it out of sight.",
        );
    } else {
        if let Some(typed) = words(ui, &editing.fields) {
            commands.push(Command::EditWords(Box::new(typed)));
        }
        let named = !editing.fields.name.trim().is_empty();
        if !named {
            ui.weak("It needs a name.");
        }
        if ui.add_enabled(named, egui::Button::new("Save")).clicked() {
            commands.push(Command::SaveWords);
        }
    }
    ui.add_space(8.0);
    if ui.button("Delete product").on_hover_text("Out of sight; it can be brought back").clicked() {
        commands.push(Command::Sheet(None));
        commands.push(Command::DeleteProduct(Some(editing.key.clone())));
    }
}

/// Draws the list of products out of sight.
pub(super) fn deleted(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    ui.add(egui::Label::new("Out of sight, and kept. Scenes that name them still work.").wrap());
    if state.deleted.is_empty() {
        ui.label("No product is deleted.");
    }
    let palette = theme::palette(ui);
    for one in &state.deleted {
        ui.add_space(6.0);
        ui.label(&one.name);
        ui.horizontal(|ui| {
            let origin = if one.builtin { ", built in" } else { "" };
            ui.colored_label(palette.weak, format!("{}{origin}", clock::words(&one.at)));
            let button = ui.button("Restore");
            let label = format!("Restore {}", one.name);
            button.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, &label));
            if button.clicked() {
                commands.push(Command::RestoreProduct(one.key.clone()));
            }
        });
    }
}
