//! The command palette: words narrow the list, Enter takes the first.

use super::fields::button;
use crate::app::command::Command;
use crate::app::offer::{Offer, listed};
use crate::app::state::State;
use egui::{Align2, Area, Id, Key, Order, Ui};

/// Rows shown at most.
const ROWS: usize = 12;

/// Draws it when it is open.
pub fn show(ui: &mut Ui, state: &State, commands: &mut Vec<Command>) {
    let Some(words) = &state.palette else { return };
    let mut text = words.clone();
    let area = Area::new(Id::unique("palette")).order(Order::Foreground).anchor(Align2::CENTER_TOP, [0.0, 60.0]);
    let inner = area.show(ui.ctx(), |ui| {
        egui::Frame::popup(ui.style()).show(ui, |ui| list(ui, &mut text, commands));
    });
    // A command that was entered in the same frame has closed it already.
    if text != *words && !commands.contains(&Command::Palette) {
        commands.push(Command::EditPalette(text));
    }
    // The command opens what is closed: sent twice in a frame, the palette would stay.
    let escaped = ui.input(|input| input.key_pressed(Key::Escape));
    if (escaped || inner.response.clicked_elsewhere()) && !commands.contains(&Command::Palette) {
        commands.push(Command::Palette);
    }
}

/// The field and the commands that have its words.
fn list(ui: &mut Ui, text: &mut String, commands: &mut Vec<Command>) {
    ui.set_width(420.0);
    let field = ui.add(egui::TextEdit::singleline(text).hint_text("Type a command").desired_width(420.0));
    field.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::TextInput, true, "Command"));
    // The words go on wherever the pointer is; but where Enter has just given the focus up, that must be seen below.
    if !field.has_focus() && !field.lost_focus() {
        field.request_focus();
    }
    let wanted: Vec<String> = text.split_whitespace().map(str::to_lowercase).collect();
    // The palette itself is left out: it would only close.
    let fits = |offer: &&Offer| {
        let name = offer.text.to_lowercase();
        offer.command != Command::Palette && wanted.iter().all(|word| name.contains(word))
    };
    let list: Vec<&Offer> = listed().filter(fits).take(ROWS).collect();
    let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    if list.is_empty() {
        ui.weak("No command has these words");
    }
    for (row, offer) in list.into_iter().enumerate() {
        let button = button(offer).selected(row == 0).min_size(egui::vec2(420.0, 22.0));
        if ui.add(button).on_hover_text(offer.tip).clicked() || (row == 0 && entered) {
            commands.push(Command::Palette);
            commands.push(offer.command.clone());
        }
    }
}
