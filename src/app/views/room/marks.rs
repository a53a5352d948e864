//! Marks on the floor plan: labels of iso-lux lines, and a scale bar.

use crate::app::paint::colour_scale::{ColourScale, ColourScaleExt as _};
use crate::app::paint::palette::contrast;
use crate::drawing::ticks::tick;
use egui::{Color32, FontId, Pos2, Rect, Stroke, Ui, Vec2, pos2, vec2};

/// Draws the level of an iso-lux line on the line, inside the plan and clear of the rectangles `used`, to which its
/// label is added; returns `false` if there is no room.
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

/// Font size of labels on the floor plan. \[points\]
const NAME_SIZE: f32 = 13.0;

/// Whether a polyline crosses a rectangle.
fn runs_through(line: &[Pos2], place: Rect) -> bool {
    line.windows(2).any(|ends| {
        // What of the line, as shares of its length, is within all four sides (Liang and Barsky 1984).
        let (way, mut part) = (ends[1] - ends[0], [0.0_f32, 1.0]);
        for (step, low, high) in [
            (way.x, place.left() - ends[0].x, place.right() - ends[0].x),
            (way.y, place.top() - ends[0].y, place.bottom() - ends[0].y),
        ] {
            if step == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return false;
                }
                continue;
            }
            let [from, to] = [low / step, high / step];
            part = [part[0].max(from.min(to)), part[1].min(from.max(to))];
        }
        part[0] <= part[1]
    })
}

/// Returns the rectangle of a given size that covers the fewest lines and things of an area: in a corner if one is
/// free, otherwise anywhere, preferably at the rear of the room; `None` if the area is too small.
fn free_place(area: Rect, size: Vec2, lines: &[Vec<Pos2>], things: &[Rect]) -> Option<Rect> {
    const STEPS: usize = 12;
    let inside = area.shrink(3.0);
    if inside.width() < size.x || inside.height() < size.y {
        return None;
    }
    let room = inside.size() - size;
    let at = |x: f32, y: f32| Rect::from_min_size(inside.min + vec2(x * room.x, y * room.y), size);
    let corners = [(1.0, 1.0), (1.0, 0.0), (0.0, 1.0), (0.0, 0.0)];
    let share = |k: usize| k as f32 / STEPS as f32;
    let grid = (0..=STEPS).rev().flat_map(|x| (0..=STEPS).rev().map(move |y| (share(x), share(y))));
    let covered = |place: &Rect| {
        let near = place.expand(2.0);
        let through = |place: Rect| lines.iter().filter(|line| runs_through(line, place)).count();
        // Names stand on lines: they want room beside the bar too.
        through(place.expand(11.0))
            + 4 * through(near)
            + 8 * things.iter().filter(|thing| thing.intersects(near)).count()
    };
    corners.into_iter().chain(grid).map(|(x, y)| at(x, y)).min_by_key(covered)
}

/// Draws a scale bar of whole metres at a position where it covers few lines and things; `scale` of the picture
/// \[points/m\]. Returns its rectangle.
pub(super) fn scale_bar(ui: &Ui, area: Rect, scale: f32, lines: &[Vec<Pos2>], things: &[Rect]) -> Rect {
    let metres = [10.0_f32, 5.0, 2.0].into_iter().find(|m| m * scale < 0.3 * area.width()).unwrap_or(1.0);
    let galley = ui.painter().layout_no_wrap(format!("{metres} m"), FontId::proportional(NAME_SIZE), Color32::WHITE);
    let length = metres * scale;
    let size = vec2(length.max(galley.size().x) + 8.0, galley.size().y + 8.0);
    let Some(place) = free_place(area, size, lines, things) else { return Rect::NOTHING };
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_keeps_off_lines_and_sensors() {
        let area = Rect::from_min_size(pos2(0.0, 0.0), vec2(300.0, 200.0));
        let size = vec2(60.0, 24.0);
        let place = |lines: &[Vec<Pos2>], things: &[Rect]| free_place(area, size, lines, things).unwrap();
        let corner = place(&[], &[]);
        assert_eq!(corner.max, area.shrink(3.0).max);
        // A line through that corner, without a point in it.
        let line = vec![pos2(310.0, 150.0), pos2(200.0, 210.0)];
        assert!(runs_through(&line, corner));
        let other = place(std::slice::from_ref(&line), &[]);
        assert!(other != corner && !runs_through(&line, other));
        // Lines through all corners and a sensor: somewhere between them.
        let cross = vec![vec![pos2(0.0, 0.0), pos2(300.0, 200.0)], vec![pos2(0.0, 200.0), pos2(300.0, 0.0)]];
        let sensor = Rect::from_center_size(pos2(260.0, 100.0), vec2(30.0, 30.0));
        let between = place(&cross, &[sensor]);
        assert!(cross.iter().all(|line| !runs_through(line, between)) && !between.intersects(sensor), "{between:?}");
        assert!(free_place(Rect::from_min_size(pos2(0.0, 0.0), vec2(40.0, 200.0)), size, &[], &[]).is_none());
    }
}
