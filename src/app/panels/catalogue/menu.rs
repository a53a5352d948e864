//! What a right click on a row offers.

use crate::app::command::Command;
use crate::app::compare::Act;
use crate::app::shelf::Entry;

/// The menu of a row.
pub(super) fn show(row: &egui::Response, entry: &Entry, commands: &mut Vec<Command>) {
    row.context_menu(|ui| {
        let key = || Some(entry.key.clone());
        if ui.button("Compare").on_hover_text("Add to the tray of what is compared").clicked() {
            commands.push(Command::Compare(Act::AddProduct(entry.key.clone())));
            ui.close();
        }
        if ui.button("Products like this").on_hover_text("By what they do to light, nearest first").clicked() {
            commands.push(Command::Like(key()));
            ui.close();
        }
        if ui.button("Rename…").on_hover_text("Name, maker, kind and tags").clicked() {
            commands.push(Command::EditProduct(key()));
            ui.close();
        }
        if ui.button("Delete").on_hover_text("Out of sight; undo or Recently deleted brings it back").clicked() {
            commands.push(Command::DeleteProduct(key()));
            ui.close();
        }
    });
}
