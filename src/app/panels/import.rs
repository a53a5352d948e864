//! The import sheet: what was read, what it makes, what is asked, and what will be stored; drafts of earlier imports.

mod detail;
mod findings;
mod table;

use crate::app::command::Command;
use crate::app::import::{Import, Proposed};
use crate::app::import_steps::Step;
use crate::app::state::State;
use crate::catalogue::Grouping;
use egui::{ScrollArea, Ui};
pub(super) use findings::of_selection;
use findings::plural;

/// Narrower sheets have the words about a product under the table. \[points\]
const NARROW: f32 = 620.0;

/// Draws the sheet.
pub(super) fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    actions(ui, state, commands);
    let Some(import) = &state.import else {
        ui.label("Drop dataset files, folders, zip archives or packages anywhere on the window, or press Ctrl+O.");
        return drafts(ui, state, commands);
    };
    if import.products.is_empty() {
        ui.add_space(6.0);
        ui.label("The catalogue is unchanged.");
    } else {
        grouping(ui, import, commands);
        by_hand(ui, import, commands);
    }
    ui.separator();
    let beside = ui.available_width() > NARROW && !import.products.is_empty();
    if beside {
        egui::Panel::right("import detail").default_size(300.0).size_range(260.0..=460.0).show(ui, |ui| {
            ScrollArea::vertical().id_salt("detail").auto_shrink([false, false]).show(ui, |ui| {
                detail::show(ui, import, commands);
            });
        });
    }
    ScrollArea::vertical().id_salt("found").auto_shrink([false, false]).show(ui, |ui| {
        table::show(ui, import, commands);
        if !beside && !import.products.is_empty() {
            ui.separator();
            detail::show(ui, import, commands);
        }
        drafts(ui, state, commands);
    });
}

/// What can be done with what was read.
fn actions(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(import) = &state.import else { return };
    let ready = import.products.iter().filter(|product| product.ready()).count();
    let wrong = import.wanted().any(|product| product.problem().is_some());
    let questions = import.questions();
    ui.horizontal_wrapped(|ui| {
        if !import.products.is_empty() {
            let text = match import.products.len() {
                1 => "Add to catalogue".to_owned(),
                _ => format!("Add {} to catalogue", plural(ready, "product")),
            };
            if ui.add_enabled(ready > 0, egui::Button::new(text)).clicked() {
                commands.push(Command::AddImport);
            }
            let tip = "Leave it for later: it is listed here, also after a restart";
            if ui.button("Keep as draft").on_hover_text(tip).clicked() {
                commands.push(Command::PutAside);
            }
        }
        if ui
            .button("Discard")
            .on_hover_text("Forget what was read; nothing was stored, and Ctrl+Z brings it back")
            .clicked()
        {
            commands.push(Command::DiscardImport);
        }
        if questions > 0 {
            let tip = "Every question is answered by what is proposed";
            if ui.button("All as proposed").on_hover_text(tip).clicked() {
                commands.push(Command::Import(Step::SettleAll));
            }
            ui.weak(format!("{} open: what they are about stays here.", plural(questions, "question")));
        }
        if wrong {
            ui.weak("What is in red below cannot be stored yet.");
        } else if import.wanted().next().is_none() && !import.products.is_empty() {
            ui.weak("All of it is in the catalogue already: below.");
        }
    });
}

/// How many there are, and how the files are taken as a whole.
fn grouping(ui: &mut Ui, import: &Import, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        ui.strong(format!("{} of {}", plural(import.products.len(), "product"), plural(import.states(), "state")));
        if import.sources.len() < 2 {
            return;
        }
        for (grouping, text, tip) in [
            (Grouping::Proposed, "By angle", "Files that differ by an angle alone are states of one product"),
            (Grouping::Each, "Every file apart", "Every file is a product"),
            (Grouping::One, "All one product", "Every file is a state of one product"),
        ] {
            let chosen = import.grouping == grouping && import.by_hand.is_none();
            if ui.selectable_label(chosen, text).on_hover_text(tip).clicked() {
                commands.push(Command::GroupImport(grouping));
            }
        }
        if import.by_hand.is_some() {
            ui.weak("changed by hand");
        }
    });
}

/// What can be done with the rows that are chosen.
fn by_hand(ui: &mut Ui, import: &Import, commands: &mut Vec<Command>) {
    if import.states() < 2 {
        return;
    }
    let files = import.files_of_selected().len();
    ui.horizontal_wrapped(|ui| {
        let all = import.selected.len() == import.states();
        if ui.button(if all { "Choose none" } else { "Choose all" }).clicked() {
            commands.push(Command::Import(Step::ChooseAll));
        }
        for (least, step, text, tip) in [
            (2, Step::Together, "One product of these", "The files that are chosen are the states of one product"),
            (1, Step::Apart, "Each its own", "Every file that is chosen is a product of its own"),
        ] {
            if ui.add_enabled(files >= least, egui::Button::new(text)).on_hover_text(tip).clicked() {
                commands.push(Command::Import(step));
            }
        }
        ui.add_enabled_ui(files > 0, |ui| {
            let menu = ui.menu_button("State of…", |ui| {
                ScrollArea::vertical().max_height(300.0).show(ui, |ui| {
                    let open = |(_, product): &(usize, &Proposed)| !product.packed;
                    for (number, product) in import.products.iter().enumerate().filter(open) {
                        if ui.button(&product.fields.name).clicked() {
                            commands.push(Command::Import(Step::StatesOf(number)));
                            ui.close();
                        }
                    }
                });
            });
            menu.response.on_hover_text("The files that are chosen are states of another product here");
        });
        if import.selected.is_empty() {
            ui.weak("Click a row; Shift for a range, Ctrl or Space for more.");
        } else {
            ui.weak(format!("{} chosen", plural(import.selected.len(), "row")));
        }
    });
}

/// Imports that were left for later.
fn drafts(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    if state.drafts.is_empty() {
        return;
    }
    ui.add_space(8.0);
    ui.strong(plural(state.drafts.len(), "draft"));
    for (number, draft) in state.drafts.iter().enumerate() {
        ui.push_id(("draft", number), |ui| {
            ui.horizontal_wrapped(|ui| {
                for (text, command) in
                    [("Go on", Command::OpenDraft(number)), ("Discard", Command::DiscardDraft(number))]
                {
                    let button = ui.button(text);
                    let label = format!("{text}: {}", draft.name);
                    button.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, &label));
                    if button.clicked() {
                        commands.push(command);
                    }
                }
                ui.label(&draft.name);
            });
        });
    }
}
