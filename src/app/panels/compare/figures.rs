//! The table of figures: each with unit and error, the better one marked where the difference is larger than the errors.

use crate::app::command::Command;
use crate::app::compare::Act;
use crate::app::theme;
use crate::app::window::App;
use crate::study::comparison::{Row, Value, Verdict, verdict_words};
use egui::{Grid, RichText, ScrollArea, Ui};

/// What the last column says.
fn verdict(row: &Row, names: &[String]) -> String {
    match &row.verdict {
        Verdict::Better(list) => {
            let places: Vec<String> = list.iter().map(|place| (place + 1).to_string()).collect();
            format!("{} ({})", places.join(" and "), row.figure.sense.words())
        }
        other => verdict_words(other, names),
    }
}

/// Draws the table.
pub(super) fn show(ui: &mut Ui, app: &App, commands: &mut Vec<Command>) {
    let rows = app.rows();
    let names = app.compare.names();
    let palette = theme::palette(ui);
    ScrollArea::both().id_salt("figures").auto_shrink([false, false]).show(ui, |ui| {
        for (column, name) in app.compare.list.iter().zip(&names) {
            if let Some(error) = column.error() {
                ui.colored_label(palette.error, format!("{name}: {error}"));
            }
        }
        Grid::new("compared figures").striped(true).spacing([12.0, 6.0]).show(ui, |ui| {
            ui.label(RichText::new("Figure").strong());
            for name in &names {
                ui.scope(|ui| {
                    ui.set_max_width(120.0);
                    ui.add(egui::Label::new(RichText::new(name).strong()).wrap());
                });
            }
            ui.label(RichText::new("Better").strong())
                .on_hover_text("Where the difference is larger than the errors together");
            ui.end_row();
            for row in &rows {
                let unit = if row.figure.unit.is_empty() { String::new() } else { format!(" / {}", row.figure.unit) };
                ui.label(format!("{}{unit}", row.figure.name)).on_hover_text(row.figure.tip);
                for (place, value) in row.values.iter().enumerate() {
                    let better = matches!(&row.verdict, Verdict::Better(list) if list.contains(&place));
                    let text = value.map_or_else(|| "–".to_owned(), Value::words);
                    if better {
                        let text = RichText::new(format!("▲ {text}")).strong().color(palette.good);
                        let label = ui.label(text);
                        label.on_hover_text(format!("Better: {}", row.figure.sense.words()));
                    } else {
                        ui.label(text);
                    }
                }
                ui.label(RichText::new(verdict(row, &names)).color(palette.weak));
                ui.end_row();
            }
        });
        ui.add_space(6.0);
        let note = "Errors are those of computation and data that are stated; measured data state none.";
        ui.label(RichText::new(note).color(palette.weak));
        if ui.button("Copy as CSV").on_hover_text("The table with all digits into the clipboard").clicked() {
            commands.push(Command::Compare(Act::Copy));
        }
    });
}
