//! Menu that a right click on a product of the catalogue opens.

use crate::app::catalogue::command::CatalogueCommand;
use crate::app::catalogue::shelf::Entry;
use crate::app::command::Command;
use crate::app::compare::view::Act;
use crate::app::state::Sheet;
use crate::catalogue::Collection;
use crate::texts::catalogue as text;

/// Draws the menu of a product's entry: compare, find similar products, collections, rename, delete.
pub(super) fn show(row: &egui::Response, entry: &Entry, collections: &[Collection], commands: &mut Vec<Command>) {
    row.context_menu(|ui| {
        let key = || Some(entry.key.clone());
        if ui.button(text::COMPARE).on_hover_text(text::COMPARE_TIP).clicked() {
            commands.push(Command::Compare(Act::AddProduct(entry.key.clone())));
            ui.close();
        }
        if ui.button(text::LIKE_THIS).on_hover_text(text::LIKE_THIS_TIP).clicked() {
            commands.push(Command::Like(key()));
            ui.close();
        }
        ui.menu_button(text::COLLECTIONS, |ui| {
            for one in collections {
                let mut inside = one.products.contains(&entry.key);
                if ui.checkbox(&mut inside, &one.name).clicked() {
                    let name = one.name.clone();
                    commands.push(Command::Catalogue(CatalogueCommand::Collect { name, product: key(), put: inside }));
                    ui.close();
                }
            }
            if ui.button(text::COLLECTIONS_MENU).on_hover_text(text::COLLECTIONS_TIP).clicked() {
                commands.push(Command::Select(entry.key.clone()));
                commands.push(Command::Sheet(Some(Sheet::Collections)));
                ui.close();
            }
        });
        if ui.button(text::RENAME).on_hover_text(text::RENAME_TIP).clicked() {
            commands.push(Command::EditProduct(key()));
            ui.close();
        }
        if ui.button(text::DELETE).on_hover_text(text::DELETE_TIP).clicked() {
            commands.push(Command::DeleteProduct(key()));
            ui.close();
        }
    });
}
