//! The side panel of an import: the files that were read, the products they form, open questions, and what will be
//! stored; drafts of earlier imports.

mod detail;
mod findings;
mod table;

use crate::app::command::Command;
use crate::app::import::Imports;
use crate::app::import::proposal::{Import, Proposed, number};
use crate::app::import::step::Step;
use crate::catalogue::Grouping;
use crate::texts::import as text;
use egui::{ScrollArea, Ui};
pub(super) use findings::of_selection;

/// Width of the side panel below which the texts about a product are shown under the table instead of beside it.
/// \[points\]
const NARROW: f32 = 620.0;

/// Draws the side panel of an import.
pub(super) fn show(ui: &mut Ui, imports: &Imports, commands: &mut Vec<Command>) {
    actions(ui, imports, commands);
    let Some(import) = imports.open() else {
        ui.label(text::DROP_HERE);
        return drafts(ui, imports, commands);
    };
    if import.products.is_empty() {
        ui.add_space(6.0);
        ui.label(text::UNCHANGED);
    } else {
        grouping(ui, import, commands);
        by_hand(ui, import, commands);
    }
    ui.separator();
    let beside = ui.available_width() > NARROW && !import.products.is_empty();
    if beside {
        egui::Panel::right("import-detail").default_size(300.0).size_range(260.0..=460.0).show(ui, |ui| {
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
        drafts(ui, imports, commands);
    });
}

/// Draws the buttons for the import as a whole: add to the catalogue, save as draft, discard, accept all proposals.
fn actions(ui: &mut Ui, imports: &Imports, commands: &mut Vec<Command>) {
    let Some(import) = imports.open() else { return };
    let ready = import.products.iter().filter(|product| product.ready()).count();
    let wrong = import.wanted().any(|product| product.problem().is_some());
    let questions = import.questions();
    ui.horizontal_wrapped(|ui| {
        if !import.products.is_empty() {
            let words: String = match import.products.len() {
                1 => text::ADD_ONE.into(),
                _ => text::add_many(number(ready, text::ONE_PRODUCT, text::products)),
            };
            // What is being arranged otherwise is stored as it will be.
            let ready = ready > 0 && !import.arranging;
            if ui.add_enabled(ready, egui::Button::new(words)).clicked() {
                commands.push(Command::AddImport);
            }
            if ui.button(text::KEEP_DRAFT).on_hover_text(text::KEEP_DRAFT_TIP).clicked() {
                commands.push(Command::KeepDraft);
            }
        }
        if ui.button(text::DISCARD).on_hover_text(text::DISCARD_TIP).clicked() {
            commands.push(Command::DiscardImport);
        }
        if questions > 0 {
            if ui.button(text::ALL_AS_PROPOSED).on_hover_text(text::ALL_AS_PROPOSED_TIP).clicked() {
                commands.push(Command::Import(Step::SettleAll));
            }
            ui.weak(text::open_questions(number(questions, text::ONE_QUESTION, text::questions)));
        }
        if wrong {
            ui.weak(text::RED_BELOW.get());
        } else if import.wanted().next().is_none() && !import.products.is_empty() {
            ui.weak(text::ALL_THERE.get());
        }
    });
}

/// Draws the numbers of products and states, and the choice of how all files are grouped into products.
fn grouping(ui: &mut Ui, import: &Import, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        let products = number(import.products.len(), text::ONE_PRODUCT, text::products);
        let states = number(import.states(), text::ONE_STATE, text::states);
        ui.strong(text::products_of_states(products, states));
        if import.arranging {
            ui.weak(text::ARRANGING.get());
        }
        if import.sources.len() < 2 {
            return;
        }
        for (grouping, words, tip) in [
            (Grouping::Proposed, text::BY_ANGLE, text::BY_ANGLE_TIP),
            (Grouping::Each, text::EVERY_FILE, text::EVERY_FILE_TIP),
            (Grouping::One, text::ALL_ONE, text::ALL_ONE_TIP),
        ] {
            let chosen = import.grouping == grouping && import.by_hand.is_none();
            if ui.selectable_label(chosen, words).on_hover_text(tip).clicked() {
                commands.push(Command::GroupImport(grouping));
            }
        }
        if import.by_hand.is_some() {
            ui.weak(text::BY_HAND.get());
        }
    });
}

/// Draws the buttons that change the grouping of the selected rows.
fn by_hand(ui: &mut Ui, import: &Import, commands: &mut Vec<Command>) {
    if import.states() < 2 {
        return;
    }
    let files = import.files_of_selected().len();
    ui.horizontal_wrapped(|ui| {
        let all = import.selected.len() == import.states();
        if ui.button(if all { text::CHOOSE_NONE } else { text::CHOOSE_ALL }).clicked() {
            commands.push(Command::Import(Step::ChooseAll));
        }
        for (least, step, words, tip) in [
            (2, Step::Together, text::ONE_OF_THESE, text::ONE_OF_THESE_TIP),
            (1, Step::Separate, text::EACH_ITS_OWN, text::EACH_ITS_OWN_TIP),
        ] {
            if ui.add_enabled(files >= least, egui::Button::new(words)).on_hover_text(tip).clicked() {
                commands.push(Command::Import(step));
            }
        }
        ui.add_enabled_ui(files > 0, |ui| {
            let menu = ui.menu_button(text::STATE_OF, |ui| {
                ScrollArea::vertical().max_height(300.0).show(ui, |ui| {
                    let open = |(_, product): &(usize, &Proposed)| !product.packed;
                    for (place, product) in import.products.iter().enumerate().filter(open) {
                        if ui.button(&product.fields.name).clicked() {
                            commands.push(Command::Import(Step::StatesOf(place)));
                            ui.close();
                        }
                    }
                });
            });
            menu.response.on_hover_text(text::STATE_OF_TIP);
        });
        if import.selected.is_empty() {
            ui.weak(text::CLICK_A_ROW.get());
        } else {
            ui.weak(text::chosen(number(import.selected.len(), text::ONE_ROW, text::rows)));
        }
    });
}

/// Draws the list of drafts of earlier imports.
fn drafts(ui: &mut Ui, imports: &Imports, commands: &mut Vec<Command>) {
    if imports.drafts().is_empty() {
        return;
    }
    ui.add_space(8.0);
    ui.strong(number(imports.drafts().len(), text::ONE_DRAFT, text::drafts));
    for (place, draft) in imports.drafts().iter().enumerate() {
        ui.push_id(("draft", place), |ui| {
            ui.horizontal_wrapped(|ui| {
                for (words, command) in
                    [(text::CONTINUE, Command::OpenDraft(place)), (text::DISCARD, Command::DiscardDraft(place))]
                {
                    let button = ui.button(words);
                    let label = text::about(words, &draft.name);
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
