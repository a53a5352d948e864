//! The ground outside with the shadows of building and obstructions on it, in section and perspective; it is not drawn
//! for a room on the ground without obstructions.

use super::input::{Frame, Input};
use super::outside;
use crate::app::paint::camera::View;
use crate::app::paint::palette::Palette;
use crate::app::paint::tile;
use crate::compute::polygon::cut_by_all;
use crate::compute::sky::GroundShade;
use crate::texts::{fixed, tiles as say};
use egui::epaint::PathStroke;
use egui::{Color32, Painter, Rect, Sense, Shape, Stroke, Ui, vec2};
use glam::{DVec2, DVec3};

/// Thickness of the strip that represents the ground in the section. \[points\]
const THICKNESS: f32 = 7.0;
/// Minimum length of a shaded stretch of the ground that the text names. \[m\]
const NAMED: f64 = 0.05;

/// Returns the x coordinate of a row of sensor points, by its index; that of the middle of the room without rows. \[m\]
fn across(input: &Input<'_>, row: usize) -> f64 {
    (row as f64 + 0.5) / input.nx.max(1) as f64 * input.room[0]
}

/// Returns the colour of the ground outside shadows.
fn open(ground: &GroundShade, palette: &Palette) -> Color32 {
    if ground.is_sunny { palette.sunlit } else { palette.grid }
}

/// Returns a sentence on the stretches of the ground in front of the façade that are shaded, by their distances from
/// the façade, in the section at `x` \[m\].
pub(super) fn words(ground: &GroundShade, x: f64) -> String {
    if !ground.is_sunny {
        return say::GROUND_WITHOUT_SUN.into();
    }
    let stretches = ground.stretches(x);
    let outward = stretches.into_iter().rev().map(|[far, near]| [0.0 - near.min(0.0), -far]);
    let named = outward.filter(|[near, far]| far - near >= NAMED);
    let list: Vec<String> = named.map(|[near, far]| say::range(fixed(near, 1), fixed(far, 1))).collect();
    if list.is_empty() { say::GROUND_SUNLIT.into() } else { say::ground_shaded(list.join("; ")) }
}

/// Draws the ground in the section, with its shaded stretches in the plane of a row of sensor points, given by its
/// index.
pub(super) fn section(ui: &Ui, frame: &Frame, input: &Input<'_>, row: usize, palette: &Palette) {
    let Some(ground) = input.ground else { return };
    let top = frame.screen(0.0, ground.height).y;
    let strip = Rect::from_x_y_ranges(frame.view.x_range(), top..=top + THICKNESS).intersect(frame.view);
    if !strip.is_positive() {
        return;
    }
    let x = across(input, row);
    let painter = ui.painter().with_clip_rect(strip.expand2(vec2(0.0, 1.0)).intersect(ui.clip_rect()));
    painter.rect_filled(strip, 0, open(ground, palette));
    // No sun comes under a room that stands on the ground.
    let covered = (ground.is_sunny && ground.height >= 0.0).then_some([0.0, input.room[1]]);
    for stretch in ground.stretches(x).into_iter().chain(covered) {
        let [left, right] = stretch.map(|y| frame.screen(y, 0.0).x);
        painter.rect_filled(Rect::from_x_y_ranges(left..=right, strip.y_range()), 0, palette.shade);
    }
    painter.hline(strip.x_range(), top, Stroke::new(1.5, palette.outline));
    let response = ui.interact(strip, ui.scope_id().with("ground"), Sense::hover());
    let text = words(ground, x);
    tile::name(ui, &response, say::GROUND_OUTSIDE, &text);
    response.on_hover_text(text);
}

/// Returns the rectangle of the ground that the perspective shows, round the room and the obstructions near it: lowest
/// and highest coordinate in x and in y. \[m\]
fn limits(input: &Input<'_>) -> [[f64; 2]; 2] {
    let room = outside::room(input.room);
    let corners = outside::near(input).flat_map(|solid| solid.corners()).chain(room.corners());
    let [low, high] = corners.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)]);
    let reach = outside::reach(input);
    [0, 1].map(|axis| [low[axis] - reach, high[axis] + reach])
}

/// Draws the ground near the room in perspective, with the shadows on it. It must be drawn first, since everything else
/// is in front of it; it is left out if the viewpoint is below the ground.
pub(super) fn perspective(painter: &Painter, view: &View, input: &Input<'_>, palette: &Palette) {
    let Some(ground) = input.ground.filter(|ground| view.eye.z > ground.height) else { return };
    let [[a, b], [c, d]] = limits(input);
    let show = |outline: &[DVec2], fill: Color32, stroke: PathStroke| {
        let corners: Vec<DVec3> = outline.iter().map(|p| p.extend(ground.height)).collect();
        painter.add(Shape::convex_polygon(view.polygon(&corners), fill, stroke));
    };
    let whole = [DVec2::new(a, c), DVec2::new(b, c), DVec2::new(b, d), DVec2::new(a, d)];
    show(&whole, open(ground, palette), PathStroke::NONE);
    let mut kept = Vec::new();
    for shadow in &ground.shadows {
        let mut outline = shadow.clone();
        let sides = (0..4).map(|side| {
            let (from, along) = (whole[side], whole[(side + 1) % 4] - whole[side]);
            move |p: DVec2| along.perp_dot(p - from)
        });
        cut_by_all(&mut outline, sides, &mut kept);
        if !outline.is_empty() {
            show(&outline, palette.shade, PathStroke::NONE);
        }
    }
    show(&whole, Color32::TRANSPARENT, PathStroke::new(1.0, palette.outline));
}

/// Returns a sentence on the shaded stretches of the ground in front of the middle of the room, see [`words`]; `None`
/// if the ground is not drawn.
pub(super) fn words_of_middle(input: &Input<'_>) -> Option<String> {
    input.ground.map(|ground| words(ground, 0.5 * input.room[0]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shade_is_named_from_the_facade_outwards() {
        let stretch = |from: f64, to: f64| [[0.0, from], [4.0, from], [4.0, to], [0.0, to]].map(DVec2::from_array);
        let ground = |shadows: Vec<Vec<DVec2>>, is_sunny| GroundShade { height: 0.0, is_sunny, shadows };
        let shadows = vec![stretch(-25.0, -12.5).to_vec(), stretch(-1.2, 6.0).to_vec(), stretch(7.0, 9.0).to_vec()];
        let text = words(&ground(shadows, true), 2.0);
        assert_eq!(text, "ground shaded 0.0 to 1.2; 12.5 to 25.0 m in front of the façade");
        let behind = words(&ground(vec![stretch(0.0, 6.0).to_vec()], true), 2.0);
        assert_eq!(behind, say::GROUND_SUNLIT.get());
        assert_eq!(words(&ground(Vec::new(), false), 2.0), say::GROUND_WITHOUT_SUN.get());
    }
}
