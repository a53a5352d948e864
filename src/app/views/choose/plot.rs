//! Two objectives against each other: what no other is better than in every objective stands out.

use super::input::{ChooseRow, ChooseRows, Objective};
use crate::app::paint::palette::Palette;
use crate::app::paint::plot::{self, Look};
use crate::app::paint::tile;
use crate::drawing::plot::{Axis, Plot, Unit};
use crate::texts::choose as say;
use egui::{Rect, Stroke, Ui};

/// Nearest that the pointer has to come to a point. \[points\]
const NEAR: f32 = 10.0;

fn axis(objective: Option<&Objective>, values: &[f64]) -> Axis {
    let (lo, hi) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(*v), hi.max(*v)));
    let (lo, hi) = if lo <= hi { (lo, hi) } else { (0.0, 1.0) };
    let margin = 0.08 * (hi - lo).max(1e-6);
    let name = objective.map_or("", |one| one.name.as_str());
    let unit = match objective.map_or("", |one| one.unit) {
        "%" => Unit::Share,
        unit => Unit::Named(unit),
    };
    Axis::linear([lo - margin, hi + margin], name, unit)
}

pub(super) fn show(
    ui: &mut Ui,
    (rect, chosen): (Rect, &mut Option<String>),
    rows: &ChooseRows,
    shown: &[&ChooseRow],
    axes: [usize; 2],
    in_room: &str,
) -> String {
    let palette = Palette::of(ui.visuals());
    let known: Vec<(&ChooseRow, [(f64, f64); 2])> = shown
        .iter()
        .filter(|row| row.excluded.is_none())
        .filter_map(|row| Some((*row, [*row.values.get(axes[0])?, *row.values.get(axes[1])?])))
        .filter(|(_, ends)| ends.iter().all(|(value, _)| value.is_finite()))
        .collect();
    let of = |k: usize| axis(rows.objectives.get(axes[k]), &known.iter().map(|(_, at)| at[k].0).collect::<Vec<_>>());
    let plot = Plot { x: of(0), y: of(1), series: Vec::new(), guides: Vec::new() };
    let look = Look { focusable: true, ..Look::tile(ui.scope_id().with(("choose", axes)), &[], palette.sun) };
    let drawn = plot::show(ui, rect, &plot, &look, |_| {});
    let painter = ui.painter().with_clip_rect(drawn.area().expand(6.0).intersect(ui.clip_rect()));
    let at = |ends: &[(f64, f64); 2]| drawn.screen([ends[0].0, ends[1].0]);
    for (row, ends) in &known {
        let place = at(ends);
        let [(x, dx), (y, dy)] = *ends;
        for (from, to) in [([x - dx, y], [x + dx, y]), ([x, y - dy], [x, y + dy])] {
            painter.line_segment([drawn.screen(from), drawn.screen(to)], Stroke::new(1.0, palette.weak));
        }
        let fill = if row.front { palette.second } else { palette.first };
        let edge = if chosen.as_ref() == Some(&row.product) { palette.ink } else { palette.face };
        painter.circle(place, if row.front { 6.0 } else { 4.0 }, fill, Stroke::new(1.5, edge));
        if row.product == in_room {
            painter.circle_stroke(place, 9.0, Stroke::new(2.0, palette.sun));
        }
    }
    tile::name(ui, &drawn.response, say::PLOT_NAME, &say::shown(known.len(), rows.rows.len()));
    let nearest = drawn.response.hover_pos().and_then(|pointer| {
        let distance = |ends: &[(f64, f64); 2]| at(ends).distance(pointer);
        let best = known.iter().min_by(|a, b| distance(&a.1).total_cmp(&distance(&b.1)))?;
        (distance(&best.1) <= NEAR).then_some(best.0)
    });
    if let Some(row) = nearest.filter(|_| drawn.response.clicked()) {
        *chosen = Some(row.product.clone());
    }
    let told = nearest.or_else(|| shown.iter().find(|row| Some(&row.product) == chosen.as_ref()).copied());
    told.map_or_else(|| say::PLOT_FOOT.into(), |row| format!("{}: {}", row.label, row.why))
}
