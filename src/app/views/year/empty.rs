//! The year tile before there is a result: an explanation, the choice of the weather data, and the button that computes
//! the annual simulation.

use super::input::{Action, Input};
use super::parts::{GAP, progress, weak};
use crate::study::weather::{YEARS, words};
use crate::texts::year as say;
use egui::{Align, Button, ComboBox, Label, Layout, Rect, RichText, ScrollArea, Ui, UiBuilder};

/// Draws the content of the year tile before there is a result.
pub(super) fn show(ui: &mut Ui, rect: Rect, input: &Input<'_>, out: &mut Vec<Action>) {
    let layout = Layout::top_down(Align::Min);
    ui.scope_builder(UiBuilder::new().max_rect(rect.shrink2(GAP)).layout(layout).id_salt("empty"), |ui| {
        ScrollArea::vertical().id_salt("empty").auto_shrink([false, false]).show(ui, |ui| {
            if let Some(error) = input.error {
                let colour = ui.visuals().error_fg_color;
                ui.add(Label::new(RichText::new(error).size(13.0).color(colour)).wrap());
            }
            ui.add(Label::new(RichText::new(say::INVITATION.get()).size(13.0)).wrap());
            match input.running {
                Some(share) => progress(ui, share, out),
                None => ways(ui, input, out),
            }
        });
    });
}

/// Draws the button that computes the annual simulation, and the choice of the weather data.
fn ways(ui: &mut Ui, input: &Input<'_>, out: &mut Vec<Action>) {
    ui.horizontal_wrapped(|ui| {
        let button = Button::new(RichText::new(say::COMPUTE.get()).strong());
        if ui.add(button).on_hover_text(say::COMPUTE_TIP).clicked() {
            out.push(Action::Compute);
        }
        let own = input.weather.display().to_string();
        let combo = ComboBox::from_id_salt("weather").width(170.0).truncate().selected_text(own);
        let combo = combo.show_ui(ui, |ui| {
            for year in &YEARS {
                let name = year.name();
                if ui.selectable_label(input.weather == name, words(year)).clicked() {
                    out.push(Action::Weather(name));
                }
            }
            if ui.selectable_label(false, say::WEATHER_FILE).clicked() {
                out.push(Action::Open);
            }
        });
        combo.response.on_hover_text(say::WEATHER_TIP).accessible_name(say::WEATHER.get());
    });
    let built_in = YEARS.iter().find(|year| input.weather == year.name());
    weak(ui, built_in.map_or("", words));
}
