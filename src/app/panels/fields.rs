//! Fields and buttons that panels share.

use crate::app::offer::{Offer, key_words};
use egui::{Button, DragValue, Ui};
use std::ops::RangeInclusive;

/// A labelled number with unit and range.
pub fn number(ui: &mut Ui, label: &str, unit: &str, value: &mut f64, range: RangeInclusive<f64>, decimals: usize) {
    let (low, high) = (*range.start(), *range.end());
    let speed = ((high - low) / 400.0).max(0.1_f64.powi(decimals as i32));
    ui.horizontal(|ui| {
        let name = ui.label(label);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let drag = DragValue::new(value).range(range).speed(speed).fixed_decimals(decimals).suffix(unit);
            ui.add(drag).labelled_by(name.id).on_hover_text(format!("{low} to {high}{unit}; drag, or click and type"));
        });
    });
}

/// The same of a number that the scene may lack: then it becomes `start`.
pub fn optional(ui: &mut Ui, label: &str, unit: &str, value: &mut Option<f64>, start: f64, range: RangeInclusive<f64>) {
    let mut number_value = value.unwrap_or(start);
    let before = number_value;
    number(ui, label, unit, &mut number_value, range, 2);
    if number_value != before || value.is_none() {
        *value = Some(number_value);
    }
}

/// A button with the words and keys of what it does.
pub fn button(offer: &Offer) -> Button<'_> {
    let button = Button::new(&offer.text);
    match &offer.keys {
        Some(keys) => button.shortcut_text(key_words(keys)),
        None => button,
    }
}
