//! The figures of a year as a table: value, error, spread over the sensors, what limits say; what each is, in its tip.

use super::parts::GAP;
use crate::app::paint::palette::Palette;
use crate::study::year::Row;
use crate::texts::year as say;
use egui::{Grid, Label, Rect, RichText, ScrollArea, Ui, UiBuilder};
use std::fmt::Write as _;

pub(super) fn show(ui: &mut Ui, rect: Rect, rows: &[Row]) {
    let palette = Palette::of(ui.visuals());
    let text = |words: String, colour| RichText::new(words).size(13.0).color(colour);
    ui.scope_builder(UiBuilder::new().max_rect(rect).id_salt("figures"), |ui| {
        ScrollArea::both().id_salt("figures").auto_shrink([false, false]).show(ui, |ui| {
            Grid::new("figures").num_columns(5).striped(true).spacing(GAP * 1.5).show(ui, |ui| {
                let mut section = None;
                for row in rows {
                    if section != Some(row.section) {
                        section = Some(row.section);
                        ui.label(RichText::new(row.section.words().get()).size(13.0).strong());
                        ui.end_row();
                    }
                    ui.add(Label::new(text(row.name.clone(), palette.ink)).extend()).on_hover_text(row.tip);
                    let value = Label::new(text(row.value_words(), palette.ink).strong()).extend();
                    ui.add(value).on_hover_text(row.tip);
                    ui.add(Label::new(text(row.error_words(), palette.weak)).extend()).on_hover_text(say::ERROR_TIP);
                    let spread = Label::new(text(row.between_words(), palette.weak)).extend();
                    ui.add(spread).on_hover_text(say::BETWEEN_TIP);
                    ui.add(Label::new(text(row.said.clone(), palette.ink)).extend());
                    ui.end_row();
                }
            });
        });
    });
}

/// Section, name, value, error, lowest and highest of the sensors, unit, what limits say. Shares are 0 … 1.
pub(super) fn csv(rows: &[Row]) -> String {
    let quoted = crate::app::paint::tile::csv_field;
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
            quoted(&row.said)
        );
    }
    out
}
