//! The command palette: typed words narrow the list, arrow keys choose a row, Enter executes it.

use crate::app::command::Command;
use crate::app::palette::Row;
use crate::app::window::App;
use crate::texts::shell;
use egui::{Align2, Area, Button, Id, Key, Modifiers, Order, Ui};

/// Width of the command palette. \[points\]
const WIDTH: f32 = 420.0;

/// Draws the command palette if it is open.
pub fn show(ui: &mut Ui, app: &App, commands: &mut Vec<Command>) {
    let Some(words) = &app.shell.state.palette else { return };
    let mut text = words.clone();
    let area = Area::new(Id::unique("palette")).order(Order::Foreground).anchor(Align2::CENTER_TOP, [0.0, 60.0]);
    let inner = area.show(ui.ctx(), |ui| {
        egui::Frame::popup(ui.style()).show(ui, |ui| list(ui, app, &mut text, commands));
    });
    // A command that was entered in the same frame has closed it already.
    if text != *words && !commands.contains(&Command::Palette) {
        commands.push(Command::EditPalette(text));
    }
    // The command opens what is closed: sent twice in a frame, the palette would stay. A key or a click of the frame
    // that opened it was meant for something else.
    let before = app.opened.palette_before(ui.ctx().cumulative_frame_nr());
    let escaped = ui.input(|input| input.key_pressed(Key::Escape));
    if before && (escaped || inner.response.clicked_elsewhere()) && !commands.contains(&Command::Palette) {
        commands.push(Command::Palette);
    }
}

/// Draws the text field and the list of rows (commands, states, products) that match its text.
fn list(ui: &mut Ui, app: &App, text: &mut String, commands: &mut Vec<Command>) {
    ui.set_width(WIDTH);
    // Up and down belong to the list; the field would take them.
    let step = ui.input_mut(|input| {
        let mut count = |key| input.count_and_consume_key(Modifiers::NONE, key) as isize;
        count(Key::ArrowDown) - count(Key::ArrowUp)
    });
    let field = ui.add(egui::TextEdit::singleline(text).hint_text(shell::TYPE_A_COMMAND).desired_width(WIDTH));
    field.widget_info(|| {
        let mut info = egui::WidgetInfo::labeled(egui::accesskit::Role::TextInput, true, shell::COMMAND.get());
        info.current_text_value = Some(text.clone());
        info
    });
    // The keyboard stays in the field wherever the pointer is; but where Enter has just given it up, that must be seen
    // below.
    if !field.has_focus() && !field.lost_focus() {
        field.request_focus();
    }
    // Typed in this frame and entered in it: what the words fit now counts.
    let list = app.palette.rows(&app.shell.state, text);
    let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    let changed = field.changed();
    let row = if changed { 0 } else { app.palette.row().saturating_add_signed(step) };
    let row = row.min(list.len().saturating_sub(1));
    if row != app.palette.row() && !changed {
        commands.push(Command::PaletteRow(row));
    }
    if list.is_empty() {
        ui.weak(shell::NO_COMMAND);
    }
    for (number, one) in list.into_iter().enumerate() {
        let Row { command, text, tip, keys } = one;
        let button = Button::new(&text).truncate().selected(number == row).min_size(egui::vec2(WIDTH, 22.0));
        let button = if let Some(keys) = keys { button.shortcut_text(keys) } else { button };
        let response = ui.add(button);
        let response = if tip.is_empty() { response } else { response.on_hover_text(tip) };
        if response.clicked() || (number == row && entered) {
            commands.push(Command::Palette);
            commands.push(command);
        }
    }
}
