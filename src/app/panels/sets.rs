//! Side panels about sets of products: collections made by the user, and subscribed folders of packages.

use crate::app::catalogue::command::CatalogueCommand;
use crate::app::catalogue::shelf::Query;
use crate::app::command::Command;
use crate::app::state::State;
use crate::app::title;
use crate::texts::{Text, catalogue as text};
use egui::accesskit::Role;
use egui::{Key, Label, TextEdit, Ui, WidgetInfo};

/// Draws a button for something with a name, which completes the button's label for screen readers. Returns whether it
/// was clicked.
fn button(ui: &mut Ui, what: Text, tip: Text, name: &str) -> bool {
    let button = ui.button(what).on_hover_text(tip);
    let label = text::about(what, name);
    button.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
    button.clicked()
}

/// Draws the side panel of collections. `typed`: name of a new one, as typed.
pub(super) fn collections(ui: &mut Ui, state: &State, typed: &str, commands: &mut Vec<Command>) {
    let all = &state.sets.collections;
    let product = &state.document.selection.product;
    if product.is_empty() {
        ui.label(text::NONE_SELECTED);
    } else {
        ui.add(Label::new(egui::RichText::new(title::product(state)).strong()).wrap());
        ui.horizontal(|ui| {
            let mut name = typed.to_owned();
            let label = ui.label(text::NEW_COLLECTION);
            let field = ui.add(TextEdit::singleline(&mut name).desired_width(140.0)).labelled_by(label.id);
            let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            let named = !name.trim().is_empty();
            let add = ui.add_enabled(named, egui::Button::new(text::ADD)).on_hover_text(text::ADD_TIP).clicked();
            if (add || entered) && named {
                commands.push(Command::Catalogue(CatalogueCommand::Collect { name, product: None, put: true }));
            } else if name != typed {
                commands.push(Command::Catalogue(CatalogueCommand::EditName(name)));
            }
        });
    }
    ui.add_space(6.0);
    let help = if all.is_empty() { text::NO_COLLECTION } else { text::COLLECTIONS_HELP };
    ui.add(Label::new(egui::RichText::new(help).weak()).wrap());
    for one in all {
        ui.add_space(4.0);
        let mut inside = one.products.contains(product);
        let words = text::members(&one.name, one.products.len());
        if ui.add_enabled(!product.is_empty(), egui::Checkbox::new(&mut inside, words)).clicked() {
            let name = one.name.clone();
            commands.push(Command::Catalogue(CatalogueCommand::Collect { name, product: None, put: inside }));
        }
        ui.horizontal(|ui| {
            if button(ui, text::SHOW, text::SHOW_TIP, &one.name) {
                let query = Query { collections: vec![one.name.clone()], ..Query::default() };
                commands.push(Command::Find(query));
            }
            if button(ui, text::DISBAND, text::DISBAND_TIP, &one.name) {
                commands.push(Command::Catalogue(CatalogueCommand::Disband(one.name.clone())));
            }
        });
    }
}

/// Draws the side panel of subscribed folders.
pub(super) fn subscriptions(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    ui.add(Label::new(egui::RichText::new(text::SUBSCRIBE_TIP).weak()).wrap());
    if ui.button(text::SUBSCRIBE_MENU).on_hover_text(text::SUBSCRIBE_HINT).clicked() {
        commands.push(Command::Catalogue(CatalogueCommand::Subscribe));
    }
    if state.sets.subscriptions.is_empty() {
        ui.add_space(6.0);
        ui.label(text::NO_SUBSCRIPTION);
    }
    for one in &state.sets.subscriptions {
        ui.add_space(6.0);
        ui.add(Label::new(&one.folder).wrap());
        ui.horizontal(|ui| {
            ui.weak(text::products_from(one.products));
            if button(ui, text::UNSUBSCRIBE, text::UNSUBSCRIBE_TIP, &one.folder) {
                commands.push(Command::Catalogue(CatalogueCommand::Unsubscribe(one.folder.clone())));
            }
        });
    }
}
