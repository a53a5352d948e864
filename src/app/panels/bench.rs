//! The bench: tiles where its layout has them, or one that fills it.

use crate::app::command::Command;
use crate::app::offer;
use crate::app::state::Tile;
use crate::app::theme::{self, TILE_GAP};
use crate::app::tiles::{TILES, TileInput};
use crate::app::window::App;
use egui::{Rect, Sense, Ui, UiBuilder, vec2};

/// Draws the bench.
pub fn show(ui: &mut Ui, app: &mut App, commands: &mut Vec<Command>) {
    let whole = ui.available_rect_before_wrap();
    let places = match app.state.maximised {
        Some(tile) => vec![(tile, whole)],
        None => app.bench.layout.places(whole, TILE_GAP),
    };
    for (tile, rect) in places {
        frame(ui, rect, tile, app, commands);
    }
}

/// A tile's ground; a double click on its head fills the bench with it, or shows all again.
fn frame(ui: &mut Ui, rect: Rect, tile: Tile, app: &mut App, commands: &mut Vec<Command>) {
    let palette = theme::palette(ui);
    ui.painter().rect(rect, 6, palette.surface, egui::Stroke::new(1.0, palette.line), egui::StrokeKind::Inside);
    let head = Rect::from_min_size(rect.min, vec2((rect.width() * 0.5).min(120.0), 26.0));
    let response = ui.interact(head, ui.scope_id().with(("tile", tile)), Sense::click());
    let response = response.on_hover_text(format!(
        "Double click: fill the bench, or show all tiles (keys 1–{} and 0). Right click: export, copy",
        TILES.len()
    ));
    response
        .widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, format!("Tile {}", tile.title)));
    response.context_menu(|ui| {
        for offer in [Command::ExportTile(tile), Command::CopyTile(tile)].iter().filter_map(offer::of) {
            if ui.button(&offer.text).on_hover_text(offer.tip).clicked() {
                commands.push(offer.command.clone());
                ui.close();
            }
        }
    });
    if response.double_clicked() {
        commands.push(Command::Maximise(if app.state.maximised.is_some() { None } else { Some(tile) }));
    }
    let (state, results) = app.compare.shown(&app.state, &app.results);
    let seen = TileInput {
        state,
        results,
        busy: &|lane| app.jobs.busy(lane),
        // The other one is drawn on the scales of the first: equal colours stay equal values.
        held: app.state.compare.swapped.is_some() || ui.input(|input| input.pointer.any_down()),
        numbers: app.export.wants_numbers(tile),
        scale: None,
    };
    let builder = UiBuilder::new().max_rect(rect.shrink(2.0)).id_salt(tile.title);
    let numbers = ui.scope_builder(builder, |ui| app.bench.show(ui, tile, &seen, commands)).inner;
    if let Some(text) = numbers {
        app.export.numbers(ui.ctx(), text);
    }
}
