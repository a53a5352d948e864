//! The figures of an annual simulation as a table: value, error, range over the sensor points, comparison with limits;
//! tooltips contain the definitions.

use crate::app::paint::palette::Palette;
use crate::study::year::Row;
use crate::texts::year as say;
use egui::{Grid, Label, Rect, RichText, ScrollArea, Ui, UiBuilder, Vec2, vec2};
use std::fmt::Write as _;

/// Minimum width of a table with one line per row \[points\]; in a narrower one the comparison with limits is placed
/// under the figure.
const WIDE: f32 = 600.0;

/// Width that a narrow table leaves for values. \[points\]
const VALUES: f32 = 110.0;
/// Height of a row including the space under it. \[points\]
const PITCH: f32 = 26.0;
/// Space between columns (x) and between rows (y). \[points\]
const SPACING: Vec2 = vec2(10.0, 4.0);

/// Draws the table of the figures.
pub(super) fn show(ui: &mut Ui, rect: Rect, rows: &[Row]) {
    let palette = Palette::of(ui.visuals());
    let text = |words: String, colour| RichText::new(words).size(13.0).color(colour);
    let wide = rect.width() >= WIDE;
    // Whole rows: none is cut before it is scrolled.
    let rect = rect.with_max_y(rect.top() + ((rect.height() / PITCH).floor() * PITCH).max(PITCH));
    // In a cell a line across all columns would widen that of the names.
    let across = |ui: &mut Ui, line: RichText| {
        let place = Rect::from_min_size(ui.cursor().min, vec2(rect.width(), PITCH - SPACING.y));
        ui.new_child(UiBuilder::new().max_rect(place)).add(Label::new(line).truncate());
    };
    ui.scope_builder(UiBuilder::new().max_rect(rect).id_salt("figures"), |ui| {
        ScrollArea::vertical().id_salt("figures").auto_shrink([false, false]).show(ui, |ui| {
            let grid = Grid::new("figures").num_columns(2).striped(true).spacing(SPACING);
            grid.min_row_height(PITCH - SPACING.y).show(ui, |ui| {
                let mut section = None;
                for row in rows {
                    if section != Some(row.section) {
                        section = Some(row.section);
                        across(ui, RichText::new(row.section.words().get()).size(13.0).strong());
                        ui.end_row();
                    }
                    let between = row.between_words();
                    let spread = if between.is_empty() { String::new() } else { say::between_is(&between) };
                    let name = Label::new(text(row.name.clone(), palette.ink));
                    let name = if wide {
                        ui.add(name.extend())
                    } else {
                        // A name that is cut can be read in its tooltip, a value could not.
                        let size = vec2(rect.width() - VALUES, PITCH - SPACING.y);
                        ui.allocate_ui(size, |ui| ui.add(name.truncate())).inner
                    };
                    name.on_hover_text(row.tip);
                    let value = ui.add(Label::new(text(row.value_words(), palette.ink).strong()).extend());
                    value.on_hover_text(format!("{}\n{spread}", say::ERROR_TIP).trim_end());
                    if wide {
                        let between = Label::new(text(between, palette.weak)).extend();
                        ui.add(between).on_hover_text(say::BETWEEN_TIP);
                    }
                    let compliance = text(row.compliance.clone(), palette.weak);
                    if wide && !row.compliance.is_empty() {
                        ui.add(Label::new(compliance).extend());
                    } else if !row.compliance.is_empty() {
                        ui.end_row();
                        across(ui, compliance);
                    }
                    ui.end_row();
                }
            });
        });
    });
}

/// Returns the figures as CSV: section, name, value, error, lowest and highest value of the sensor points, unit, and
/// comparison with limits. Shares are given as 0 … 1.
pub(super) fn csv(rows: &[Row]) -> String {
    let quoted = crate::texts::csv_cell;
    let mut out = String::from("section,figure,value,error,lowest,highest,unit,said\n");
    for row in rows {
        let [low, high] = row.between.map_or_else(Default::default, |ends| ends.map(|end| end.to_string()));
        let unit = if row.unit == "%" { "" } else { row.unit };
        // Writing to a String cannot fail.
        let _ = writeln!(
            out,
            "{},{},{},{},{low},{high},{unit},{}",
            quoted(row.section.words().get()),
            quoted(&row.name),
            row.value,
            row.error,
            quoted(&row.compliance)
        );
    }
    out
}
