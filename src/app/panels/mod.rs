//! Panels round the tiles: catalogue, scene, menus, status line, side panels. Each reads the state of the window and
//! returns commands.

mod about;
pub mod bench;
mod catalogue;
mod export;
mod fields;
mod goniophotometer;
mod import;
mod menu;
mod messages;
mod palette;
mod product;
mod scene;
mod sets;
mod sheets;
mod status;
mod tour;

use super::command::Command;
use super::compare::panel as compare;
use super::state::Sheet;
use super::window::App;
use crate::app::display::theme;

/// Width of a window below which there is no room for catalogue, tile area and side panel together. \[points\]
const TIGHT: f32 = 1150.0;
/// Minimum width that a side panel leaves to the tile area. \[points\]
const LEAST_BENCH: f32 = 360.0;

/// Returns the range of widths to which a side panel can be resized \[points\]: from `least` to the width that leaves
/// the tile area its minimum.
fn widths(ui: &egui::Ui, least: f32) -> std::ops::RangeInclusive<f32> {
    least..=(ui.available_width() - LEAST_BENCH).max(least)
}

/// Draws the whole window. Returns the commands that the user gave in this frame.
pub fn show(ui: &mut egui::Ui, app: &mut App) -> Vec<Command> {
    let mut commands = Vec::new();
    let bar = theme::bar_frame(ui);
    let menus =
        egui::Panel::top("menu").frame(bar).show(ui, |ui| menu::show(ui, &app.shell.state, &mut commands)).inner;
    let mut places = tour::Places { menus, ..tour::Places::default() };
    if app.tour.is_shown() {
        egui::Panel::top("tour").frame(bar).show(ui, |ui| tour::show(ui, app, &mut commands));
    }
    if !app.shell.state.document.scene.compare.is_empty() {
        egui::Panel::top("comparison")
            .frame(bar)
            .show(ui, |ui| compare::comparison_line(ui, &app.shell.state, &mut commands));
    }
    let status = egui::Panel::bottom("status").frame(bar).show(ui, |ui| status::show(ui, app, &mut commands));
    // Messages stand above the status line, never over it.
    let corner = status.response.rect.right_top() - egui::vec2(8.0, 8.0);
    let side = theme::panel_frame(ui);
    // A sheet in a small window takes the catalogue's place too, as it takes the scene's: three narrow tiles side by
    // side would leave nothing to read. Who searches wants the list back.
    let tight = app.shell.state.sheet.is_some() && ui.available_width() < TIGHT;
    if tight && app.shell.state.focus_search {
        commands.push(Command::Sheet(None));
    }
    if app.shell.state.settings.catalogue_open && !tight {
        let catalogue = egui::Panel::left("catalogue")
            .frame(side)
            .resizable(true)
            .default_size(250.0)
            .size_range(widths(ui, 240.0))
            .show(ui, |ui| {
                catalogue::show(ui, &mut app.shell.state, (&mut app.states_view, &mut app.gallery), &mut commands);
            });
        places.catalogue = Some(catalogue.response.rect);
    }
    // The goniophotometer needs the room of the tile area; the scene's sun continues to light its drawing. So does the
    // table of an import.
    let wide = app.shell.state.sheet.filter(|sheet| matches!(sheet, Sheet::Goniophotometer | Sheet::Import));
    let room_for_scene = app.shell.state.sheet.is_none()
        || (app.shell.state.sheet == Some(Sheet::Goniophotometer) && ui.available_width() > 900.0);
    // A sheet takes the scene's place: beside both the tiles would be too narrow to read.
    if app.shell.state.settings.scene_open && room_for_scene {
        egui::Panel::right("scene").frame(side).default_size(250.0).size_range(widths(ui, 250.0)).show(ui, |ui| {
            let weather = scene::Weather { calendar: &app.shell.results.weather, view: &mut app.weather_view };
            scene::show(ui, &app.shell.state, weather, &app.shell.results.obstructions, &mut commands);
        });
    }
    if let Some(sheet) = app.shell.state.sheet.filter(|_| wide.is_none()) {
        egui::Panel::right("sheet")
            .frame(side)
            .default_size(330.0)
            .size_range(widths(ui, 280.0))
            .show(ui, |ui| sheets::show(ui, app, sheet, &mut commands));
    }
    let ground = egui::Frame::new().fill(theme::palette(ui).ground).inner_margin(theme::TILE_GAP);
    let centre = egui::CentralPanel::default();
    if let Some(sheet) = wide {
        centre.frame(side).show(ui, |ui| sheets::show(ui, app, sheet, &mut commands));
    } else if app.shell.state.compare.open {
        centre.frame(ground).show(ui, |ui| compare::show(ui, &app.shell.state, &mut app.compare, &mut commands));
    } else {
        let from = commands.len();
        centre.frame(ground).show(ui, |ui| bench::show(ui, app, &mut commands));
        if let Some(place) = app.shell.state.compare.swapped {
            app.compare.retarget(place, &app.shell.state.document, from, &mut commands);
        }
    }
    tour::ring(ui, app, &places);
    palette::show(ui, app, &mut commands);
    messages::show(ui, &mut app.shell.toasts, corner, &mut commands);
    commands
}
