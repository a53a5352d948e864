//! Obstructions in floor plan and section: drawn to scale within the extent of the picture; those beyond it are named
//! with their distance.

use super::input::{Frame, Input, Span};
use crate::app::paint::palette::Palette;
use crate::compute::sky::GroundShade;
use crate::compute::surroundings::solid::Solid;
use crate::study::scene_file::BoxKeys;
use crate::texts::{fixed, tiles as say};
use egui::epaint::PathStroke;
use egui::{Align2, FontId, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, Ui, pos2, vec2};
use glam::DVec3;

/// Minimum margin round room and obstructions in the picture if there are obstructions. \[m\]
const MARGIN: f64 = 0.25;
/// Width of the strip of surroundings on a side with an obstruction beyond the picture. \[m\]
const MARGIN_CUT: f64 = 0.6;
/// Maximum width of the surroundings on one side of the picture as a fraction of the room's depth; [`MOST`] limits it
/// too.
const MOST_OF_DEPTH: f64 = 0.4;
/// Maximum width of the surroundings on one side of the picture. \[m\]
const MOST: f64 = 3.0;
/// Maximum depth of the ground below the floor at which the section shows it, as a fraction of the room's height.
const GROUND_SHOWN: f64 = 1.25;
/// Height of the line of text that names obstructions and ground beyond the picture. \[points\]
pub(super) const BEYOND_HEIGHT: f32 = 18.0;

/// Returns a box of a scene file as a solid in room coordinates.
pub(super) fn solid(keys: &BoxKeys) -> Solid {
    Solid::new(DVec3::from_array(keys.from), DVec3::from_array(keys.to), keys.turn.to_radians())
}

/// Returns a room of a size \[m\] as a solid in room coordinates.
pub(super) fn room(size: [f64; 3]) -> Solid {
    Solid::new(DVec3::ZERO, DVec3::from_array(size), 0.0)
}

/// Returns the outline of a box in a picture as its corners in order: coordinates along the depth (y) and across it (z
/// if seen from the `side`, otherwise x). \[m\]
pub(super) fn outline(keys: &BoxKeys, side: bool) -> [[f64; 2]; 4] {
    let corners = solid(keys).corners();
    if side {
        let [low, high] = range(corners.iter().map(|corner| corner.y));
        let [bottom, top] = [keys.from[2], keys.to[2]];
        [[low, bottom], [high, bottom], [high, top], [low, top]]
    } else {
        [0b000, 0b001, 0b011, 0b010].map(|bits: usize| [corners[bits].y, corners[bits].x])
    }
}

/// Returns the maximum distance from the room at which boxes are drawn in perspective, since farther ones would be
/// lines across the picture. \[m\]
pub(super) fn reach(input: &Input<'_>) -> f64 {
    0.5 * DVec3::from_array(input.room).length()
}

/// Returns the boxes of obstructions that are drawn in perspective.
pub(super) fn near<'a>(input: &Input<'a>) -> impl Iterator<Item = Solid> + use<'a> {
    let (corners, reach) = (room(input.room).corners(), reach(input));
    let solids = input.outside.iter().map(|(keys, _)| solid(keys));
    solids.filter(move |solid| solid.gap_to(&corners) < reach)
}

