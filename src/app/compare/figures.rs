//! The table of the candidates' figures, each with unit and statistical error; the better value is marked if the
//! difference exceeds the errors.

use crate::app::command::Command;
use crate::app::compare::columns::Columns;
use crate::app::compare::view::Act;
use crate::app::display::theme;
use crate::study::comparison::{Row, Value, Verdict, verdict_words};
use crate::texts::compare as texts;
use egui::{Grid, Label, RichText, ScrollArea, Ui};

/// Returns the text of the last column: the numbers of the better candidates, or the reason why none is better.
fn verdict(row: &Row, names: &[String]) -> String {
    match &row.verdict {
        Verdict::Better(list) => {
            let places: Vec<String> = list.iter().map(|place| (place + 1).to_string()).collect();
            format!("{} ({})", places.join(texts::AND.get()), row.figure.sense.words())
        }
        other => verdict_words(other, names),
    }
}

/// Draws the value of a candidate (index `place`) after the text `start`, with a mark if it is the better one.
fn cell(ui: &mut Ui, row: &Row, place: usize, start: &str) {
    let text = row.values[place].map_or_else(|| "–".to_owned(), Value::words);
    if matches!(&row.verdict, Verdict::Better(list) if list.contains(&place)) {
        let text = RichText::new(format!("▲ {start}{text}")).strong().color(theme::palette(ui).good);
        ui.label(text).on_hover_text(texts::better(row.figure.sense.words()));
    } else {
        ui.label(format!("{start}{text}"));
    }
}

/// Returns name and unit of a row's figure as text.
fn heading(row: &Row) -> String {
    let unit = if row.figure.unit.is_empty() { String::new() } else { format!(" / {}", row.figure.unit) };
    format!("{}{unit}", row.figure.name)
}

/// Draws the table with a column for each candidate.
fn table(ui: &mut Ui, rows: &[Row], names: &[String]) {
    Grid::new("compared figures").striped(true).spacing([12.0, 6.0]).show(ui, |ui| {
        ui.label(RichText::new(texts::FIGURE.get()).strong());
        for name in names {
            ui.scope(|ui| {
                ui.set_max_width(COLUMN - 12.0);
                ui.add(Label::new(RichText::new(name).strong()).wrap());
            });
        }
        ui.label(RichText::new(texts::BETTER.get()).strong()).on_hover_text(texts::BETTER_TIP);
        ui.end_row();
        for row in rows {
            ui.label(heading(row)).on_hover_text(row.figure.tip);
            (0..names.len()).for_each(|place| cell(ui, row, place, ""));
            ui.label(RichText::new(verdict(row, names)).color(theme::palette(ui).weak));
            ui.end_row();
        }
    });
}

/// Draws the values of the candidates line by line under the name of each figure, if there is no room for columns.
fn lines(ui: &mut Ui, rows: &[Row], names: &[String]) {
    names.iter().for_each(|name| drop(ui.add(Label::new(RichText::new(name).strong()).wrap())));
    for row in rows {
        ui.add_space(6.0);
        ui.label(RichText::new(heading(row)).strong()).on_hover_text(row.figure.tip);
        for place in 0..names.len() {
            cell(ui, row, place, &format!("{}: ", place + 1));
        }
        ui.label(RichText::new(verdict(row, names)).color(theme::palette(ui).weak));
    }
}

/// Width of a candidate's column, and common width of the first and the last column. \[points\]
const COLUMN: f32 = 134.0;
const OUTER: f32 = 370.0;

/// Draws the table of figures, or the lines that replace it in little space.
pub(super) fn show(ui: &mut Ui, columns: &Columns, commands: &mut Vec<Command>) {
    let (rows, names) = (columns.rows(), columns.names());
    let palette = theme::palette(ui);
    ScrollArea::vertical().id_salt("figures").auto_shrink([false, false]).show(ui, |ui| {
        for (column, name) in columns.list.iter().zip(&names) {
            if let Some(error) = column.error() {
                let text = RichText::new(format!("{name}: {error}")).color(palette.error);
                ui.add(Label::new(text).wrap());
            }
        }
        if ui.available_width() < OUTER + COLUMN * names.len() as f32 {
            lines(ui, &rows, &names);
        } else {
            table(ui, &rows, &names);
        }
        ui.add_space(6.0);
        ui.add(Label::new(RichText::new(texts::ERRORS_NOTE.get()).color(palette.weak)).wrap());
        if ui.button(texts::COPY_CSV).on_hover_text(texts::COPY_CSV_TIP).clicked() {
            commands.push(Command::Compare(Act::Copy));
        }
    });
}
