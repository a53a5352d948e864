//! Details beside the table of an import: texts about the selected products, and the state of the active row as it will
//! be stored.

use super::findings::{counts, diagnoses, picture, repair_words, seen};
use crate::app::command::Command;
use crate::app::import::proposal::{Import, Proposed, Row, number};
use crate::app::import::step::{Step, Word};
use crate::compute::btdf::Severity;
use crate::compute::doctor::{Repair, RepairKind};
use crate::texts::{fixed, import as text};
use egui::{TextEdit, Ui};

/// Draws the details of the selected rows.
pub(super) fn show(ui: &mut Ui, import: &Import, commands: &mut Vec<Command>) {
    let products = import.selected_products();
    let there = |row: &Row| import.products.get(row.0).is_some_and(|product| row.1 < product.datasets.len());
    let row = import.shown.filter(there).or_else(|| import.rows().next());
    if products.len() > 1 {
        ui.strong(text::about_products(number(products.len(), text::ONE_PRODUCT, text::products)));
        for_all(ui, import, &products, commands);
    } else if let Some((place, _)) = row {
        let place = products.first().copied().unwrap_or(place);
        ui.strong(text::ABOUT_IT.get());
        if let Some(typed) = crate::app::panels::product::words(ui, &import.products[place].fields, true) {
            commands.push(Command::EditImport(place, Box::new(typed)));
        }
    }
    if let Some(row) = row {
        ui.add_space(6.0);
        ui.separator();
        state(ui, row, &import.products[row.0], commands);
    }
}

/// Draws text fields whose contents are given to all selected products.
fn for_all(ui: &mut Ui, import: &Import, products: &[usize], commands: &mut Vec<Command>) {
    egui::Grid::new("for all").num_columns(2).show(ui, |ui| {
        for word in Word::ALL {
            let of = |number: &usize| word.of(&mut import.products[*number].fields.clone()).clone();
            let first = products.first().map(of).unwrap_or_default();
            let same = products.iter().all(|number| of(number) == first);
            let mut typed = if same { first.clone() } else { String::new() };
            let before = typed.clone();
            let name = ui.label(word.label());
            let hint = if same { "" } else { text::DIFFERENT.get() };
            ui.add(TextEdit::singleline(&mut typed).hint_text(hint).desired_width(180.0)).labelled_by(name.id);
            ui.end_row();
            if typed != before {
                commands.push(Command::Import(Step::Word(word, typed)));
            }
        }
    });
    ui.weak(text::FOR_ALL.get());
}

/// Draws the details of one state of a product: file, bases, transmittances, findings of the data check, and repairs.
fn state(ui: &mut Ui, (own, place): Row, product: &Proposed, commands: &mut Vec<Command>) {
    let dataset = &product.datasets[place];
    let source = product.sources.get(place).filter(|source| !source.is_empty());
    ui.add(egui::Label::new(egui::RichText::new(source.map_or(dataset.name.as_str(), String::as_str)).strong()).wrap());
    ui.weak(text::bases(&dataset.format, &dataset.incident_basis, &dataset.emergent_basis));
    if let Some(seen) = seen(ui, dataset) {
        ui.weak(text::taus(fixed(seen.tau[0], 3), fixed(seen.tau[1], 3)));
        if let Some(ways) = &seen.ways {
            picture(ui, ways);
        }
    }
    let repairs = product.requested_repairs.as_ref().unwrap_or(&product.repairs);
    let turn = Repair::whole(RepairKind::TurnUpsideDown);
    ui.horizontal_wrapped(|ui| {
        if ui.button(text::TURN).on_hover_text(text::TURN_TIP).clicked() {
            commands.push(match repairs.last() == Some(&turn) {
                true => Command::UndoRepair(own),
                false => Command::Repair(own, turn),
            });
        }
        if !repairs.is_empty() && ui.button(text::UNDO_REPAIR).on_hover_text(text::UNDO_REPAIR_TIP).clicked() {
            commands.push(Command::UndoRepair(own));
        }
    });
    if !repairs.is_empty() {
        let words: Vec<String> = repairs.iter().copied().map(repair_words).collect();
        let words = words.join("; ");
        let line = if product.requested_repairs.is_some() { text::repairing(words) } else { text::repaired(words) };
        ui.add(egui::Label::new(line).wrap());
    }
    ui.add_space(6.0);
    let found = product.diagnoses.get(place).map_or(&[][..], Vec::as_slice);
    let grave = found.iter().any(|one| one.finding.severity != Severity::Info);
    let title: String = if found.is_empty() { text::NO_FINDINGS.into() } else { text::findings(counts(found)) };
    egui::CollapsingHeader::new(title).id_salt(("findings", own, place)).default_open(grave).show(ui, |ui| {
        let mut asked = None;
        diagnoses(ui, found, repairs, |repair| asked = Some(repair));
        commands.extend(asked.map(|repair| Command::Repair(own, repair)));
    });
}
