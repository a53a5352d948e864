//! The tour, an introduction to the window: a line under the menus with the current step, and a frame round the part of
//! the window that the step uses. It covers nothing.

use crate::app::command::Command;
use crate::app::display::theme;
use crate::app::tiles::{LID, ROOM, SKY};
use crate::app::tour::step::{Stop, TourAct};
use crate::app::window::App;
use crate::texts::commands::{COMPARE, FILE};
use crate::texts::{Text, shell};
use egui::{Id, Key, LayerId, Order, Rect, Stroke, StrokeKind, Ui};

/// Rectangles of parts of the window in this frame, which the tour marks.
#[derive(Default)]
pub struct Places {
    /// Rectangle of the catalogue panel, if it is open.
    pub catalogue: Option<Rect>,
    /// Title and rectangle of each menu in the menu bar.
    pub menus: Vec<(Text, Rect)>,
}

/// Draws the line of the tour, or of its offer.
pub fn show(ui: &mut Ui, app: &App, commands: &mut Vec<Command>) {
    let Some(stop) = app.tour.stop() else {
        ui.horizontal_wrapped(|ui| {
            ui.weak(shell::TOUR_OFFER);
            if ui.button(shell::TOUR_START).clicked() {
                commands.push(Command::Tour(TourAct::Start));
            }
            if ui.button(shell::TOUR_DECLINE).on_hover_text(shell::TOUR_DECLINE_TIP).clicked() {
                commands.push(Command::Tour(TourAct::Decline));
            }
        });
        return;
    };
    let number = Stop::ALL.iter().position(|one| *one == stop).unwrap_or(0) + 1;
    ui.horizontal_wrapped(|ui| {
        ui.strong(shell::tour_step(number, Stop::ALL.len()));
        ui.label(stop.words());
        if ui.button(shell::TOUR_LEAVE).on_hover_text(shell::TOUR_LEAVE_TIP).clicked() {
            commands.push(Command::Tour(TourAct::Leave));
        }
    });
    // What lies over the window takes the key first, and what is typed into.
    let free = !app.in_field
        && app.shell.state.sheet.is_none()
        && app.shell.state.palette.is_none()
        && !egui::Popup::is_any_open(ui.ctx());
    if free && ui.input(|input| input.key_pressed(Key::Escape)) {
        commands.push(Command::Tour(TourAct::Leave));
    }
}

/// Draws the frame round the part of the window that the current step uses, in front of everything else.
pub fn ring(ui: &Ui, app: &App, places: &Places) {
    let Some(stop) = app.tour.stop() else { return };
    let menu = |menu: Text| places.menus.iter().find(|(one, _)| *one == menu).map(|(_, rect)| *rect);
    let list: Vec<Rect> = match stop {
        Stop::Product => places.catalogue.into_iter().collect(),
        Stop::Sun => app.shell.bench.place_of(SKY).into_iter().collect(),
        Stop::Light => [LID, ROOM].into_iter().filter_map(|tile| app.shell.bench.place_of(tile)).collect(),
        Stop::Compare => menu(COMPARE).into_iter().collect(),
        Stop::Export => menu(FILE).into_iter().collect(),
    };
    let painter = ui.ctx().layer_painter(LayerId::new(Order::Middle, Id::unique("tour")));
    for rect in list {
        let stroke = Stroke::new(3.0, theme::palette(ui).accent);
        painter.rect_stroke(rect, 4.0, stroke, StrokeKind::Inside);
    }
}
