//! The import sheet: what was read, what the data doctor says about it, repairs tried before anything is stored.

use crate::app::command::{Command, ImportFields};
use crate::app::state::{Import, State};
use crate::app::theme;
use crate::compute::btdf::{Btdf, Dataset, Severity};
use crate::compute::direction::{Dir, Incident};
use crate::compute::doctor::{Diagnosis, Repair, Ways, examine, sun_from_above};
use egui::{Color32, Sense, Stroke, TextEdit, Ui, Vec2};
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
    if import.datasets.is_empty() {
        ui.add_space(6.0);
        ui.label("The catalogue is unchanged.");
    } else {
        recognised(ui, import, commands);
        fields(ui, import, commands);
    }
}

/// What can be done with what was read: always in sight, however much there is to say about it.
pub(super) fn actions(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(import) = &state.import else { return };
    ui.horizontal(|ui| {
        let missing = import.name.trim().is_empty();
        if !import.datasets.is_empty() {
            let add = ui.add_enabled(!missing, egui::Button::new("Add to catalogue"));
            if add.clicked() {
                commands.push(Command::AddImport);
            }
        }
        if ui.button("Discard").on_hover_text("Forget what was read; nothing was stored").clicked() {
            commands.push(Command::DiscardImport);
        }
        if missing && !import.datasets.is_empty() {
            ui.weak("It needs a name: below.");
        }
    });
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

fn recognised(ui: &mut Ui, import: &Import, commands: &mut Vec<Command>) {
    ui.add_space(4.0);
    ui.strong("Recognised");
    if !import.repairs.is_empty() {
        ui.horizontal_wrapped(|ui| {
            let words: Vec<String> = import.repairs.iter().map(|repair| repair.label()).collect();
            ui.label(format!("Repaired: {}", words.join("; ")));
            if ui.button("Undo the repair").on_hover_text("Take the last repair back").clicked() {
                commands.push(Command::UndoRepair);
            }
        });
    }
    for (index, dataset) in import.datasets.iter().enumerate() {
        let state = if dataset.state.is_empty() { String::new() } else { format!(", state {}", dataset.state) };
        ui.label(format!("{}{state}", if dataset.name.is_empty() { "(no name)" } else { &dataset.name }));
        ui.weak(format!(
            "{}; incident {}, emergent {}",
            dataset.format, dataset.incident_basis, dataset.emergent_basis
        ));
        if let Some(btdf) = dataset.transmission() {
            ui.weak(format!("τ {:.3} normal, {:.3} hemispherical", btdf.tau_normal(), btdf.tau_hemispherical()));
            if let Some(text) = sun_from_above(btdf) {
                picture(ui, btdf, &text);
            }
        }
        let found = import.diagnoses.get(index).map_or(&[] as &[Diagnosis], Vec::as_slice);
        ui.push_id(index, |ui| {
            diagnoses(ui, found, &import.repairs, |repair| commands.push(Command::Repair(repair)));
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

fn fields(ui: &mut Ui, import: &Import, commands: &mut Vec<Command>) {
    let mut fields = ImportFields {
        name: import.name.clone(),
        manufacturer: import.manufacturer.clone(),
        kind: import.kind.clone(),
        tags: import.tags.clone(),
    };
    ui.add_space(6.0);
    ui.strong("About it");
    egui::Grid::new("about").num_columns(2).show(ui, |ui| {
        for (label, text) in [
            ("Name", &mut fields.name),
            ("Manufacturer", &mut fields.manufacturer),
            ("Kind", &mut fields.kind),
            ("Tags", &mut fields.tags),
        ] {
            let name = ui.label(label);
            ui.add(TextEdit::singleline(text).desired_width(200.0)).labelled_by(name.id);
            ui.end_row();
        }
    });
    let before = (&import.name, &import.manufacturer, &import.kind, &import.tags);
    if before != (&fields.name, &fields.manufacturer, &fields.kind, &fields.tags) {
        commands.push(Command::EditImport(Box::new(fields)));
    }
}
