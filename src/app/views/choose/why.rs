//! The selected product of a ranking: buttons to put it into the room or the comparison, and the explanation of its
//! difference in score from another product as a sum of terms.

use super::input::{Action, Input};
use super::words;
use crate::app::paint::palette::Palette;
use crate::study::rank::{Entry, Look, Shortlist};
use crate::texts::choose as say;
use egui::{Button, ComboBox, FontId, Label, Rect, RichText, Sense, Ui, UiBuilder};

/// Minimum contribution to the difference in score for which a term of the explanation is shown.
const LEAST: f64 = 5e-4;

/// Draws buttons and explanation for the selected product.
pub(super) fn show(ui: &mut Ui, rect: Rect, input: &Input<'_>, list: &Shortlist, out: &mut Vec<Action>) {
    let chosen = input.look.product.as_ref().and_then(|product| list.entry(product));
    let palette = Palette::of(ui.visuals());
    ui.scope_builder(UiBuilder::new().max_rect(rect).id_salt("why"), |ui| {
        let Some(entry) = chosen else {
            ui.add(Label::new(RichText::new(say::CHOOSE_ONE.get()).size(13.0).color(palette.weak)).wrap());
            return;
        };
        ui.horizontal(|ui| buttons(ui, input, list, entry, out));
        lines(ui, &explanation(input, list, entry));
    });
}

/// Returns the lines that explain the rank of a product, each with whether it is drawn in the colour of secondary text.
fn explanation(input: &Input<'_>, list: &Shortlist, entry: &Entry) -> Vec<(String, bool)> {
    if let Some(reason) = &entry.excluded {
        return vec![(say::excluded_because(reason), false)];
    }
    let Some(reason) = input.reason else { return vec![(say::ONLY_ONE.into(), true)] };
    let mut all = vec![(format!("{}: {}", entry.name, words::head(list, reason)), false)];
    let significant = reason.terms.iter().filter(|term| term.score_difference.abs() >= LEAST);
    all.extend(significant.map(|term| (words::term(list, term), false)));
    if entry.coarse {
        all.push((say::COARSE_TIP.into(), true));
    }
    if !entry.approximate.is_empty() {
        all.push((say::approximate_since(entry.approximate.join("; ")), true));
    }
    all
}

/// Draws as many complete lines as there is room for; the tooltip shows all of them.
fn lines(ui: &mut Ui, all: &[(String, bool)]) {
    let palette = Palette::of(ui.visuals());
    let full = ui.available_rect_before_wrap();
    for (words, weak) in all {
        let colour = if *weak { palette.weak } else { palette.ink };
        let text = RichText::new(words).size(13.0).color(colour);
        let room = ui.available_height();
        let galley = ui.painter().layout(words.clone(), FontId::proportional(13.0), colour, full.width());
        if galley.size().y > room {
            break;
        }
        ui.add(Label::new(text).wrap());
    }
    let whole: Vec<&str> = all.iter().map(|(words, _)| words.as_str()).collect();
    ui.interact(full, ui.scope_id().with("all of why"), Sense::HOVER).on_hover_text(whole.join("\n"));
}

/// Draws the buttons for the selected product, and the choice of the product it is compared with.
fn buttons(ui: &mut Ui, input: &Input<'_>, list: &Shortlist, entry: &Entry, out: &mut Vec<Action>) {
    let enabled = entry.excluded.is_none();
    let product = || entry.product.clone();
    if ui.add_enabled(enabled, Button::new(say::INTO_ROOM.get())).on_hover_text(say::INTO_ROOM_TIP).clicked() {
        out.push(Action::IntoRoom(product()));
    }
    if ui
        .add_enabled(enabled, Button::new(say::ADD_TO_COMPARISON.get()))
        .on_hover_text(say::ADD_TO_COMPARISON_TIP)
        .clicked()
    {
        out.push(Action::Compare(product()));
    }
    if !enabled || ui.available_width() < 150.0 {
        return;
    }
    let mut against = input.look.against.clone().filter(|other| list.entry(other).is_some());
    let name = |key: &Option<String>| match key.as_ref().and_then(|key| list.entry(key)) {
        Some(other) => other.name.clone(),
        None => say::THE_BEST.into(),
    };
    ui.label(RichText::new(say::AGAINST.get()).size(13.0));
    let width = (ui.available_width() - 30.0).clamp(60.0, 220.0);
    let combo = ComboBox::from_id_salt("against").width(width).truncate().selected_text(name(&against));
    let combo = combo.show_ui(ui, |ui| {
        ui.selectable_value(&mut against, None, say::THE_BEST.get());
        for other in list.entries.iter().filter(|one| one.excluded.is_none() && one.product != entry.product) {
            ui.selectable_value(&mut against, Some(other.product.clone()), &other.name);
        }
    });
    combo.response.on_hover_text(say::AGAINST_TIP).accessible_name(say::AGAINST.get());
    if against != input.look.against {
        out.push(Action::Look(Box::new(Look { against, ..input.look.clone() })));
    }
}
