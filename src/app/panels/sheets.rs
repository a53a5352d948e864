//! Sheets at the side: imports, findings, keys, paths. None of them stops the rest of the window.

use crate::app::App;
use crate::app::command::{Command, ImportFields};
use crate::app::jobs::Lane;
use crate::app::state::{Import, PathUse, Sheet, State};
use crate::app::theme;
use crate::app::views::accuracy;
use crate::compute::btdf::{Btdf, Finding, Indicatrix, Severity};
use crate::compute::direction::{Dir, Emergent, Incident};
use egui::{Key, RichText, ScrollArea, TextEdit, Ui};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::path::PathBuf;

/// Draws the sheet that is open.
pub fn show(ui: &mut Ui, app: &mut App, sheet: Sheet, commands: &mut Vec<Command>) {
    let title = match sheet {
        Sheet::Import => "Import",
        Sheet::Findings => "Findings of the dataset",
        Sheet::Keys => "Keys",
        Sheet::Accuracy => "Accuracy",
        Sheet::Goniophotometer => "Goniophotometer",
        Sheet::Path(PathUse::Open) => "Open",
        Sheet::Path(PathUse::SaveScene) => "Save the scene",
        Sheet::Path(PathUse::ExportLid) => "Export the LID",
        Sheet::Path(PathUse::ExportTile(_)) => "Export a tile",
        Sheet::Path(PathUse::ExportMeasured) => "Export the computed data",
    };
    ui.horizontal(|ui| {
        ui.heading(title);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let escaped = ui.input(|input| input.key_pressed(Key::Escape));
            if ui.button("Close").on_hover_text("Close this sheet (Escape)").clicked() || escaped {
                commands.push(Command::Sheet(None));
            }
        });
    });
    ScrollArea::vertical().id_salt(title).auto_shrink([false, false]).show(ui, |ui| match sheet {
        Sheet::Import => import(ui, &app.state, commands),
        Sheet::Findings => match app.state.dataset.value.as_deref() {
            Some(dataset) => {
                ui.strong(&dataset.name);
                findings(ui, &dataset.findings);
            }
            None => {
                ui.label("No product is selected.");
            }
        },
        Sheet::Keys => keys(ui),
        Sheet::Accuracy => ladder(ui, app, commands),
        Sheet::Goniophotometer => super::goniophotometer::show(ui, app, commands),
        Sheet::Path(what) => path(ui, &app.state, what, commands),
    });
}

fn ladder(ui: &mut Ui, app: &mut App, commands: &mut Vec<Command>) {
    let running = app.jobs.views().iter().find(|job| job.lane == Lane::Accuracy).map(|job| job.state.clone());
    let shown = &app.results.accuracy;
    let input = accuracy::Input {
        accuracy: shown.value.as_deref(),
        revision: app.results.accuracy_revision,
        stale: shown.stale,
        error: shown.error.as_deref(),
        running: running.map(|state| state.fraction().unwrap_or(0.0)),
    };
    for action in accuracy::show(ui, &input, &mut app.accuracy_view) {
        commands.push(match action {
            accuracy::Action::Run => Command::MeasureAccuracy,
            accuracy::Action::Cancel => Command::Cancel(Lane::Accuracy),
        });
    }
}

fn findings(ui: &mut Ui, findings: &[Finding]) {
    let palette = theme::palette(ui);
    if findings.is_empty() {
        ui.label("The checks have nothing to say.");
    }
    for severity in [Severity::Error, Severity::Warning, Severity::Info] {
        for finding in findings.iter().filter(|finding| finding.severity == severity) {
            let colour = match severity {
                Severity::Error => palette.error,
                Severity::Warning => palette.warning,
                Severity::Info => palette.weak,
            };
            ui.add_space(4.0);
            ui.colored_label(colour, severity.word());
            ui.add(egui::Label::new(&finding.message).wrap());
        }
    }
}

fn import(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
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
        recognised(ui, import);
        fields(ui, import, commands);
    }
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        let missing = import.name.trim().is_empty();
        if !import.datasets.is_empty() {
            let add = ui.add_enabled(!missing, egui::Button::new(Command::AddImport.info().text));
            if add.on_disabled_hover_text("Give it a name first").clicked() {
                commands.push(Command::AddImport);
            }
        }
        let discard = Command::DiscardImport.info();
        if ui.button(discard.text).on_hover_text(discard.tip).clicked() {
            commands.push(Command::DiscardImport);
        }
    });
}

