//! Page of the objectives of the ranking: their weights and scale limits, adding of objectives, and the choice of the
//! products to rank.

use super::input::{Action, Input};
use super::words;
use crate::app::paint::palette::Palette;
use crate::study::rank::{Look, figure_words};
use crate::study::rank_keys::{BetterKey, ObjectiveKeys};
use crate::texts::choose as say;
use egui::{Checkbox, ComboBox, DragValue, Label, Rect, RichText, ScrollArea, Slider, SliderClamping, Ui, UiBuilder};

/// Minimum and maximum weight of an objective that the slider can set.
const WEIGHTS: [f64; 2] = [0.1, 5.0];

/// Draws the page of the objectives.
pub(super) fn show(ui: &mut Ui, rect: Rect, input: &Input<'_>, out: &mut Vec<Action>) {
    let palette = Palette::of(ui.visuals());
    ui.scope_builder(UiBuilder::new().max_rect(rect).id_salt("objectives"), |ui| {
        ScrollArea::vertical().id_salt("objectives").auto_shrink([false, false]).show(ui, |ui| {
            let mut list = input.objectives.to_vec();
            let mut gone = None;
            for (k, one) in list.iter_mut().enumerate() {
                ui.push_id(one.figure.clone(), |ui| {
                    if objective(ui, one, input.objectives.len() > 1) {
                        gone = Some(k);
                    }
                });
            }
            if let Some(k) = gone {
                list.remove(k);
                out.push(Action::Objectives(list, true));
            } else if list != input.objectives {
                out.push(Action::Objectives(list, false));
            }
            more(ui, input, out);
            ui.separator();
            range(ui, input, out);
            let weather = say::weather_is(input.weather.display());
            ui.add(Label::new(RichText::new(weather).size(13.0).color(palette.weak)).wrap());
        });
    });
}

/// Draws one objective in two lines: name and unit, weight and scale limits. `may_go`: whether it may be removed.
/// Returns `true` if the user removes it.
fn objective(ui: &mut Ui, one: &mut ObjectiveKeys, may_go: bool) -> bool {
    let (name, unit) = figure_words(&one.figure);
    let mut goes = false;
    ui.horizontal_wrapped(|ui| {
        let head = RichText::new(words::heading(&one.figure)).size(13.0).strong();
        ui.add(Label::new(head)).on_hover_text(&one.figure);
        if may_go {
            let button = ui.small_button("×").on_hover_text(say::LEAVE_OUT_TIP);
            button
                .widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, say::leave_out(&name)));
            goes = button.clicked();
        }
    });
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().slider_width = 70.0;
        let range = WEIGHTS[0].min(one.weight)..=WEIGHTS[1].max(one.weight);
        let slider =
            ui.add(Slider::new(&mut one.weight, range).max_decimals(1).step_by(0.1).clamping(SliderClamping::Edits));
        slider.on_hover_text(say::WEIGHT_TIP).accessible_name(say::weight_of(&name));
        let scale = if unit == "%" { 100.0 } else { 1.0 };
        let suffix = if unit == "%" { " %" } else { "" };
        let speed = (0.01 * scale * (one.worst - one.best).abs()).max(1e-3);
        // A scale limit never passes the other one.
        let separation = 0.01 * (one.worst - one.best).abs().max(1e-6);
        let (low, high) = match one.better {
            BetterKey::Less => (f64::NEG_INFINITY..=one.worst - separation, one.best + separation..=f64::INFINITY),
            BetterKey::More => (one.worst + separation..=f64::INFINITY, f64::NEG_INFINITY..=one.best - separation),
        };
        for (value, range, word, tip, named) in [
            (&mut one.worst, high, say::WORST, say::WORST_TIP, say::worst_of(&name)),
            (&mut one.best, low, say::BEST, say::BEST_TIP, say::best_of(&name)),
        ] {
            ui.add(Label::new(RichText::new(word.get()).size(13.0)).extend());
            let mut shown = scale * *value;
            let range = scale * range.start()..=scale * range.end();
            let drag = DragValue::new(&mut shown).range(range).speed(speed).max_decimals(2).suffix(suffix);
            let drag = ui.add(drag);
            if drag.changed() {
                *value = shown / scale;
            }
            drag.on_hover_text(tip).accessible_name(named);
        }
    });
    goes
}

/// Draws the menu of the figures that can be added as objectives.
fn more(ui: &mut Ui, input: &Input<'_>, out: &mut Vec<Action>) {
    if input.offers.is_empty() {
        return;
    }
    let combo = ComboBox::from_id_salt("more").width(180.0).selected_text(say::ADD_OBJECTIVE.get());
    let combo = combo.show_ui(ui, |ui| {
        for offer in input.offers {
            let tip = if offer.known { say::FIGURE_KNOWN } else { say::FIGURE_TO_COMPUTE };
            let words = if offer.known { offer.name.clone() } else { say::to_compute(&offer.name) };
            if ui.selectable_label(false, words).on_hover_text(tip).clicked() {
                let mut list = input.objectives.to_vec();
                list.push(offer.keys.clone());
                out.push(Action::Objectives(list, true));
            }
        }
    });
    combo.response.on_hover_text(say::ADD_OBJECTIVE_TIP).accessible_name(say::ADD_OBJECTIVE.get());
}

/// Draws the choices of the products that are ranked and of the aperture they are ranked for.
pub(super) fn range(ui: &mut Ui, input: &Input<'_>, out: &mut Vec<Action>) {
    let mut look = Look::clone(input.look);
    ui.horizontal_wrapped(|ui| {
        if input.search.is_some() || look.in_search {
            let words = input.search.map_or_else(|| say::IN_SEARCH.into(), say::in_search);
            ui.add(Checkbox::new(&mut look.in_search, words)).on_hover_text(say::IN_SEARCH_TIP);
        }
        if input.apertures > 1 {
            let words = |place: Option<usize>| match place {
                Some(place) => say::aperture(place + 1),
                None => say::ALL_APERTURES.into(),
            };
            let combo = ComboBox::from_id_salt("aperture").width(120.0).selected_text(words(look.aperture));
            let combo = combo.show_ui(ui, |ui| {
                for place in std::iter::once(None).chain((0..input.apertures).map(Some)) {
                    ui.selectable_value(&mut look.aperture, place, words(place));
                }
            });
            combo.response.on_hover_text(say::APERTURE_TIP).accessible_name(say::APERTURE.get());
        }
    });
    if look != *input.look {
        out.push(Action::Look(Box::new(look)));
    }
}
