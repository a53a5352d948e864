//! The import sheet: what was read, what the data doctor says about it, repairs tried before anything is stored.

use crate::app::command::Command;
use crate::app::import::{Import, Proposed};
use crate::app::state::State;
use crate::app::theme;
use crate::catalogue::Grouping;
use crate::compute::btdf::{Btdf, Dataset, Severity};
use crate::compute::direction::{Dir, Incident};
use crate::compute::doctor::{Diagnosis, Repair, Ways, examine, sun_from_above};
use egui::{Color32, Sense, Stroke, Ui, Vec2};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::sync::Arc;

/// Draws the sheet.
pub(super) fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    let Some(import) = &state.import else {
        ui.label("Drop dataset files anywhere on the window, or press Ctrl+O.");
        return;
    };
    for failure in &import.failures {
        ui.add_space(4.0);
        ui.colored_label(palette.error, "Not read");
        ui.add(egui::Label::new(failure).wrap());
    }
    if import.products.is_empty() {
        ui.add_space(6.0);
        ui.label("The catalogue is unchanged.");
    } else {
        grouping(ui, import, commands);
        let several = import.products.len() > 1;
        for (number, product) in import.products.iter().enumerate() {
            ui.push_id(number, |ui| {
                ui.add_space(8.0);
                ui.separator();
                if several {
                    ui.strong(format!("Product {} of {}", number + 1, import.products.len()));
                }
                one(ui, number, product, commands);
            });
        }
    }
    left_out(ui, import);
}

fn plural(count: usize, word: &str) -> String {
    if count == 1 { format!("1 {word}") } else { format!("{count} {word}s") }
}

/// What can be done with what was read: always in sight, however much there is to say about it.
pub(super) fn actions(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(import) = &state.import else { return };
    let wanted = import.wanted().count();
    let nameless = import.wanted().any(|product| !product.named());
    ui.horizontal_wrapped(|ui| {
        if !import.products.is_empty() {
            let text = if import.products.len() == 1 {
                "Add to catalogue".to_owned()
            } else {
                format!("Add {} to catalogue", plural(wanted, "product"))
            };
            if ui.add_enabled(wanted > 0 && !nameless, egui::Button::new(text)).clicked() {
                commands.push(Command::AddImport);
            }
        }
        if ui.button("Discard").on_hover_text("Forget what was read; nothing was stored").clicked() {
            commands.push(Command::DiscardImport);
        }
        if nameless {
            ui.weak("A name is missing: below.");
        } else if wanted == 0 && !import.products.is_empty() {
            ui.weak("All of it is in the catalogue already: below.");
        }
    });
}

/// How the files are taken, as a list of products with their states, and the other ways to take them.
fn grouping(ui: &mut Ui, import: &Import, commands: &mut Vec<Command>) {
    ui.add_space(4.0);
    ui.strong(format!("{} of {}", plural(import.products.len(), "product"), plural(import.states(), "state")));
    for product in &import.products {
        let states: Vec<String> = product.datasets.iter().map(|dataset| state_word(&dataset.state)).collect();
        let name = if product.named() { product.fields.name.as_str() } else { "(no name)" };
        let text = match states.as_slice() {
            [one] if one.is_empty() => name.to_owned(),
            _ => format!("{name}: {}", states.join(", ")),
        };
        ui.add(egui::Label::new(text).wrap());
    }
    if import.states() < 2 {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        for (grouping, text, tip) in [
            (Grouping::Proposed, "By angle", "Files that differ by an angle alone are states of one product"),
            (Grouping::Each, "Each its own", "Every file is a product"),
            (Grouping::One, "All one product", "Every file is a state of one product"),
        ] {
            if ui.selectable_label(import.grouping == grouping, text).on_hover_text(tip).clicked() {
                commands.push(Command::GroupImport(grouping));
            }
        }
    });
}

/// A state's key, with the unit where it is an angle.
fn state_word(key: &str) -> String {
    if key.parse::<f64>().is_ok() { format!("{key}°") } else { key.to_owned() }
}

/// Files that are no datasets, with the reason.
fn left_out(ui: &mut Ui, import: &Import) {
    if import.left_out.is_empty() {
        return;
    }
    ui.add_space(8.0);
    ui.separator();
    ui.strong(format!("Left out: {}", plural(import.left_out.len(), "file")));
    for reason in &import.left_out {
        ui.add(egui::Label::new(reason).wrap());
    }
}

/// One product: whether it is there already, its words, its states and what the checks say about them.
fn one(ui: &mut Ui, number: usize, product: &Proposed, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    if let Some(known) = product.known.first() {
        ui.colored_label(palette.warning, format!("Already in the catalogue as {}", known.name));
        ui.horizontal(|ui| {
            if ui.button("Show it").on_hover_text("Select that product; this sheet stays").clicked() {
                commands.push(Command::Select(known.key.clone()));
            }
            let mut anyway = product.add_anyway;
            if ui.checkbox(&mut anyway, "Add anyway").changed() {
                commands.push(Command::AddAnyway(number, anyway));
            }
        });
    }
    ui.strong("About it");
    if let Some(typed) = super::product::words(ui, &product.fields) {
        commands.push(Command::EditImport(number, Box::new(typed)));
    }
    recognised(ui, number, product, commands);
}