/// Where the light of a sun 45° above in front goes: the user knows the product and sees whether up is up.
fn orientation(btdf: &Btdf) -> Option<String> {
    let incident = Incident(Dir::from_theta_phi(FRAC_PI_4, FRAC_PI_2));
    let total = btdf.tau(incident);
    if total <= 0.0 {
        return None;
    }
    // What passes unscattered keeps its way: down.
    let mut down = btdf.regular.as_ref().map_or(0.0, |regular| regular.at(FRAC_PI_4));
    let mut sum = down;
    if let Some(Indicatrix { basis, q }) = btdf.indicatrix(incident) {
        for (cell, q) in basis.cells().zip(q) {
            let flux = q * cell.projected_solid_angle();
            let rise = Emergent::from_through_name(cell.centre()).0.vector().y;
            sum += flux;
            // A cell on the horizon, as the one about the normal, is half above and half below.
            down += flux * if rise.abs() < 1e-9 { 0.5 } else { f64::from(u8::from(rise < 0.0)) };
        }
    }
    let share = 100.0 * down / sum;
    let text = match share {
        0.0..=45.0 => format!("{:.0} % of the transmitted light goes up.", 100.0 - share),
        45.0..=55.0 => "the transmitted light goes up and down alike.".to_owned(),
        _ => format!("{share:.0} % of the transmitted light goes down."),
    };
    Some(format!("With the sun 45° above in front, {text}"))
}

fn recognised(ui: &mut Ui, import: &Import) {
    ui.add_space(4.0);
    ui.strong("Recognised");
    for dataset in &import.datasets {
        let state = if dataset.state.is_empty() { String::new() } else { format!(", state {}", dataset.state) };
        ui.label(format!("{}{state}", if dataset.name.is_empty() { "(no name)" } else { &dataset.name }));
        ui.weak(format!(
            "{}; incident {}, emergent {}",
            dataset.format, dataset.incident_basis, dataset.emergent_basis
        ));
        if let Some(btdf) = dataset.transmission() {
            ui.weak(format!("τ {:.3} normal, {:.3} hemispherical", btdf.tau_normal(), btdf.tau_hemispherical()));
            if let Some(text) = orientation(btdf) {
                ui.add(egui::Label::new(text).wrap())
                    .on_hover_text("If this is not so, the file has outside and inside or up and down exchanged");
            }
        }
        findings(ui, &dataset.findings);
    }
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

fn keys(ui: &mut Ui) {
    egui::Grid::new("keys").num_columns(2).striped(true).show(ui, |ui| {
        for command in Command::listed() {
            let info = command.info();
            if let Some(keys) = info.shortcut {
                ui.label(RichText::new(ui.ctx().format_shortcut(&keys)).monospace());
                ui.label(info.text);
                ui.end_row();
            }
        }
    });
}

fn path(ui: &mut Ui, state: &State, what: PathUse, commands: &mut Vec<Command>) {
    let (hint, action) = match what {
        PathUse::Open => (
            "Dataset (.xml, .btdf.txt), system (.system.toml), scene (.toml) or control curve (.csv); or drop the file on the window.",
            "Open",
        ),
        PathUse::SaveScene => ("Everything this study needs, as a text file (.toml).", "Save"),
        PathUse::ExportLid => ("Luminaire file: .ldt (EULUMDAT) or .ies (LM-63); the ending decides.", "Export"),
        PathUse::ExportMeasured => ("All states in a package (.cfsp), or a file a state (.xml, .btdf.txt).", "Export"),
        PathUse::ExportTile(_) => ("Numbers (.csv) or a picture (.png); the ending decides.", "Export"),
    };
    ui.add(egui::Label::new(hint).wrap());
    let mut text = state.path.clone();
    let name = ui.label("Path");
    let field = ui.add(TextEdit::singleline(&mut text).desired_width(f32::INFINITY)).labelled_by(name.id);
    // Whoever opens the sheet wants to type: once, when it was not there in the pass before.
    let pass = ui.ctx().cumulative_pass_nr();
    let before = ui.data_mut(|data| std::mem::replace(data.get_temp_mut_or(field.id.with("pass"), 0), pass));
    if before + 1 < pass {
        field.request_focus();
    }
    if text != state.path {
        commands.push(Command::EditPath(text.clone()));
    }
    let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    let ready = !text.trim().is_empty();
    if (ui.add_enabled(ready, egui::Button::new(action)).clicked() || entered) && ready {
        commands.push(Command::Write(what, PathBuf::from(text.trim())));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::btdf::{AngularTransmittance, Scattered};

    #[test]
    fn orientation_of_what_is_known() {
        let opal = Btdf { regular: None, scattered: Some(Scattered::Lambert(AngularTransmittance::Constant(0.5))) };
        assert!(orientation(&opal).is_some_and(|text| text.contains("up and down alike")));
        let clear = Btdf { regular: Some(AngularTransmittance::Constant(0.8)), scattered: None };
        assert!(orientation(&clear).is_some_and(|text| text.contains("100 % of the transmitted light goes down")));
    }
}
