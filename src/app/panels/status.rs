//! The bottom line: what runs, how exact what is shown is, what the dataset's checks say.

use crate::app::command::Command;
use crate::app::state::Sheet;
use crate::app::theme;
use crate::app::window::App;
use crate::compute::btdf::Severity;
use egui::{ProgressBar, RichText, Ui};

/// A duration in words.
fn duration(seconds: f64) -> String {
    if seconds < 1.0 { format!("{:.1} ms", 1000.0 * seconds) } else { format!("{seconds:.1} s") }
}

/// An error in percent, honest about what two decimals cannot say.
fn percent(error: f64) -> String {
    if error < 0.005 { "< 0.01 %".to_owned() } else { format!("±{error:.2} %") }
}

/// Draws the line.
pub fn show(ui: &mut Ui, app: &App, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    ui.horizontal(|ui| {
        if let Some(room) = &app.results.room.value {
            let tag = if app.results.room.stale { ", updating" } else { "" };
            let error = 100.0 * room.relative_error();
            ui.label(format!("room: {}, {}{tag}", percent(error), duration(room.seconds)))
                .on_hover_text("Greatest error estimate over the greatest illuminance, and the time it took");
        }
        if let Some(lid) = &app.results.lid.value {
            let relative = if lid.flux.value > 0.0 { 100.0 * lid.flux.error / lid.flux.value } else { 0.0 };
            ui.separator();
            ui.label(format!("LID: {}, {}", percent(relative), duration(lid.seconds)))
                .on_hover_text("Error estimate of the flux, and the time it took");
        }
        for job in app.jobs.views() {
            ui.separator();
            let stage = job.state.stage();
            let text =
                if stage.is_empty() { job.lane.word().to_owned() } else { format!("{}: {stage}", job.lane.word()) };
            match job.state.fraction() {
                Some(fraction) => {
                    ui.label(text);
                    ui.add(ProgressBar::new(fraction).desired_width(70.0).desired_height(10.0));
                }
                None => {
                    ui.label(format!("{text}…"));
                }
            }
            if ui.small_button("×").on_hover_text(format!("Cancel {}", job.lane.word())).clicked() {
                commands.push(Command::Cancel(job.lane));
            }
        }
        if app.busy() {
            // Progress bars move on. Not more often: without a graphics card every frame is taken from the work.
            ui.ctx().request_repaint_after(std::time::Duration::from_millis(250));
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if !app.toasts.is_empty() {
                let text = match app.toasts.len() {
                    1 => "1 message".to_owned(),
                    count => format!("{count} messages"),
                };
                if ui.button(text).on_hover_text("What the window said").clicked() {
                    commands.push(Command::Sheet(Some(Sheet::Messages)));
                }
            }
            // As the doctor found on import: examining anew takes too long for every frame.
            let shown = app.state.dataset.value.as_ref().map(|dataset| dataset.state.as_str());
            let product = app.state.product.as_ref().map_or(&[][..], |product| &product.findings);
            let findings = product.iter().filter(|finding| Some(finding.state.as_str()) == shown);
            let count = |severity| findings.clone().filter(|finding| finding.severity == severity).count();
            let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
            let (text, colour) = match (errors, warnings) {
                (0, 0) => ("dataset: no warnings".to_owned(), palette.weak),
                (0, n) => (format!("dataset: {n} warning{}", if n == 1 { "" } else { "s" }), palette.warning),
                (n, _) => (format!("dataset: {n} error{}", if n == 1 { "" } else { "s" }), palette.error),
            };
            if ui.button(RichText::new(text).color(colour)).on_hover_text("What the checks say").clicked() {
                commands.push(Command::Sheet(Some(Sheet::Findings)));
            }
        });
    });
}
