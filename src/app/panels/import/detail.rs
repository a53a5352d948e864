//! Beside the table of what was found: words about the products that are chosen, and the row that is shown, as it will be
//! stored.

use super::findings::{counts, diagnoses, picture, plural, seen};
use crate::app::command::Command;
use crate::app::import::{Import, Proposed, Row};
use crate::app::import_steps::{Step, Word};
use crate::compute::btdf::Severity;
use crate::compute::doctor::{Repair, RepairKind};
use egui::{TextEdit, Ui};

/// Draws it.
pub(super) fn show(ui: &mut Ui, import: &Import, commands: &mut Vec<Command>) {
    let products = import.selected_products();
    let there = |row: &Row| import.products.get(row.0).is_some_and(|product| row.1 < product.datasets.len());
    let row = import.shown.filter(there).or_else(|| import.rows().next());
    if products.len() > 1 {
        ui.strong(format!("About {}", plural(products.len(), "product")));
        for_all(ui, import, &products, commands);
    } else if let Some((number, _)) = row {
        let number = products.first().copied().unwrap_or(number);
        ui.strong("About it");
        if let Some(typed) = crate::app::panels::product::words(ui, &import.products[number].fields, true) {
            commands.push(Command::EditImport(number, Box::new(typed)));
        }
    }
    if let Some(row) = row {
        ui.add_space(6.0);
        ui.separator();
        state(ui, row, &import.products[row.0], commands);
    }
}

/// Fields whose words are given to all that are chosen.
fn for_all(ui: &mut Ui, import: &Import, products: &[usize], commands: &mut Vec<Command>) {
    egui::Grid::new("for all").num_columns(2).show(ui, |ui| {
        for word in Word::ALL {
            let of = |number: &usize| word.of(&mut import.products[*number].fields.clone()).clone();
            let first = products.first().map(of).unwrap_or_default();
            let same = products.iter().all(|number| of(number) == first);
            let mut text = if same { first.clone() } else { String::new() };
            let before = text.clone();
            let name = ui.label(word.label());
            let hint = if same { "" } else { "different" };
            ui.add(TextEdit::singleline(&mut text).hint_text(hint).desired_width(180.0)).labelled_by(name.id);
            ui.end_row();
            if text != before {
                commands.push(Command::Import(Step::Word(word, text)));
            }
        }
    });
    ui.weak("What is typed here is written for all of them.");
}

fn state(ui: &mut Ui, (number, place): Row, product: &Proposed, commands: &mut Vec<Command>) {
    let dataset = &product.datasets[place];
    let source = product.sources.get(place).filter(|source| !source.is_empty());
    ui.add(egui::Label::new(egui::RichText::new(source.map_or(dataset.name.as_str(), String::as_str)).strong()).wrap());
    ui.weak(format!("{}; incident {}, emergent {}", dataset.format, dataset.incident_basis, dataset.emergent_basis));
    if let Some(seen) = seen(ui, dataset) {
        ui.weak(format!("τ {:.3} normal, {:.3} hemispherical", seen.tau[0], seen.tau[1]));
        if let Some(sentence) = &seen.sentence {
            picture(ui, seen.up, sentence);
        }
    }
    let repairs = product.wished.as_ref().unwrap_or(&product.repairs);
    let turn = Repair::whole(RepairKind::TurnUpsideDown);
    ui.horizontal_wrapped(|ui| {
        let tip = "Up and down exchanged in all states of this product; the picture shows what comes of it";
        if ui.button("Turn upside down").on_hover_text(tip).clicked() {
            commands.push(match repairs.last() == Some(&turn) {
                true => Command::UndoRepair(number),
                false => Command::Repair(number, turn),
            });
        }
        if !repairs.is_empty() && ui.button("Undo the repair").on_hover_text("Take the last repair back").clicked() {
            commands.push(Command::UndoRepair(number));
        }
    });
    if !repairs.is_empty() {
        let words: Vec<String> = repairs.iter().map(|repair| repair.label()).collect();
        let how = if product.wished.is_some() { "Repairing" } else { "Repaired" };
        ui.add(egui::Label::new(format!("{how}: {}", words.join("; "))).wrap());
    }
    ui.add_space(6.0);
    let found = product.diagnoses.get(place).map_or(&[][..], Vec::as_slice);
    let grave = found.iter().any(|one| one.finding.severity != Severity::Info);
    let title = if found.is_empty() { "No findings".to_owned() } else { format!("Findings: {}", counts(found)) };
    egui::CollapsingHeader::new(title).id_salt(("findings", number, place)).default_open(grave).show(ui, |ui| {
        let mut asked = None;
        diagnoses(ui, found, repairs, |repair| asked = Some(repair));
        commands.extend(asked.map(|repair| Command::Repair(number, repair)));
    });
}
