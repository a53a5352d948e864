//! Sheets at the side: imports, findings, keys, paths. None of them stops the rest of the window.

use super::{import, messages, product};
use crate::app::command::Command;
use crate::app::jobs::Lane;
use crate::app::offer::{key_words, listed};
use crate::app::state::{CatalogueState, PathUse, Sheet, State};
use crate::app::theme;
use crate::app::views::accuracy;
use crate::app::window::App;
use egui::{Key, RichText, ScrollArea, TextEdit, Ui};
use std::path::PathBuf;

/// Draws the sheet that is open.
pub fn show(ui: &mut Ui, app: &mut App, sheet: Sheet, commands: &mut Vec<Command>) {
    let title = match sheet {
        Sheet::Import => "Import",
        Sheet::Findings => "Findings of the dataset",
        Sheet::Keys => "Keys",
        Sheet::Accuracy => "Accuracy",
        Sheet::Goniophotometer => "Goniophotometer",
        Sheet::Product => "Product",
        Sheet::Deleted => "Recently deleted",
        Sheet::Messages => "Messages",
        Sheet::HandOn => "Hand on",
        Sheet::Path(what) => what.title(),
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
    if sheet == Sheet::Import {
        // Its table scrolls by itself.
        return import::show(ui, &app.state, commands);
    }
    ScrollArea::vertical().id_salt(title).auto_shrink([false, false]).show(ui, |ui| match sheet {
        Sheet::Import => {}
        Sheet::Findings => match app.state.dataset.value.as_ref() {
            Some(dataset) => {
                ui.strong(crate::app::title::selection(&app.state));
                import::of_selection(ui, dataset);
            }
            None => {
                let words = match &app.state.catalogue {
                    CatalogueState::Opening => "Opening the catalogue…",
                    CatalogueState::Failed(error) => error,
                    CatalogueState::Ready(_) => "No product chosen: choose one in the catalogue.",
                };
                ui.label(words);
            }
        },
        Sheet::Keys => keys(ui),
        Sheet::Accuracy => ladder(ui, app, commands),
        Sheet::Goniophotometer => super::goniophotometer::show(ui, app, commands),
        Sheet::Product => product::edit(ui, &app.state, commands),
        Sheet::Deleted => product::deleted(ui, &app.state, commands),
        Sheet::Messages => messages::list(ui, &app.toasts, commands),
        Sheet::HandOn => super::hand_on::show(ui, app, commands),
        Sheet::Path(what) => path(ui, &app.state, what, commands),
    });
}

fn ladder(ui: &mut Ui, app: &mut App, commands: &mut Vec<Command>) {
    let running = app.jobs.views().iter().find(|job| job.lane == Lane::Accuracy).map(|job| job.state.clone());
    let shown = &app.results.accuracy;
    let input = accuracy::Input {
        accuracy: shown.value.as_deref(),
        revision: app.results.accuracy.revision,
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

fn keys(ui: &mut Ui) {
    egui::Grid::new("keys").num_columns(2).striped(true).show(ui, |ui| {
        for (offer, keys) in listed().filter_map(|offer| Some((offer, offer.keys?))) {
            ui.label(RichText::new(key_words(&keys)).strong());
            ui.label(&offer.text);
            ui.end_row();
        }
    });
}

fn path(ui: &mut Ui, state: &State, what: PathUse, commands: &mut Vec<Command>) {
    let (hint, action) = match what {
        PathUse::Open => (
            "Dataset (.xml, .btdf.txt), folder or archive of datasets (.zip), package (.cfsp), system (.system.toml), scene (.toml) or control curve (.csv); or drop files on the window.",
            "Open",
        ),
        PathUse::ReplaceState => (
            "Dataset of one state (.xml, .btdf.txt, .cfsd): its data take the place of those that are stored.",
            "Replace",
        ),
        PathUse::SaveScene => ("Everything this study needs, as a text file (.toml).", "Save"),
        PathUse::ExportLid => (
            "Luminaire file (.ldt EULUMDAT, .ies LM-63), table (.csv) or diagram (.svg, .png); the ending decides.",
            "Export",
        ),
        PathUse::ExportMeasured => ("All states in a package (.cfsp), or a file a state (.xml, .btdf.txt).", "Export"),
        PathUse::ExportTile(_) => ("Numbers (.csv).", "Export"),
        // It has a sheet of its own.
        PathUse::HandOn => ("Folder and name of what is handed on.", "Write"),
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
    let path = PathBuf::from(text.trim());
    if state.replace.as_ref() == Some(&path) {
        ui.colored_label(theme::palette(ui).warning, "A file of this name exists already.");
        ui.horizontal(|ui| {
            if ui.button("Replace").on_hover_text("Write over it").clicked() {
                commands.push(Command::Write(what, path.clone()));
            }
            if ui.button("Other name").on_hover_text("Keep the file; give another name").clicked() {
                commands.push(Command::KeepFile);
                field.request_focus();
            }
        });
    } else if (ui.add_enabled(ready, egui::Button::new(action)).clicked() || entered) && ready {
        commands.push(Command::WriteNew(what, path));
    }
}