/// What the doctor says about the selected dataset; asked once a dataset, not once a frame.
pub(super) fn of_selection(ui: &mut Ui, dataset: &Arc<Dataset>) {
    type Examined = Arc<(usize, Vec<Diagnosis>)>;
    let (id, place) = (egui::Id::unique("examined"), Arc::as_ptr(dataset) as usize);
    let kept: Option<Examined> = ui.data(|data| data.get_temp(id));
    let examined = match kept.filter(|kept| kept.0 == place) {
        Some(kept) => kept,
        None => {
            let made: Examined = Arc::new((place, examine(dataset)));
            ui.data_mut(|data| data.insert_temp(id, made.clone()));
            made
        }
    };
    diagnoses(ui, &examined.1, &[], |_| {});
}

/// Findings with their meaning, and a button for every repair that is offered and not yet made.
fn diagnoses(ui: &mut Ui, list: &[Diagnosis], made: &[Repair], mut ask: impl FnMut(Repair)) {
    let palette = theme::palette(ui);
    if list.is_empty() {
        ui.label("The checks have nothing to say.");
    }
    for severity in [Severity::Error, Severity::Warning, Severity::Info] {
        for Diagnosis { finding, meaning, repair, sure } in list.iter().filter(|one| one.finding.severity == severity) {
            let colour = match severity {
                Severity::Error => palette.error,
                Severity::Warning => palette.warning,
                Severity::Info => palette.weak,
            };
            ui.add_space(4.0);
            ui.colored_label(colour, severity.word());
            ui.add(egui::Label::new(&finding.message).wrap());
            if severity != Severity::Info && !meaning.is_empty() {
                ui.add(egui::Label::new(egui::RichText::new(*meaning).color(palette.weak)).wrap());
            }
            if let Some(repair) = repair.filter(|repair| !made.contains(repair)) {
                // The same repair may be offered by several findings.
                let button = ui.push_id((finding.code, repair), |ui| ui.button(repair.label())).inner;
                let tip = if *sure {
                    "Beyond doubt. Nothing is stored yet, and it can be undone"
                } else {
                    "A question: only if it is so for the product. Try it: nothing is stored, and it can be undone"
                };
                if button.on_hover_text(tip).clicked() {
                    ask(repair);
                }
            }
        }
    }
}

fn recognised(ui: &mut Ui, number: usize, product: &Proposed, commands: &mut Vec<Command>) {
    ui.add_space(4.0);
    ui.strong("Recognised");
    if !product.repairs.is_empty() {
        ui.horizontal_wrapped(|ui| {
            let words: Vec<String> = product.repairs.iter().map(|repair| repair.label()).collect();
            ui.label(format!("Repaired: {}", words.join("; ")));
            if ui.button("Undo the repair").on_hover_text("Take the last repair back").clicked() {
                commands.push(Command::UndoRepair(number));
            }
        });
    }
    for (index, dataset) in product.datasets.iter().enumerate() {
        let state = if dataset.state.is_empty() { String::new() } else { format!(", {}", state_word(&dataset.state)) };
        ui.label(format!("{}{state}", if dataset.name.is_empty() { "(no name)" } else { &dataset.name }));
        let source = product.sources.get(index).filter(|source| !source.is_empty());
        ui.weak(format!(
            "{}{}; incident {}, emergent {}",
            source.map(|source| format!("{source}: ")).unwrap_or_default(),
            dataset.format,
            dataset.incident_basis,
            dataset.emergent_basis
        ));
        if let Some(btdf) = dataset.transmission() {
            ui.weak(format!("τ {:.3} normal, {:.3} hemispherical", btdf.tau_normal(), btdf.tau_hemispherical()));
            if let Some(text) = sun_from_above(btdf) {
                picture(ui, btdf, &text);
            }
        }
        let found = product.diagnoses.get(index).map_or(&[] as &[Diagnosis], Vec::as_slice);
        ui.push_id(index, |ui| {
            diagnoses(ui, found, &product.repairs, |repair| commands.push(Command::Repair(number, repair)));
        });
    }
}

/// The section through a window with the sun 45° above outside, on the left, and arrows into the room as long as their
/// shares of the light.
fn picture(ui: &mut Ui, btdf: &Btdf, sentence: &str) {
    let Some(ways) = Ways::of(btdf, Incident(Dir::from_theta_phi(FRAC_PI_4, FRAC_PI_2))) else { return };
    let (response, painter) = ui.allocate_painter(Vec2::new(120.0, 72.0), Sense::hover());
    let palette = theme::palette(ui);
    let line: Color32 = ui.visuals().text_color();
    let middle = response.rect.center();
    painter.line_segment([middle - Vec2::Y * 34.0, middle + Vec2::Y * 34.0], Stroke::new(3.0, palette.weak));
    painter.arrow(middle + Vec2::new(-30.0, -30.0), Vec2::new(27.0, 27.0), Stroke::new(2.0, line));
    for (share, y) in [(ways.up, -1.0), (1.0 - ways.up, 1.0)] {
        let length = 32.0 * share as f32;
        if length > 1.0 {
            painter.arrow(
                middle + Vec2::new(3.0, 0.0),
                Vec2::new(length, y * length),
                Stroke::new(2.0, palette.warning),
            );
        }
    }
    response.on_hover_text("Section: outside on the left; if it is not so, up and down or the sides are exchanged");
    ui.add(egui::Label::new(sentence).wrap());
}
