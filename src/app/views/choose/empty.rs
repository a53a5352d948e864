//! The ranking tile before there is a ranking: an explanation, the choice of products, and the button that starts the
//! ranking.

use super::input::{Action, Input};
use super::objectives::range;
use super::words;
use crate::app::paint::palette::Palette;
use crate::study::rank::figure_words;
use crate::texts::choose as say;
use egui::{Align, Button, Label, Layout, ProgressBar, Rect, RichText, ScrollArea, Ui, UiBuilder, vec2};

/// Draws the content of the ranking tile before there is a ranking.
pub(super) fn show(ui: &mut Ui, rect: Rect, input: &Input<'_>, out: &mut Vec<Action>) {
    let layout = Layout::top_down(Align::Min);
    let weak = Palette::of(ui.visuals()).weak;
    ui.scope_builder(UiBuilder::new().max_rect(rect.shrink2(vec2(6.0, 4.0))).layout(layout).id_salt("empty"), |ui| {
        ScrollArea::vertical().id_salt("empty").auto_shrink([false, false]).show(ui, |ui| {
            if let Some(error) = input.error {
                let colour = ui.visuals().error_fg_color;
                ui.add(Label::new(RichText::new(error).size(13.0).color(colour)).wrap());
            }
            ui.add(Label::new(RichText::new(say::INVITATION.get()).size(13.0)).wrap());
            if input.running.is_some() {
                progress(ui, input, out);
                return;
            }
            let button = Button::new(RichText::new(say::RANK_CATALOGUE.get()).strong());
            if ui.add(button).on_hover_text(say::RANK_TIP).clicked() {
                out.push(Action::Rank);
            }
            range(ui, input, out);
            let names: Vec<String> = input.objectives.iter().map(|one| figure_words(&one.figure).0).collect();
            let text = say::would_count(names.join(" · "));
            ui.add(Label::new(RichText::new(text).size(13.0).color(weak)).wrap());
        });
    });
}

/// Draws the progress of a running ranking, and a button that stops it.
pub(super) fn progress(ui: &mut Ui, input: &Input<'_>, out: &mut Vec<Action>) {
    let Some(running) = &input.running else { return };
    ui.horizontal(|ui| {
        let width = (ui.available_width() - 90.0).max(40.0);
        let words = if running.all == 0 { say::PREPARING.into() } else { words::running(running) };
        ui.add(ProgressBar::new(running.share()).desired_width(width).text(words));
        if ui.button(say::STOP).on_hover_text(say::STOP_TIP).clicked() {
            out.push(Action::Stop);
        }
    });
}
