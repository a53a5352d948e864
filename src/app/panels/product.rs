//! Side panels about stored products: editing of their texts and states, and the list of deleted products.

use crate::app::catalogue::changes::Editing;
use crate::app::command::Command;
use crate::app::display::theme;
use crate::app::import::proposal::ImportFields;
use crate::app::shell::clock;
use crate::app::state::Sheet;
use crate::catalogue::Deleted;
use crate::texts::catalogue as text;
use egui::{TextEdit, Ui};

/// Draws the fields for the texts about a product, such as name and manufacturer. Returns the new texts in a frame in
/// which the user typed. `author`: whether to show also the field for the person or laboratory that measured or
/// computed the data, which is fixed once the product is stored.
pub(super) fn words(ui: &mut Ui, fields: &ImportFields, author: bool) -> Option<ImportFields> {
    let mut typed = fields.clone();
    egui::Grid::new("about").num_columns(2).show(ui, |ui| {
        let list = [
            (text::NAME, &mut typed.name),
            (text::MANUFACTURER, &mut typed.manufacturer),
            (text::KIND, &mut typed.kind),
            (text::TAGS, &mut typed.tags),
            (text::AUTHOR, &mut typed.author),
            (text::LICENSE, &mut typed.license),
        ];
        for (label, field) in list.into_iter().filter(|(label, _)| author || *label != text::AUTHOR) {
            let name = ui.label(label);
            let hint = if label == text::LICENSE { text::LICENSE_HINT.get() } else { "" };
            ui.add(TextEdit::singleline(field).hint_text(hint).desired_width(200.0)).labelled_by(name.id);
            ui.end_row();
        }
    });
    (typed != *fields).then_some(typed)
}

/// Draws the side panel in which a product is edited.
pub(super) fn edit(ui: &mut Ui, editing: Option<&Editing>, commands: &mut Vec<Command>) {
    let Some(editing) = editing else {
        ui.label(text::NONE_SELECTED);
        return;
    };
    ui.weak(text::key_in_scenes(&editing.key));
    if let Some(folder) = &editing.looked.subscribed {
        ui.add(egui::Label::new(text::of_subscription(folder)).wrap());
    } else if editing.fixed() {
        ui.label(text::OF_PROGRAM);
    } else {
        if let Some(typed) = words(ui, &editing.fields, false) {
            commands.push(Command::EditWords(Box::new(typed)));
        }
        states(ui, editing, commands);
        let problem = editing.problem();
        if let Some(problem) = &problem {
            ui.colored_label(theme::palette(ui).error, problem);
        }
        if ui.add_enabled(problem.is_none(), egui::Button::new(text::SAVE)).clicked() {
            commands.push(Command::SaveWords);
        }
        files(ui, editing, commands);
    }
    ui.add_space(8.0);
    if ui.button(text::COLLECTIONS_MENU).on_hover_text(text::COLLECTIONS_TIP).clicked() {
        commands.push(Command::Select(editing.key.clone()));
        commands.push(Command::Sheet(Some(Sheet::Collections)));
    }
    if ui.button(text::DELETE_PRODUCT).on_hover_text(text::DELETE_PRODUCT_TIP).clicked() {
        commands.push(Command::Sheet(None));
        commands.push(Command::DeleteProduct(Some(editing.key.clone())));
    }
    history(ui, editing);
}

/// Draws names and angles of a product's states, each with a button to replace its data by those of another file.
fn states(ui: &mut Ui, editing: &Editing, commands: &mut Vec<Command>) {
    ui.add_space(8.0);
    ui.strong(text::STATES.get());
    egui::Grid::new("states").num_columns(4).show(ui, |ui| {
        for word in [text::KEY, text::ANGLE_DEGREES, text::NAME] {
            ui.weak(word.get());
        }
        ui.weak("");
        ui.end_row();
        for (place, (state, words)) in editing.looked.product.states.iter().zip(&editing.states).enumerate() {
            let key = if state.key.is_empty() { text::SINGLE_STATE.get() } else { state.key.as_str() };
            ui.add(egui::Label::new(key).truncate());
            let mut typed = words.clone();
            for (field, what, width) in [(&mut typed.angle, text::ANGLE, 52.0), (&mut typed.name, text::NAME, 100.0)] {
                let edit = ui.add(TextEdit::singleline(field).id_salt((what, place)).desired_width(width));
                let (label, value) = (text::of_state(what, key), field.clone());
                edit.widget_info(|| {
                    let mut info = egui::WidgetInfo::text_edit(true, &value, &value, "");
                    info.label = Some(label.clone());
                    info
                });
            }
            if typed != *words {
                commands.push(Command::EditState(place, typed));
            }
            let button = ui.button(text::REPLACE).on_hover_text(text::REPLACE_TIP);
            let label = text::replace_state(key);
            button.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, &label));
            if button.clicked() {
                commands.push(Command::ReplaceState(state.key.clone()));
            }
            ui.end_row();
        }
    });
}

/// Draws the source files of a product, which can be read again.
fn files(ui: &mut Ui, editing: &Editing, commands: &mut Vec<Command>) {
    if editing.looked.paths.is_empty() {
        return;
    }
    ui.add_space(8.0);
    ui.strong(text::FILES.get());
    for path in &editing.looked.paths {
        ui.add(egui::Label::new(path).truncate()).on_hover_text(path);
    }
    match &editing.reread {
        None => {
            if ui.button(text::READ_AGAIN).on_hover_text(text::READ_AGAIN_TIP).clicked() {
                commands.push(Command::Reread);
            }
        }
        Some(reread) if reread.change.is_none() => {
            ui.label(text::NOTHING_CHANGED);
        }
        Some(reread) => {
            for line in &reread.differences {
                ui.add(egui::Label::new(line).wrap());
            }
            if ui.button(text::TAKE_CHANGES).on_hover_text(text::TAKE_CHANGES_TIP).clicked() {
                commands.push(Command::TakeChanges);
            }
        }
    }
}

/// Draws the history of the changes of a product.
fn history(ui: &mut Ui, editing: &Editing) {
    ui.add_space(8.0);
    ui.strong(text::HISTORY.get());
    if editing.looked.history.is_empty() {
        ui.weak(text::NO_HISTORY.get());
    }
    for event in &editing.looked.history {
        ui.weak(clock::words(&event.at));
        ui.add(egui::Label::new(&event.what).wrap());
    }
}

/// Draws the list of deleted products, which can be restored.
pub(super) fn deleted(ui: &mut Ui, list: &[Deleted], commands: &mut Vec<Command>) {
    ui.add(egui::Label::new(text::DELETED_HELP).wrap());
    if list.is_empty() {
        ui.label(text::NONE_DELETED);
    }
    let palette = theme::palette(ui);
    for one in list {
        ui.add_space(6.0);
        ui.label(&one.name);
        ui.horizontal(|ui| {
            let at = clock::words(&one.at);
            ui.colored_label(palette.weak, if one.builtin { text::at_built_in(at) } else { at });
            let button = ui.button(text::RESTORE);
            let label = text::restore(&one.name);
            button.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, &label));
            if button.clicked() {
                commands.push(Command::RestoreProduct(one.key.clone()));
            }
        });
    }
}
