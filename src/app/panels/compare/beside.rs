//! The same tile for each candidate, all on one scale.

use super::places::{missing, places, tile};
use crate::app::command::Command;
use crate::app::compare::Part;
use crate::app::compare_columns::{Column, Columns};
use crate::app::jobs::Lane;
use crate::app::state::Tile;
use crate::app::theme;
use crate::app::tiles::TileInput;
use crate::app::window::App;
use crate::study::comparison::scales;
use egui::{Label, RichText, Stroke, StrokeKind, Ui, UiBuilder, vec2};

/// Height of a candidate's name. \[points\]
const NAME: f32 = 24.0;

/// Draws the tiles.
pub(super) fn show(ui: &mut Ui, app: &mut App, commands: &mut Vec<Command>) {
    let Some(tile) = tile(&app.state) else { return };
    let key = app.compare.key(tile.title);
    let Columns { list, scale: known, .. } = &mut app.compare;
    let scale = *known.get(key, || scale(list, tile));
    let held = ui.input(|input| input.pointer.any_down());
    let stopped = app.compare.stopped;
    let names = app.compare.names();
    let rects = places(ui.available_rect_before_wrap(), names.len());
    for (place, (rect, name)) in rects.into_iter().zip(&names).enumerate() {
        let from = commands.len();
        let column = &mut app.compare.list[place];
        let palette = theme::palette(ui);
        ui.painter().rect(rect, 6, palette.surface, Stroke::new(1.0, palette.line), StrokeKind::Inside);
        let (head, body) = rect.shrink(3.0).split_top_bottom_at_y(rect.top() + NAME);
        let builder = UiBuilder::new().max_rect(head.shrink2(vec2(5.0, 0.0))).id_salt(("name", column.id));
        ui.scope_builder(builder, |ui| ui.add(Label::new(RichText::new(name).strong()).truncate()));
        let builder = UiBuilder::new().max_rect(body).id_salt(("candidate", column.id));
        ui.scope_builder(builder, |ui| one(ui, column, tile, (scale, held, stopped), commands));
        app.retarget(place, from, commands);
    }
}

fn one(
    ui: &mut Ui,
    column: &mut Column,
    tile: Tile,
    (scale, held, stopped): (Option<[f64; 2]>, bool, bool),
    commands: &mut Vec<Command>,
) {
    let lacks = [Part::Shelf, Part::Lid, Part::Room, Part::Year].map(|part| !stopped && column.lacks(part));
    let busy = |lane: Lane| match lane {
        Lane::Scene => lacks[0],
        Lane::Lid => lacks[1],
        Lane::Room => lacks[2],
        Lane::Year => lacks[3],
        _ => false,
    };
    if let Some(error) = column.error().filter(|_| column.state.dataset.value.is_none()) {
        ui.colored_label(theme::palette(ui).error, error);
        return;
    }
    if column.state.dataset.value.is_none() {
        ui.centered_and_justified(|ui| ui.label(missing(column)));
        return;
    }
    let Column { state, results, bench, .. } = column;
    let seen = TileInput { state, results, busy: &busy, held, numbers: false, scale };
    bench.show(ui, tile, &seen, commands);
}

/// Lowest and highest value of a scale that holds all candidates; `None` for tiles whose scales are fixed, and before there
/// is anything.
fn scale(columns: &[Column], tile: Tile) -> Option<[f64; 2]> {
    let data =
        || columns.iter().filter_map(|column| Some((column, column.state.dataset.value.as_ref()?.transmission()?)));
    match tile.title {
        "BTDF" => scales::of_q(data().map(|(column, btdf)| (btdf, column.incident()))),
        "Transmittance" => scales::of_tau(data().map(|(_, btdf)| btdf)),
        "LID" => scales::of_lids(columns.iter().filter_map(|column| Some(&column.results.lid.value.as_ref()?.lid))),
        "Room" => {
            let rooms = columns.iter().filter_map(|column| column.results.room.value.as_ref());
            scales::of_illuminances(rooms.flat_map(|room| room.totals().map(|one| one.value)))
        }
        "Sky" => {
            scales::of_skies(columns.iter().filter_map(|column| Some(&column.state.daylight.value.as_ref()?.outside)))
        }
        _ => None,
    }
}
