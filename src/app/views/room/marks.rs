//! What stands on the plan beside its colours: iso-lux levels with their names, and a scale.

use crate::app::paint::colour_scale::ColourScale;
use crate::app::paint::palette::contrast;
use crate::drawing::ticks::tick;
use egui::{Color32, FontId, Pos2, Rect, Stroke, Ui, pos2, vec2};

/// Writes a line's level on it where nothing else stands, inside the plan; false where there is no such place.
pub(super) fn label_line(
    ui: &Ui,
    points: &[Pos2],
    level: f64,
    scale: &ColourScale,
    area: Rect,
    used: &mut Vec<Rect>,
) -> bool {
    if points.len() < 2 {
        return false;
    }
    let ground = scale.colour(level);
    let galley = ui.painter().layout_no_wrap(tick(level), FontId::proportional(NAME_SIZE), contrast(ground));
    let size = galley.size() + vec2(6.0, 0.0);
    let inside = area.shrink(1.0);
    if inside.width() < size.x || inside.height() < size.y {
        return false;
    }
    // From the middle outwards; next to an edge the name moves inside.
    for k in 0..20 {
        let share = 0.5 + if k % 2 == 0 { 0.5 } else { -0.5 } * f64::from(k) / 20.0;
        let at = points[((points.len() - 1) as f64 * share).round() as usize];
        let half = 0.5 * size;
        let centre = at.clamp(inside.min + half, inside.max - half);
        let place = Rect::from_center_size(centre, size);
        if centre.distance(at) <= half.y + 1.0 && used.iter().all(|r| !r.intersects(place.expand(2.0))) {
            ui.painter().rect_filled(place, 3, ground);
            ui.painter().galley(place.center() - 0.5 * galley.size(), galley, contrast(ground));
            used.push(place);
            return true;
        }
    }
    false
}

/// Size of names on the plan. \[points\]
const NAME_SIZE: f32 = 13.0;

/// A bar of whole metres in the deep corner of the plan, `scale` points a metre; returns the place that it takes.
pub(super) fn scale_bar(ui: &Ui, area: Rect, scale: f32) -> Rect {
    let metres = [10.0_f32, 5.0, 2.0].into_iter().find(|m| m * scale < 0.3 * area.width()).unwrap_or(1.0);
    let galley = ui.painter().layout_no_wrap(format!("{metres} m"), FontId::proportional(NAME_SIZE), Color32::WHITE);
    let length = metres * scale;
    let size = vec2(length.max(galley.size().x) + 8.0, galley.size().y + 8.0);
    let place = Rect::from_min_max(area.max - size - vec2(3.0, 3.0), area.max - vec2(3.0, 3.0));
    if !area.contains_rect(place) {
        return Rect::NOTHING;
    }
    let painter = ui.painter();
    painter.rect_filled(place, 3, Color32::from_black_alpha(170));
    let y = place.bottom() - 4.0;
    let [left, right] = [-0.5, 0.5].map(|side| place.center().x + side * length);
    let stroke = Stroke::new(1.5, Color32::WHITE);
    painter.hline(left..=right, y, stroke);
    for x in [left, right] {
        painter.vline(x, y - 3.0..=y + 3.0, stroke);
    }
    let at = pos2(place.center().x - 0.5 * galley.size().x, place.top() + 1.0);
    painter.galley(at, galley, Color32::WHITE);
    place
}
