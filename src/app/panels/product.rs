//! Sheets about products that are stored: their words, and those out of sight.

use crate::app::changes::Editing;
use crate::app::clock;
use crate::app::command::Command;
use crate::app::import::ImportFields;
use crate::app::state::State;
use crate::app::theme;
use egui::{TextEdit, Ui};

/// Fields for the words about a product; the new ones when something was typed.
/// `author`: also who measured or computed, which is not changed afterwards.
pub(super) fn words(ui: &mut Ui, fields: &ImportFields, author: bool) -> Option<ImportFields> {
    let mut typed = fields.clone();
    egui::Grid::new("about").num_columns(2).show(ui, |ui| {
        let list = [
            ("Name", &mut typed.name),
            ("Manufacturer", &mut typed.manufacturer),
            ("Kind", &mut typed.kind),
            ("Tags", &mut typed.tags),
            ("Author", &mut typed.author),
        ];
        for (label, text) in list.into_iter().filter(|(label, _)| author || *label != "Author") {
            let name = ui.label(label);
            ui.add(TextEdit::singleline(text).desired_width(200.0)).labelled_by(name.id);
            ui.end_row();
        }
    });
    (typed != *fields).then_some(typed)
}

/// Draws the sheet of a product.
pub(super) fn edit(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(editing) = &state.editing else {
        ui.label("No product is selected.");
        return;
    };
    ui.weak(format!("Key in scenes: {}", editing.key));
    if let Some(folder) = &editing.looked.subscribed {
        ui.add(egui::Label::new(format!("It comes from {folder}, which is subscribed to, and is only read.")).wrap());
    } else if editing.fixed() {
        ui.label(
            "It comes with the program and keeps its name, kind and tags. It can be deleted, which takes it out of sight.",
        );
    } else {
        if let Some(typed) = words(ui, &editing.fields, false) {
            commands.push(Command::EditWords(Box::new(typed)));
        }
        states(ui, editing, commands);
        let problem = editing.problem();
        if let Some(problem) = &problem {
            ui.colored_label(theme::palette(ui).error, problem);
        }
        if ui.add_enabled(problem.is_none(), egui::Button::new("Save")).clicked() {
            commands.push(Command::SaveWords);
        }
        files(ui, editing, commands);
    }
    ui.add_space(8.0);
    if ui.button("Delete product").on_hover_text("Out of sight; it can be brought back").clicked() {
        commands.push(Command::Sheet(None));
        commands.push(Command::DeleteProduct(Some(editing.key.clone())));
    }
    history(ui, editing);
}

/// Names and angles of its states, each with a file to take its place.
fn states(ui: &mut Ui, editing: &Editing, commands: &mut Vec<Command>) {
    ui.add_space(8.0);
    ui.strong("States");
    egui::Grid::new("states").num_columns(4).show(ui, |ui| {
        for word in ["Key", "Angle [°]", "Name", ""] {
            ui.weak(word);
        }
        ui.end_row();
        for (place, (state, words)) in editing.looked.product.states.iter().zip(&editing.states).enumerate() {
            let key = if state.key.is_empty() { "the only one" } else { state.key.as_str() };
            ui.add(egui::Label::new(key).truncate());
            let mut typed = words.clone();
            for (text, what, width) in [(&mut typed.angle, "Angle", 52.0), (&mut typed.name, "Name", 100.0)] {
                let edit = ui.add(TextEdit::singleline(text).id_salt((what, place)).desired_width(width));
                let (label, value) = (format!("{what} of state {key}"), text.clone());
                edit.widget_info(|| {
                    let mut info = egui::WidgetInfo::text_edit(true, &value, &value, "");
                    info.label = Some(label.clone());
                    info
                });
            }
            if typed != *words {
                commands.push(Command::EditState(place, typed));
            }
            let button = ui.button("Replace…").on_hover_text("Other data for this state, from a file");
            let label = format!("Replace state {key}");
            button.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, &label));
            if button.clicked() {
                commands.push(Command::ReplaceState(state.key.clone()));
            }
            ui.end_row();
        }
    });
}

/// The files that it was read from, to be read again.
fn files(ui: &mut Ui, editing: &Editing, commands: &mut Vec<Command>) {
    if editing.looked.paths.is_empty() {
        return;
    }
    ui.add_space(8.0);
    ui.strong("Files");
    for path in &editing.looked.paths {
        ui.add(egui::Label::new(path).truncate()).on_hover_text(path);
    }
    match &editing.reread {
        None => {
            let tip = "What is not as it was is shown before it is taken";
            if ui.button("Read its files again").on_hover_text(tip).clicked() {
                commands.push(Command::Reread);
            }
        }
        Some(reread) if reread.change.is_none() => {
            ui.label("Nothing has changed since they were read.");
        }
        Some(reread) => {
            for line in &reread.told {
                ui.add(egui::Label::new(line).wrap());
            }
            if ui.button("Take the changes").on_hover_text("Ctrl+Z brings the data of before back").clicked() {
                commands.push(Command::TakeChanges);
            }
        }
    }
}

/// What happened to it.
fn history(ui: &mut Ui, editing: &Editing) {
    ui.add_space(8.0);
    ui.strong("History");
    if editing.looked.history.is_empty() {
        ui.weak("Nothing is written down.");
    }
    for event in &editing.looked.history {
        ui.weak(clock::words(&event.at));
        ui.add(egui::Label::new(&event.what).wrap());
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
