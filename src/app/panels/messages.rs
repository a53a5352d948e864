//! Messages of the window: above the status line for the time it takes to read them, and in a list for later.

use crate::app::command::Command;
use crate::app::display::theme::{self, Palette};
use crate::app::shell::messages::{Message, Messages, Weight};
use crate::texts::shell;
use egui::{Align2, Area, Color32, Id, Label, Order, Pos2, RichText, Sense, Ui};
use std::time::Duration;

/// Maximum number of messages shown at the same time; older ones are found in the list.
const MOST: usize = 4;
/// Maximum width of a message's text. \[points\]
const WIDTH: f32 = 420.0;

const fn colour(palette: &Palette, weight: Weight) -> Color32 {
    match weight {
        Weight::Info => palette.accent,
        Weight::Success => palette.good,
        Weight::Warning => palette.warning,
        Weight::Error => palette.error,
    }
}

/// Draws the current messages one above another. `corner`: lower right corner of the available space.
pub(super) fn show(ui: &Ui, messages: &mut Messages, corner: Pos2, commands: &mut Vec<Command>) {
    if messages.shown().next().is_none() {
        return;
    }
    let palette = theme::palette(ui);
    let list: Vec<&Message> = messages.shown().rev().take(MOST).collect();
    let mut held = None;
    let area = Area::new(Id::unique("messages")).order(Order::Foreground).pivot(Align2::RIGHT_BOTTOM);
    area.fixed_pos(corner).constrain(true).show(ui.ctx(), |ui| {
        ui.set_max_width(WIDTH);
        for message in list.into_iter().rev() {
            let frame = egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.set_width(WIDTH - 24.0);
                let row = ui.horizontal_top(|ui| {
                    ui.colored_label(colour(palette, message.weight), message.weight.word());
                    ui.add(Label::new(&message.text).wrap().selectable(false));
                });
                copy_report(ui, message, commands);
                row.response.rect
            });
            // A click on the message that removes it must not lie over its button.
            let place = if message.report.is_some() { frame.inner } else { frame.response.rect };
            let response = ui.interact(place, Id::unique(("message", message.id)), Sense::click());
            let label = shell::dismiss(&message.text);
            response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, &label));
            if response.hovered() || (message.report.is_some() && frame.response.contains_pointer()) {
                held = Some(message.id);
            }
            if response.on_hover_cursor(egui::CursorIcon::PointingHand).clicked() {
                commands.push(Command::Dismiss(Some(message.id)));
            }
        }
    });
    messages.pass_to(ui.input(|input| input.time), held);
    ui.ctx().request_repaint_after(Duration::from_millis(250));
}

/// Draws the button that copies the error report of a message, if it has one.
fn copy_report(ui: &mut Ui, message: &Message, commands: &mut Vec<Command>) {
    if let Some(report) = &message.report
        && ui.button(shell::COPY_REPORT).on_hover_text(shell::COPY_REPORT_TIP).clicked()
    {
        commands.push(Command::CopyReport(report.clone()));
    }
}

/// Draws the list of all messages, the newest at the top.
pub(super) fn list(ui: &mut Ui, messages: &Messages, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    if messages.is_empty() {
        ui.label(shell::NO_MESSAGES);
        return;
    }
    if ui.button(shell::FORGET_ALL).on_hover_text(shell::FORGET_ALL_TIP).clicked() {
        commands.push(Command::ForgetMessages);
    }
    for message in messages.all().rev() {
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            ui.weak(&message.at);
            ui.label(RichText::new(message.weight.word().get()).color(colour(palette, message.weight)));
        });
        ui.add(Label::new(&message.text).wrap().selectable(true));
        copy_report(ui, message, commands);
    }
}
