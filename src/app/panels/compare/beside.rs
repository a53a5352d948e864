//! The same tile for each candidate, all on one scale.

use super::places::{missing, places, tile};
use crate::app::command::Command;
use crate::app::compare::Part;
use crate::app::compare_columns::{Column, Columns};
use crate::app::jobs::Lane;
use crate::app::paint::colour_scale::ColourScale;
use crate::app::paint::palette::ColourMap;
use crate::app::state::Tile;
use crate::app::theme;
use crate::app::tiles::TileInput;
use crate::app::views::sky;
use crate::app::window::App;
use crate::compute::angle::Bearing;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::Btdf;
use crate::compute::direction::{Dir, Incident};
use crate::compute::lid::Lid;
use crate::compute::lid::c_gamma::Aim;
use crate::drawing::ticks::fine_ceil;
use egui::{Label, RichText, Stroke, StrokeKind, Ui, UiBuilder, vec2};
use std::sync::Arc;

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
    let ends = |scale: ColourScale| [scale.lo, scale.hi];
    let transmissions =
        || columns.iter().filter_map(|column| Some((column, column.state.dataset.value.as_ref()?.transmission()?)));
    let positive = |value: f64| (value > 0.0).then_some(value);
    match tile.title {
        "BTDF" => {
            let greatest = |(column, btdf): (&Column, &Btdf)| {
                let q = btdf.indicatrix(column.incident()).map(|indicatrix| indicatrix.q).unwrap_or_default();
                q.into_iter().fold(0.0, f64::max)
            };
            let max = positive(transmissions().map(greatest).fold(0.0, f64::max))?;
            Some(ends(ColourScale::up_to(max, true, 3, ColourMap::Sequential)))
        }
        "Transmittance" => {
            let basis = RingBasis::equal_area(16);
            let greatest = |(_, btdf): (&Column, &Btdf)| {
                basis.cells().map(|cell| btdf.tau(Incident(cell.centre()))).fold(0.0, f64::max)
            };
            Some([0.0, fine_ceil(positive(transmissions().map(greatest).fold(0.0, f64::max))?)])
        }
        "LID" => {
            let lids = columns.iter().filter_map(|column| column.results.lid.value.as_ref());
            Some([0.0, positive(lids.map(|figures| strongest(&figures.lid)).fold(0.0, f64::max))?])
        }
        "Room" => {
            let rooms = columns.iter().filter_map(|column| column.results.room.value.as_ref());
            let max = rooms.flat_map(|room| room.totals().map(|one| one.value).collect::<Vec<_>>()).fold(0.0, f64::max);
            Some([0.0, fine_ceil(positive(max)?)])
        }
        "Sky" => {
            let skies = columns.iter().filter_map(|column| column.state.daylight.value.as_ref());
            let of = |[low, high]: [f64; 2], daylight: &Arc<crate::app::state::Daylight>| {
                let at = |altitude: f64, bearing: f64| {
                    daylight.outside.luminance(Dir::from_altitude_bearing(altitude, Bearing::from_radians(bearing)))
                };
                let [lower, higher] = sky::extent(&at);
                [low.min(lower), high.max(higher)]
            };
            let [low, high] = skies.fold([f64::INFINITY, 0.0], of);
            (low < high).then(|| ends(ColourScale::log_around(low.max(1e-3), high.max(1e-2), ColourMap::Sequential)))
        }
        _ => None,
    }
}

/// The greatest intensity on a raster of directions. \[cd\]
fn strongest(lid: &Lid) -> f64 {
    let aim = Aim::of(lid.surface);
    let directions = (0..72).flat_map(|c| (0..=90).map(move |gamma| [5.0 * f64::from(c), 2.0 * f64::from(gamma)]));
    let at = |[c, gamma]: [f64; 2]| lid.intensity(aim.direction(c.to_radians(), gamma.to_radians()));
    directions.map(at).filter(|value| value.is_finite()).fold(0.0, f64::max)
}
