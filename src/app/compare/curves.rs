//! Curves of all candidates in the same plot, distinguished by colour and dashes.

use super::places::{kind, short, tile_words};
use crate::app::compare::columns::{Column, Columns};
use crate::app::paint::palette::Palette;
use crate::app::paint::plot::{self, Look};
use crate::app::paint::tile;
use crate::app::scene::control::rule_curve;
use crate::app::state::State;
use crate::compute::estimate::Estimate;
use crate::drawing::plot::Plot;
use crate::report::TileKind;
use crate::study::comparison::curves::{Grid, of_controls, of_lids, of_rooms, of_transmittances};
use crate::texts::compare as texts;
use crate::texts::language;
use egui::Ui;

/// Draws the plots of the compared tile with a curve for each candidate.
pub(super) fn show(ui: &mut Ui, state: &State, columns: &mut Columns) {
    let (tile, kind) = (state.compare.tile(), kind(state));
    let whole = ui.available_rect_before_wrap();
    let wide = whole.width() > whole.height();
    // Two plots side by side leave half of the width to the names.
    let room = if wide && kind == Some(TileKind::Lid) { 0.5 * whole.width() } else { whole.width() };
    let most = ((room - 70.0) / 8.0).max(8.0) as usize;
    let names: Vec<String> = columns.names().iter().map(|name| short(name, most)).collect();
    // Rules are in the names of the scene's keys: with them the curves of control change; the axes with the language.
    let rules = columns.list.iter().map(|column| format!("{:?}", column.state.control_keys()));
    let key = (columns.key(tile), 0, names.iter().cloned().chain(rules).chain([format!("{:?}", language())]).collect());
    let Columns { list, plots, .. } = columns;
    let plots = plots.get(key, || make(kind, list, &names));
    if plots.is_empty() {
        let words = list.iter().find_map(Column::error).map_or_else(
            || match kind {
                Some(TileKind::Lid | TileKind::Room | TileKind::Btdf | TileKind::Transmittance) => {
                    texts::COMPUTING.into()
                }
                Some(TileKind::Control) => texts::NO_CURVES.into(),
                _ => texts::CURVES_OF.into(),
            },
            str::to_owned,
        );
        ui.with_layout(tile::middle(), |ui| ui.label(words));
        return;
    }
    let palette = Palette::of(ui.visuals());
    let colours: Vec<_> = palette.series.into_iter().chain([palette.ink]).collect();
    let halves = if wide { whole.split_left_right_at_fraction(0.5) } else { whole.split_top_bottom_at_fraction(0.5) };
    let rects = if plots.len() > 1 { vec![halves.0, halves.1] } else { vec![whole] };
    let mut legend_of = None;
    for (k, (one, rect)) in plots.iter().zip(rects).enumerate() {
        let id = ui.scope_id().with(("curves", tile, k));
        let look = Look { dashed: true, legend_of, left: 56.0, ..Look::tile(id, &colours, palette.second) };
        let shown = plot::show(ui, rect.shrink(4.0), one, &look, |_| {});
        tile::name(ui, &shown.response, texts::curves_name(tile_words(tile)), &names.join("; "));
        legend_of = legend_of.or(Some(id));
    }
}

/// Returns the results that `of` gives for the candidates, each with number and name of its candidate; candidates
/// without the result are left out.
fn known<'a, T>(list: &'a [Column], names: &[String], of: impl Fn(&'a Column) -> Option<T>) -> Vec<(String, T)> {
    list.iter().zip(names).filter_map(|(column, name)| Some((name.clone(), of(column)?))).collect()
}

/// Returns the plots for a kind of tile, with a series for each candidate that has a result; empty for kinds that are
/// not compared by curves.
fn make(kind: Option<TileKind>, list: &[Column], names: &[String]) -> Vec<Plot> {
    let transmission = |column: &'_ Column| column.state.dataset.value.clone();
    match kind {
        Some(TileKind::Lid) => {
            let lids = known(list, names, |column| column.results.lid.value.as_deref().map(|figures| &figures.lid));
            if lids.is_empty() { Vec::new() } else { of_lids(&lids).into() }
        }
        Some(TileKind::Room) => {
            let rooms = known(list, names, |column| {
                let room = column.results.room.value.as_deref()?;
                Some((column.scene().room.depth, room.grid?, room.totals().collect::<Vec<Estimate>>()))
            });
            let grids: Vec<(String, Grid<'_>)> = rooms
                .iter()
                .map(|(name, (depth, count, values))| (name.clone(), Grid { depth: *depth, count: *count, values }))
                .collect();
            if grids.is_empty() { Vec::new() } else { vec![of_rooms(&grids)] }
        }
        Some(TileKind::Btdf | TileKind::Transmittance) => {
            let data = known(list, names, transmission);
            let data: Vec<_> =
                data.iter().filter_map(|(name, dataset)| Some((name.clone(), dataset.transmission()?))).collect();
            if data.is_empty() { Vec::new() } else { vec![of_transmittances(&data)] }
        }
        Some(TileKind::Control) => {
            let curves = known(list, names, |column| {
                let product = column.state.product.as_deref().filter(|product| product.states.len() > 1)?;
                rule_curve(product, &column.state.control_keys(), &column.state.base())
                    .ok()
                    .filter(|curve| !curve.is_empty())
            });
            if curves.is_empty() { Vec::new() } else { vec![of_controls(&curves)] }
        }
        _ => Vec::new(),
    }
}
