//! One tile of each candidate, side by side, all with a common colour scale or axis.

use super::places::{kind, missing, places, tile};
use crate::app::command::Command;
use crate::app::compare::columns::{Column, Columns};
use crate::app::compare::view::{Act, Part};
use crate::app::display::theme;
use crate::app::paint;
use crate::app::paint::colour_scale::{ColourScale, ColourScaleExt as _, LEGEND_HEIGHT};
use crate::app::paint::palette::{ColourMap, Palette};
use crate::app::shell::jobs::Lane;
use crate::app::state::{State, Tile};
use crate::app::tiles::TileInput;
use crate::drawing::ticks::{fine_ceil, si, tick};
use crate::report::TileKind;
use crate::study::comparison::scales;
use crate::texts::compare as texts;
use egui::{Label, RichText, Sense, Stroke, StrokeKind, Ui, UiBuilder, vec2};

/// Height of the line with a candidate's name. \[points\]
const NAME: f32 = 24.0;
/// Maximum width of the legend of the common colour scale. \[points\]
const WIDE: f32 = 560.0;
/// Lower end of a common logarithmic scale as a fraction of its upper end, the same as in the single tiles.
const LEAST: f64 = 1e-4;

/// Draws the tile of each candidate, and their common scale.
pub(super) fn show(ui: &mut Ui, state: &State, columns: &mut Columns, commands: &mut Vec<Command>) {
    let Some(tile) = tile(state) else { return };
    let kind = kind(state);
    let key = columns.key(tile.title);
    let Columns { list, scale: known, .. } = columns;
    let scale = *known.get(key, || scale(list, kind));
    let log = columns.logs(tile).first().map(|own| state.compare.log.unwrap_or(*own));
    let factor = kind == Some(TileKind::Room) && state.settings.room.daylight_factor;
    if let Some(range) = scale.filter(|_| !factor) {
        legend(ui, kind, range, log, commands);
    }
    let held = ui.input(|input| input.pointer.any_down());
    let stopped = columns.stopped;
    let names = columns.names();
    let rects = places(ui.available_rect_before_wrap(), names.len());
    for (place, (rect, name)) in rects.into_iter().zip(&names).enumerate() {
        let from = commands.len();
        let column = &mut columns.list[place];
        let palette = theme::palette(ui);
        ui.painter().rect(rect, 6, palette.surface, Stroke::new(1.0, palette.line), StrokeKind::Inside);
        let (head, body) = rect.shrink(3.0).split_top_bottom_at_y(rect.top() + NAME);
        let builder = UiBuilder::new().max_rect(head.shrink2(vec2(5.0, 0.0))).id_salt(("name", column.id));
        ui.scope_builder(builder, |ui| ui.add(Label::new(RichText::new(name).strong()).truncate()));
        if let (Some(own), Some(log)) = (column.bench.log(tile), log) {
            *own = log;
        }
        let builder = UiBuilder::new().max_rect(body).id_salt(("candidate", column.id));
        ui.scope_builder(builder, |ui| one(ui, column, tile, (scale, held, stopped), commands));
        let chosen = column.bench.log(tile).copied();
        columns.retarget(place, &state.document, from, commands);
        // What is chosen in one holds for all.
        if let Some(chosen) = chosen.filter(|chosen| log.is_some_and(|log| log != *chosen)) {
            commands.push(Command::Compare(Act::Log(chosen)));
        }
    }
}

/// Draws the legend of the common scale from `lo` to `hi`, in the unit of the compared tile, and the choice between a
/// linear and a logarithmic scale (`log`; `None` if there is no choice) for all tiles.
fn legend(ui: &mut Ui, kind: Option<TileKind>, [lo, hi]: [f64; 2], log: Option<bool>, commands: &mut Vec<Command>) {
    let unit = match kind {
        Some(TileKind::Btdf) => "q / (1/sr)",
        Some(TileKind::Transmittance) => "τ",
        Some(TileKind::Sky) => "cd/m²",
        Some(TileKind::Room) => "lx",
        Some(TileKind::Lid) => {
            ui.label(texts::one_scale(texts::common_scale_is(tick(0.0), si(fine_ceil(hi), "cd"), "")).trim_end());
            return;
        }
        _ => return,
    };
    let logarithmic = log.unwrap_or(false);
    let lo = match kind {
        _ if logarithmic => lo.max(hi * LEAST),
        Some(TileKind::Sky) => 0.0,
        _ => lo,
    };
    let scale = ColourScale { lo, hi, log: logarithmic, map: ColourMap::Sequential };
    ui.horizontal(|ui| {
        if let Some(mut log) = log
            && ui.toggle_value(&mut log, texts::LOG.get()).on_hover_text(texts::LOG_TIP).clicked()
        {
            commands.push(Command::Compare(Act::Log(log)));
        }
        let size = vec2(ui.available_width().min(WIDE), LEGEND_HEIGHT);
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        scale.paint_legend(ui.painter(), rect, unit, None, &Palette::of(ui.visuals()));
        let value = texts::common_scale_is(tick(lo), tick(hi), unit);
        paint::tile::name(ui, &response, texts::COMMON_SCALE.get(), &value);
    });
}

/// Draws the tile of one candidate, or the reason why there is none. `scale`: lowest and highest value of the common
/// scale; `held`: whether the user is dragging; `stopped`: whether no candidate is being computed.
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
        ui.with_layout(paint::tile::middle(), |ui| ui.label(missing(column)));
        return;
    }
    if TileKind::titled(tile.title) == Some(TileKind::Control) && column.state.product.is_none() {
        ui.with_layout(paint::tile::middle(), |ui| ui.label(texts::NOTHING_MOVES));
        return;
    }
    let Column { state, results, bench, .. } = column;
    let seen = TileInput { state, results, busy: &busy, done: &|_| None, held, numbers: false, scale };
    bench.show(ui, tile, &seen, commands);
}

/// Returns the lowest and highest value of a scale for all candidates, in the unit of the tile: q \[1/sr\], τ,
/// intensity \[cd\], illuminance \[lx\] or luminance \[cd/m²\]. `None` for tiles with a fixed scale, and before there
/// are results.
fn scale(columns: &[Column], kind: Option<TileKind>) -> Option<[f64; 2]> {
    let data =
        || columns.iter().filter_map(|column| Some((column, column.state.dataset.value.as_ref()?.transmission()?)));
    match kind? {
        TileKind::Btdf => scales::of_q(data().map(|(column, btdf)| (btdf, column.incident()))),
        TileKind::Transmittance => scales::of_tau(data().map(|(_, btdf)| btdf)),
        TileKind::Lid => {
            scales::of_lids(columns.iter().filter_map(|column| Some(&column.results.lid.value.as_ref()?.lid)))
        }
        TileKind::Room => {
            let rooms = columns.iter().filter_map(|column| column.results.room.value.as_ref());
            scales::of_illuminances(rooms.flat_map(|room| room.totals().map(|one| one.value)))
        }
        TileKind::Sky => {
            scales::of_skies(columns.iter().filter_map(|column| Some(&column.state.daylight.value.as_ref()?.outside)))
        }
        TileKind::Control | TileKind::Year | TileKind::Choose => None,
    }
}