/// Whether the section shows the ground, which must not be too far below the floor.
fn shows_ground(ground: &GroundShade, room: [f64; 3]) -> bool {
    -ground.height <= GROUND_SHOWN * room[2]
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

fn extent(keys: &BoxKeys, side: bool) -> [[f64; 2]; 2] {
    let corners = outline(keys, side);
    [0, 1].map(|axis| range(corners.iter().map(|corner| corner[axis])))
}

/// Returns the extent of a picture, with near boxes completely inside, and a strip of surroundings on the side of far
/// ones. `side`: whether it is the section.
pub(super) fn span(input: &Input<'_>, side: bool) -> Span {
    let room = Span::of(input.room, side);
    let most = (MOST_OF_DEPTH * input.room[1]).clamp(1.0, MOST);
    let mut shown = room.0;
    for (keys, _) in input.outside {
        let extent = extent(keys, side);
        let beyond = |axis: usize| [room.0[axis][0] - extent[axis][1], extent[axis][0] - room.0[axis][1]];
        // It begins where the picture may still go.
        let near = (0..2).all(|axis| beyond(axis).into_iter().all(|gap| gap < most - MARGIN_CUT));
        for axis in 0..2 {
            let [low, high] = room.0[axis];
            // Of a far one a strip on its side.
            let (to_low, to_high) = if near {
                (extent[axis][0] - MARGIN, extent[axis][1] + MARGIN)
            } else {
                let [below, above] = beyond(axis).map(|gap| if gap > 0.0 { MARGIN_CUT } else { MARGIN });
                (low - below, high + above)
            };
            shown[axis][0] = shown[axis][0].min(to_low.max(low - most));
            shown[axis][1] = shown[axis][1].max(to_high.min(high + most));
        }
    }
    if let Some(ground) = input.ground.filter(|_| side) {
        let shows = shows_ground(ground, input.room);
        shown[1][0] = shown[1][0].min(if shows { ground.height - MARGIN } else { -MARGIN_CUT });
        shown[0][0] = shown[0][0].min(if shows { -most } else { 0.0 });
    }
    Span(shown)
}

/// Whether any part of a box is inside a picture.
fn is_visible(keys: &BoxKeys, frame: &Frame) -> bool {
    bounds(keys, frame).intersects(frame.view.shrink(1.0))
}

/// Returns the bounding rectangle of a box on the screen.
pub(super) fn bounds(keys: &BoxKeys, frame: &Frame) -> Rect {
    Rect::from_points(&polygon(keys, frame))
}

/// Returns the screen positions of the corners of a box's outline.
pub(super) fn polygon(keys: &BoxKeys, frame: &Frame) -> [Pos2; 4] {
    outline(keys, frame.side).map(|[depth, across]| frame.screen(depth, across))
}

/// Returns texts on the boxes and the ground that extend beyond a picture, each with the screen position of the middle
/// of a box that lies completely beyond it.
fn beyond(input: &Input<'_>, frame: &Frame) -> Vec<(String, Option<Pos2>)> {
    let corners = room(input.room).corners();
    let note = |(keys, name): &(BoxKeys, String)| {
        let place = bounds(keys, frame);
        if frame.view.expand(1.0).contains_rect(place) {
            return None;
        }
        if is_visible(keys, frame) {
            let [depth, across] = extent(keys, frame.side).map(|[low, high]| fixed(high - low, 1));
            return Some((say::box_cut(name, depth, across), None));
        }
        let distance = fixed(solid(keys).gap_to(&corners), 1);
        Some((say::box_far(name, distance), Some(place.center())))
    };
    let ground = input.ground.filter(|ground| frame.side && !shows_ground(ground, input.room)).map(|ground| {
        let under = frame.screen(0.5 * input.room[1], ground.height);
        (say::ground_below(fixed(-ground.height, 1)), Some(under))
    });
    input.outside.iter().filter_map(note).chain(ground).collect()
}

/// Draws the boxes of obstructions, and marks at the border of the picture for those beyond it. To be drawn before the
/// room.
pub(super) fn show(ui: &Ui, frame: &Frame, input: &Input<'_>, palette: &Palette) {
    if input.outside.is_empty() && !(frame.side && input.ground.is_some()) {
        return;
    }
    let painter = ui.painter().with_clip_rect(frame.view.intersect(ui.clip_rect()));
    painter.rect_filled(frame.view, 0, palette.face);
    let mut names: Vec<Rect> = Vec::new();
    for (keys, name) in input.outside.iter().filter(|(keys, _)| is_visible(keys, frame)) {
        let places = polygon(keys, frame);
        let fill = palette.weak.gamma_multiply(0.3);
        painter.add(Shape::convex_polygon(places.to_vec(), fill, PathStroke::new(1.5, palette.outline)));
        let galley = painter.layout_no_wrap(name.clone(), FontId::proportional(13.0), palette.ink);
        // In the visible corner, off the room, where other words stand.
        let seen = bounds(keys, frame).intersect(frame.view).shrink(3.0);
        let at = Rect::from_min_size(pos2(seen.left(), seen.top()), galley.size());
        let free = !at.intersects(frame.area.expand(22.0)) && names.iter().all(|other| !other.intersects(at));
        if seen.contains_rect(at) && keys.turn == 0.0 && free {
            painter.galley(at.min, galley, palette.ink);
            names.push(at);
        }
    }
    for (_, place) in beyond(input, frame) {
        let Some(place) = place else { continue };
        // An arrow on the border, towards it.
        let at = place.clamp(frame.view.min + vec2(9.0, 9.0), frame.view.max - vec2(9.0, 9.0));
        let way = (place - at).normalized();
        let across = vec2(-way.y, way.x);
        let tip = at + 7.0 * way;
        let corners = vec![tip, tip - 10.0 * way + 5.0 * across, tip - 10.0 * way - 5.0 * across];
        painter.add(Shape::convex_polygon(corners, palette.weak, PathStroke::NONE));
    }
    painter.rect_stroke(frame.view, 0, Stroke::new(1.0, palette.grid), StrokeKind::Inside);
}

/// Draws boxes above or below the room as dashed lines over the plan.
pub(super) fn over(ui: &Ui, frame: &Frame, input: &Input<'_>, palette: &Palette) {
    let painter = ui.painter().with_clip_rect(frame.view.intersect(ui.clip_rect()));
    for (keys, _) in input.outside {
        let mut places = polygon(keys, frame).to_vec();
        if bounds(keys, frame).intersects(frame.area.shrink(1.0)) {
            places.push(places[0]);
            painter.extend(Shape::dashed_line(&places, Stroke::new(1.5, palette.ink), 5.0, 4.0));
        }
    }
}

/// Draws the line that names obstructions and ground beyond the picture, with its full text as tooltip.
pub(super) fn show_beyond(ui: &mut Ui, place: Rect, frame: &Frame, input: &Input<'_>, palette: &Palette) {
    let list: Vec<String> = beyond(input, frame).into_iter().map(|(words, _)| words).collect();
    let Some(first) = list.first() else { return };
    let mut lines = vec![list.join(" · ")];
    if list.len() > 1 {
        lines.push(say::boxes_beyond_first(first, list.len() - 1));
    }
    lines.push(say::boxes_beyond(list.len()));
    let mut galleys =
        lines.into_iter().map(|text| ui.painter().layout_no_wrap(text, FontId::proportional(13.0), palette.weak));
    let Some(galley) = galleys.find(|galley| galley.size().x <= place.width()) else { return };
    let at = Align2::LEFT_CENTER.anchor_size(place.left_center(), galley.size());
    let response = ui.interact(at, ui.scope_id().with("beyond"), Sense::hover());
    ui.painter().galley(at.min, galley, palette.weak);
    crate::app::paint::tile::name(ui, &response, say::BEYOND_PICTURE, &list.join("\n"));
    response.on_hover_text(list.join("\n"));
}

/// Whether obstructions or ground extend beyond a picture of this extent, so that [`show_beyond`] has a text to draw.
pub(super) fn has_beyond(input: &Input<'_>, side: bool, span: Span) -> bool {
    let holds = |extent: [[f64; 2]; 2]| {
        (0..2).all(|axis| span.0[axis][0] <= extent[axis][0] + 1e-9 && extent[axis][1] <= span.0[axis][1] + 1e-9)
    };
    let below = input.ground.is_some_and(|ground| side && !shows_ground(ground, input.room));
    below || input.outside.iter().any(|(keys, _)| !holds(extent(keys, side)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(from: [f64; 3], to: [f64; 3], turn: f64) -> (BoxKeys, String) {
        (BoxKeys { from, to, turn }, "box".into())
    }

    #[test]
    fn near_boxes_are_shown_whole_and_far_ones_take_a_strip() {
        let overhang = keys([-0.5, -1.2, 2.9], [4.5, 0.0, 3.05], 0.0);
        let neighbour = keys([-8.0, -32.0, 0.0], [12.0, -20.0, 9.0], 20.0);
        let room = [4.0, 6.0, 3.0];
        let of = |outside: &[(BoxKeys, String)], side| span(&Input { room, outside, ..Input::nothing() }, side).0;
        assert_eq!(of(&[], false), [[0.0, 6.0], [0.0, 4.0]]);
        let plan = of(std::slice::from_ref(&overhang), false);
        assert_eq!(plan, [[-1.45, 6.0], [-0.75, 4.75]]);
        let section = of(std::slice::from_ref(&overhang), true);
        assert!((section[1][1] - 3.3).abs() < 1e-9 && section[1][0] == 0.0, "{section:?}");
        let both = of(&[overhang, neighbour.clone()], false);
        assert!(both[0][0] == -1.45 && both[0][1] <= 6.25, "{both:?}");
        assert_eq!(of(&[neighbour], true)[0][0], -0.6);
    }

    #[test]
    fn what_does_not_fit_is_told() {
        let room = [4.0, 6.0, 3.0];
        let near = [keys([0.0, -1.0, 0.0], [1.0, 0.0, 2.0], 0.0)];
        let far = [keys([0.0, -30.0, 0.0], [4.0, -20.0, 9.0], 0.0)];
        for (outside, is_beyond) in [(&near, false), (&far, true)] {
            let input = Input { room, outside, ..Input::nothing() };
            let span = span(&input, false);
            let frame = Frame::around(Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 300.0)), span, room, false);
            assert_eq!(has_beyond(&input, false, span), is_beyond);
            let said = beyond(&input, &frame);
            assert_eq!(said.len(), usize::from(is_beyond));
            assert!(!is_beyond || (said[0].0.contains("20.0 m") && said[0].1.is_some()), "{said:?}");
        }
    }
}
