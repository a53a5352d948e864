//! Plot of the products' figures for two objectives against each other, with the Pareto front emphasised.

use super::input::{Action, Input};
use crate::app::paint::palette::Palette;
use crate::app::paint::plot::{self, Look as PlotLook};
use crate::app::paint::tile;
use crate::compute::rank::Place;
use crate::study::rank::{Entry, Look, Shortlist};
use crate::texts::choose as say;
use egui::{Align2, FontId, Rect, Stroke, Ui, vec2};

/// Maximum distance from the pointer to a product's point that it selects. \[points\]
const NEAR: f32 = 12.0;

/// Draws the plot of two objectives. Returns the line under it.
pub(super) fn show(ui: &mut Ui, rect: Rect, input: &Input<'_>, list: &Shortlist, out: &mut Vec<Action>) -> String {
    let axes = list.axes(input.look);
    let palette = Palette::of(ui.visuals());
    let shown = list.shown(input.look);
    let known: Vec<(&Entry, [[f64; 2]; 2])> = shown
        .iter()
        .filter(|entry| entry.excluded.is_none())
        .map(|entry| (*entry, axes.map(|k| entry.figures.get(k).copied())))
        .filter_map(|(entry, [x, y])| Some((entry, [x?, y?].map(|figure| [figure.value, figure.error]))))
        .filter(|(_, ends)| ends.iter().all(|[value, _]| value.is_finite()))
        .collect();
    let plot = list.plot(input.look);
    let id = ui.scope_id().with(("choose", axes));
    let look = PlotLook { focusable: true, ..PlotLook::tile(id, &[], palette.sun) };
    let drawn = plot::show(ui, rect, &plot, &look, |_| {});
    let painter = ui.painter().with_clip_rect(drawn.area().expand(6.0).intersect(ui.clip_rect()));
    for (entry, [[x, dx], [y, dy]]) in &known {
        for (from, to) in [([x - dx, *y], [x + dx, *y]), ([*x, y - dy], [*x, y + dy])] {
            painter.line_segment([drawn.screen(from), drawn.screen(to)], Stroke::new(1.0, palette.weak));
        }
        let front = entry.place == Some(Place::Front);
        let fill = if front { palette.second } else { palette.first };
        let fill = if entry.coarse { fill.gamma_multiply(0.5) } else { fill };
        let chosen = Some(&entry.product) == input.look.product.as_ref();
        let place = drawn.screen([*x, *y]);
        let edge = Stroke::new(if chosen { 2.5 } else { 1.0 }, if chosen { palette.ink } else { palette.face });
        painter.circle(place, if front { 6.0 } else { 4.0 }, fill, edge);
        if entry.product == input.in_room {
            painter.circle_stroke(place, 9.5, Stroke::new(2.0, palette.sun));
        }
    }
    tile::name(ui, &drawn.response, say::PLOT_NAME, &say::shown(known.len(), list.entries.len()));
    let at = |ends: &[[f64; 2]; 2]| drawn.screen([ends[0][0], ends[1][0]]);
    let nearest = drawn.response.hover_pos().and_then(|pointer| {
        let distance = |ends: &[[f64; 2]; 2]| at(ends).distance(pointer);
        let best = known.iter().min_by(|a, b| distance(&a.1).total_cmp(&distance(&b.1)))?;
        (distance(&best.1) <= NEAR).then_some(best)
    });
    if let Some((entry, ends)) = nearest {
        label(ui, &entry.name, at(ends), drawn.area(), &palette);
        if drawn.response.clicked() {
            let look = Look { product: Some(entry.product.clone()), ..input.look.clone() };
            out.push(Action::Look(Box::new(look)));
        }
        return super::words::entry(list, entry);
    }
    let chosen = input.look.product.as_ref().and_then(|product| list.entry(product));
    chosen.map_or_else(|| say::PLOT_FOOT.into(), |entry| super::words::entry(list, entry))
}

/// Draws the name of a product beside its point, within the plot.
fn label(ui: &Ui, name: &str, at: egui::Pos2, area: Rect, palette: &Palette) {
    let painter = ui.painter();
    let galley = painter.layout_no_wrap(name.to_owned(), FontId::proportional(13.0), palette.ink);
    let right = at.x + 12.0 + galley.size().x <= area.right();
    let anchor = if right { Align2::LEFT_CENTER } else { Align2::RIGHT_CENTER };
    let offset = vec2(if right { 12.0 } else { -12.0 }, 0.0);
    let place = anchor.anchor_size(at + offset, galley.size());
    painter.rect_filled(place.expand2(vec2(4.0, 2.0)), 3, ui.visuals().extreme_bg_color);
    painter.galley(place.min, galley, palette.ink);
}
