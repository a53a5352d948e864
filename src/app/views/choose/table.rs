//! Products in rows: rank, name, worth as a bar with its error, every objective; under them why the chosen one stands where
//! it does, and the way into the room.

use super::input::{Action, ChooseRow, ChooseRows, rank_words};
use crate::app::paint::palette::Palette;
use crate::drawing::ticks::number;
use crate::texts::{choose as say, fixed};
use egui::{Button, Color32, Grid, Label, Rect, RichText, ScrollArea, Sense, Stroke, Ui, UiBuilder, pos2, vec2};

/// Height of a row. \[points\]
const ROW: f32 = 22.0;
/// Width of the bar of what a product is worth. \[points\]
const BAR: f32 = 110.0;
/// Height of what is told of the chosen one. \[points\]
const WHY: f32 = 84.0;

fn value_words(unit: &str, (value, error): (f64, f64)) -> String {
    if unit == "%" {
        format!("{} ± {} %", fixed(100.0 * value, 1), fixed(100.0 * error, 1))
    } else {
        format!("{} ± {} {unit}", number(value, 3), number(error, 1)).trim_end().to_owned()
    }
}

pub(super) fn show(
    ui: &mut Ui,
    (rect, chosen): (Rect, &mut Option<String>),
    rows: &ChooseRows,
    shown: &[&ChooseRow],
    in_room: &str,
    out: &mut Vec<Action>,
) -> String {
    let (upper, lower) = rect.split_top_bottom_at_y((rect.bottom() - WHY).max(rect.top() + 2.0 * ROW));
    ui.scope_builder(UiBuilder::new().max_rect(upper).id_salt("table"), |ui| {
        ScrollArea::both()
            .id_salt("ranks")
            .auto_shrink([false, false])
            .show(ui, |ui| table(ui, chosen, rows, shown, in_room, out));
    });
    let told = shown.iter().find(|row| Some(&row.product) == chosen.as_ref()).or(shown.first());
    if let Some(row) = told {
        ui.scope_builder(UiBuilder::new().max_rect(lower).id_salt("why"), |ui| why(ui, row, out));
    }
    say::shown(shown.len(), rows.rows.len())
}

fn table(
    ui: &mut Ui,
    chosen: &mut Option<String>,
    rows: &ChooseRows,
    shown: &[&ChooseRow],
    in_room: &str,
    out: &mut Vec<Action>,
) {
    let palette = Palette::of(ui.visuals());
    let text = |words: String, colour: Color32| Label::new(RichText::new(words).size(13.0).color(colour)).extend();
    Grid::new("ranks").striped(true).min_row_height(ROW).spacing(vec2(10.0, 2.0)).show(ui, |ui| {
        for word in [say::RANK, say::PRODUCT, say::WORTH] {
            ui.add(text(word.to_string(), palette.weak)).on_hover_text(say::WORTH_TIP);
        }
        for one in &rows.objectives {
            let tip = if one.less_is_better { say::LESS_IS_BETTER } else { say::MORE_IS_BETTER };
            ui.add(text(one.name.clone(), palette.weak)).on_hover_text(tip);
        }
        ui.end_row();
        for row in shown {
            let colour = if row.excluded.is_some() { palette.weak } else { palette.ink };
            let rank = if row.excluded.is_some() { "–".to_owned() } else { rank_words(row.ranks) };
            ui.add(text(rank, colour));
            let marks = [(row.front, "◆ "), (row.approximate, "≈ "), (row.product == in_room, "⌂ ")];
            let marks: String = marks.into_iter().filter(|(is, _)| *is).map(|(_, mark)| mark).collect();
            let name = RichText::new(format!("{marks}{}", row.label)).size(13.0).color(colour);
            let name = ui.selectable_label(Some(&row.product) == chosen.as_ref(), name).on_hover_text(say::MARKS_TIP);
            if name.clicked() {
                *chosen = Some(row.product.clone());
            }
            if name.double_clicked() && row.excluded.is_none() {
                out.push(Action::IntoRoom(row.product.clone()));
            }
            bar(ui, row, &palette);
            for (k, one) in rows.objectives.iter().enumerate() {
                let words = row.values.get(k).map_or_else(String::new, |value| value_words(one.unit, *value));
                ui.add(text(words, colour));
            }
            ui.end_row();
        }
    });
}

/// What a product is worth as a bar, its error as a line at the end.
fn bar(ui: &mut Ui, row: &ChooseRow, palette: &Palette) {
    let (rect, response) = ui.allocate_exact_size(vec2(BAR, ROW - 6.0), Sense::hover());
    if row.excluded.is_some() {
        return;
    }
    let (utility, error) = row.utility;
    let x = |share: f64| egui::lerp(rect.x_range(), share.clamp(0.0, 1.0) as f32);
    let y = rect.center().y;
    ui.painter().rect_filled(rect.with_max_x(x(utility)), 2, palette.first.gamma_multiply(0.6));
    let ends = [pos2(x(utility - error), y), pos2(x(utility + error), y)];
    ui.painter().line_segment(ends, Stroke::new(2.0, palette.ink));
    let words = say::worth(fixed(utility, 3), fixed(error, 3));
    crate::app::paint::tile::name(ui, &response, say::WORTH, &words);
    response.on_hover_text(words);
}

fn why(ui: &mut Ui, row: &ChooseRow, out: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let enabled = row.excluded.is_none();
        if ui.add_enabled(enabled, Button::new(say::INTO_ROOM.get())).on_hover_text(say::INTO_ROOM_TIP).clicked() {
            out.push(Action::IntoRoom(row.product.clone()));
        }
        if ui.add_enabled(enabled, Button::new(say::INTO_TRAY.get())).on_hover_text(say::INTO_TRAY_TIP).clicked() {
            out.push(Action::Compare(row.product.clone()));
        }
        ui.add(Label::new(RichText::new(&row.label).size(13.0).strong()).truncate());
    });
    let words = row.excluded.as_ref().map_or_else(|| row.why.clone(), say::excluded_because);
    ScrollArea::vertical().id_salt("why").auto_shrink([false, false]).show(ui, |ui| {
        ui.add(Label::new(RichText::new(words).size(13.0)).wrap());
    });
}
