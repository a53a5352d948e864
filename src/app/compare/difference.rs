//! Difference of each candidate's results from those of the reference candidate, with sign, all with one colour scale.

use super::places::{kind, missing, places, short};
use crate::app::compare::columns::{Column, Columns};
use crate::app::display::theme;
use crate::app::paint::hemisphere::Side;
use crate::app::paint::tile::{self, Status};
use crate::app::state::State;
use crate::app::views::difference::{self, Picture};
use crate::compute::estimate::Estimate;
use crate::report::TileKind;
use crate::study::comparison::difference::{of_q, of_rooms, of_tau};
use crate::texts::compare as texts;
use egui::{Stroke, StrokeKind, Ui, UiBuilder};

/// Draws the picture of the difference for each candidate, and their common scale.
pub(super) fn show(ui: &mut Ui, state: &State, columns: &mut Columns) {
    let tile = state.compare.tile();
    let names = columns.names();
    let base = state.compare.base.min(names.len().saturating_sub(1));
    let drawn = kind(state).filter(|kind| [TileKind::Btdf, TileKind::Transmittance, TileKind::Room].contains(kind));
    let Some(kind) = drawn else {
        ui.with_layout(tile::middle(), |ui| ui.label(texts::DIFFERENCES_OF));
        return;
    };
    if names.len() < 2 {
        ui.with_layout(tile::middle(), |ui| ui.label(texts::TAKES_TWO));
        return;
    }
    let key = (columns.key(tile), base, Vec::new());
    let stopped = columns.stopped;
    let Columns { list, differences, .. } = columns;
    let pictures = differences.get(key, || list.iter().map(|one| picture(kind, one, &list[base])).collect());
    let reach = pictures.iter().flatten().map(Picture::reach).fold(0.0, f64::max);
    let scale = difference::scale(reach);
    let less = texts::less_base(&names[base]);
    let others: Vec<usize> = (0..names.len()).filter(|place| *place != base).collect();
    let rects = places(ui.available_rect_before_wrap(), others.len());
    // Another base is another picture.
    let base_results = list[base].revisions().into_iter().fold(base as u64, |all, one| all.rotate_left(13) ^ one);
    let base_is_there = is_there(kind, &list[base]);
    for (place, rect) in others.into_iter().zip(rects) {
        let column = &mut list[place];
        let palette = theme::palette(ui);
        ui.painter().rect(rect, 6, palette.surface, Stroke::new(1.0, palette.line), StrokeKind::Inside);
        let words = match base_is_there && is_there(kind, column) {
            true if kind == TileKind::Room => texts::OTHER_SENSORS.into(),
            true => texts::NO_TRANSMISSION.into(),
            false => missing(column),
        };
        let title = short(&names[place], ((rect.width() - 60.0) / 9.0).max(4.0) as usize);
        let stale = column.state.dataset.stale || (kind == TileKind::Room && column.results.room.stale);
        let results = column.revisions().into_iter().fold(0_u64, |all, one| all.rotate_left(16) ^ one);
        let incidence = column.incident().0.vector().to_array().into_iter();
        let input = difference::Input {
            picture: pictures[place].as_ref(),
            missing: &words,
            title: &title,
            less: &less,
            scale: &scale,
            revision: incidence
                .fold(results.rotate_left(7) ^ base_results, |all, one| all.rotate_left(21) ^ one.to_bits()),
            status: Status { stale, idle: stopped, ..Status::default() },
        };
        let builder = UiBuilder::new().max_rect(rect.shrink(2.0)).id_salt(("difference", column.id));
        ui.scope_builder(builder, |ui| difference::show(ui, &input, &mut column.difference));
    }
}

fn is_there(kind: TileKind, column: &Column) -> bool {
    if kind == TileKind::Room { column.results.room.value.is_some() } else { column.state.dataset.value.is_some() }
}

/// Returns the picture of the difference between a candidate (`column`) and the reference (`base`): illuminances of the
/// sensors \[lx\], q \[1/sr\] or τ. `None` while a result is missing, or if the results have no sensors or cells in
/// common.
fn picture(kind: TileKind, column: &Column, base: &Column) -> Option<Picture> {
    if kind == TileKind::Room {
        let of = |column: &Column| {
            let room = column.results.room.value.clone()?;
            let totals: Vec<Estimate> = room.totals().collect();
            Some((room, totals))
        };
        let ((room, totals), (other, others)) = (of(column)?, of(base)?);
        let values = of_rooms([&room.positions, &other.positions], [&totals, &others])?;
        let size = column.scene().room;
        return Some(Picture::Plan { room: [size.width, size.depth], count: room.grid?, values });
    }
    let btdf = |column: &Column| column.state.dataset.value.clone();
    let (one, other) = (btdf(column)?, btdf(base)?);
    let (one, other) = (one.transmission()?, other.transmission()?);
    Some(match kind {
        TileKind::Btdf => Picture::Disk { side: Side::Emergent, cells: of_q(one, other, column.incident()) },
        _ => Picture::Disk { side: Side::Incident, cells: of_tau(one, other) },
    })
}
