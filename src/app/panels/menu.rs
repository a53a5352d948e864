//! The menu bar.

use crate::app::command::Command;
use crate::app::state::{PathUse, Sheet, State, Tile};
use crate::app::theme::ThemeChoice;
use egui::{Button, MenuBar, Ui};

/// One entry with its keys and tip.
fn entry(ui: &mut Ui, command: Command, commands: &mut Vec<Command>) {
    let info = command.info();
    let mut button = Button::new(info.text);
    if let Some(keys) = info.shortcut {
        button = button.shortcut_text(ui.ctx().format_shortcut(&keys));
    }
    if ui.add(button).on_hover_text(info.tip).clicked() {
        commands.push(command);
        ui.close();
    }
}

/// Draws the bar.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    MenuBar::new().ui(ui, |ui| {
        ui.menu_button("File", |ui| {
            for command in [Command::Open, Command::Sheet(Some(Sheet::Path(PathUse::Open)))] {
                entry(ui, command, commands);
            }
            ui.separator();
            for command in [Command::SaveScene, Command::ExportLid] {
                entry(ui, command, commands);
            }
            ui.menu_button("Export tile", |ui| {
                for tile in Tile::ALL {
                    entry(ui, Command::ExportTile(tile), commands);
                }
            });
            ui.separator();
            entry(ui, Command::Quit, commands);
        });
        ui.menu_button("Edit", |ui| {
            for command in [Command::Undo, Command::Redo, Command::ResetScene] {
                entry(ui, command, commands);
            }
        });
        ui.menu_button("View", |ui| {
            for tile in Tile::ALL {
                entry(ui, Command::Maximise(Some(tile)), commands);
            }
            entry(ui, Command::Maximise(None), commands);
            ui.separator();
            entry(ui, Command::Sheet(Some(Sheet::Goniophotometer)), commands);
            entry(ui, Command::Sheet(Some(Sheet::Accuracy)), commands);
            ui.separator();
            entry(ui, Command::ToggleCatalogue, commands);
            entry(ui, Command::ToggleScene, commands);
            ui.separator();
            for choice in ThemeChoice::ALL {
                entry(ui, Command::Theme(choice), commands);
            }
        });
        ui.menu_button("Help", |ui| {
            for command in [Command::Palette, Command::Sheet(Some(Sheet::Keys)), Command::Sheet(Some(Sheet::Findings))]
            {
                entry(ui, command, commands);
            }
        });
        ui.separator();
        // The selection in words: also where the window has no title bar.
        let words = crate::app::title::title(state);
        ui.add(egui::Label::new(words.trim_start_matches("cfs – ")).truncate());
    });
}
