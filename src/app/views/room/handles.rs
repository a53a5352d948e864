//! Handles of apertures, sensor plane, sensor points and obstructions, by which these are moved with the pointer or,
//! while a handle has the keyboard focus, by arrow keys.

use super::boxes;
use super::input::{Action, Frame, Input, Opening};
use super::outside;
use super::steps::{STEPS, snapped};
use crate::app::paint::palette::Palette;
use crate::app::paint::tile;
use crate::compute::direction::Surface;
use crate::texts::{Text, fixed, tiles as say};
use egui::{
    Align2, CursorIcon, EventFilter, FontId, Id, Key, Pos2, Rect, Response, Sense, Shape, Stroke, StrokeKind, Ui, vec2,
};

/// Minimum width and height of an aperture. \[m\]
const LEAST: f64 = 0.05;
/// Half the width and height of the area of a handle in which it can be grabbed. \[points\]
const REACH: f32 = 6.0;

/// Object, or part of it, that a handle moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Part {
    /// Edge of an aperture: index of the aperture, axis of the aperture perpendicular to the edge, and whether it is
    /// the edge at the larger coordinate.
    Edge { opening: usize, axis: usize, far: bool },
    /// Whole aperture, by its index.
    Opening(usize),
    /// Height of the sensor plane.
    Plane,
    /// Listed sensor point, by its index.
    Point(usize),
    /// Whole box of an obstruction, by its index.
    Solid(usize),
    /// Face of an obstruction's box: index of the box, axis perpendicular to the face, and whether it is the face at
    /// the larger coordinate.
    Face { solid: usize, axis: usize, far: bool },
}

/// Handle that is being dragged, with its object as it was at the start of the drag.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Held {
    id: Id,
    from: Pos2,
    start: Action,
}

/// Handle: object to move, area on the screen in which it can be grabbed, and its name.
struct Handle {
    part: Part,
    place: Rect,
    name: String,
}

/// Returns the axes of an aperture that run in a picture along the depth of the room and across it. `surface` of the
/// aperture; `side`: whether the room is seen from the side.
const fn axes(surface: Surface, side: bool) -> [Option<usize>; 2] {
    match (surface, side) {
        (Surface::Facade, false) => [None, Some(0)],
        (Surface::Facade, true) => [None, Some(1)],
        (Surface::Roof, false) => [Some(1), Some(0)],
        (Surface::Roof, true) => [Some(1), None],
    }
}

/// Returns the size of a surface of the room along the two axes of its apertures. \[m\]
const fn extent(surface: Surface, room: [f64; 3]) -> [f64; 2] {
    match surface {
        Surface::Facade => [room[0], room[2]],
        Surface::Roof => [room[0], room[1]],
    }
}

const fn edge_word(surface: Surface, axis: usize, far: bool) -> Text {
    match (surface, axis, far) {
        (_, 0, false) => say::LEFT_EDGE,
        (_, 0, true) => say::RIGHT_EDGE,
        (Surface::Facade, _, false) => say::SILL,
        (Surface::Facade, _, true) => say::HEAD,
        (Surface::Roof, _, false) => say::NEAR_EDGE,
        (Surface::Roof, _, true) => say::FAR_EDGE,
    }
}

/// Returns an aperture moved by `way` \[m\] along its two axes, or with only one edge moved, with coordinates rounded
/// to `step` \[m\] and inside its surface. `room`: size of the room \[m\].
fn moved(part: Part, start: Opening, way: [f64; 2], step: f64, room: [f64; 3]) -> Opening {
    let (mut new, extent) = (start, extent(start.surface, room));
    match part {
        Part::Edge { axis, far, .. } => {
            let [low, high] = [start.origin[axis], start.origin[axis] + start.size[axis]];
            if far {
                let high = snapped(high + way[axis], step).clamp(low + LEAST, extent[axis].max(low + LEAST));
                new.size[axis] = snapped(high - low, 0.0);
            } else {
                new.origin[axis] = snapped(low + way[axis], step).clamp(0.0, (high - LEAST).max(0.0));
                new.size[axis] = snapped(high - new.origin[axis], 0.0);
            }
        }
        _ => {
            for axis in 0..2 {
                let most = (extent[axis] - start.size[axis]).max(0.0);
                let to = start.origin[axis] + way[axis];
                new.origin[axis] =
                    if way[axis] == 0.0 { start.origin[axis] } else { snapped(to, step) }.clamp(0.0, most);
            }
        }
    }
    new
}

fn overlap(a: &Opening, b: &Opening) -> bool {
    let along = |k: usize| (a.origin[k] + a.size[k]).min(b.origin[k] + b.size[k]) - a.origin[k].max(b.origin[k]) > 1e-6;
    a.surface == b.surface && along(0) && along(1)
}

/// Returns the handles of the obstructions' boxes in the order of drawing: boxes from the largest to the smallest, then
/// faces. `all`: whether to include handles outside the picture, since a dragged object may leave it.
fn solids(input: &Input<'_>, frame: &Frame, all: bool) -> Vec<Handle> {
    let bodies = input.outside.iter().enumerate().filter_map(|(number, (keys, name))| {
        let place = outside::bounds(keys, frame).expand(2.0);
        let place = if all { place } else { place.intersect(frame.view) };
        place.is_positive().then(|| Handle { part: Part::Solid(number), place, name: say::move_box(name) })
    });
    let mut list: Vec<Handle> = bodies.collect();
    list.sort_by(|a, b| b.place.area().total_cmp(&a.place.area()));
    for (number, (keys, name)) in input.outside.iter().enumerate() {
        for (axis, far, at) in boxes::faces(keys, frame) {
            // Beside the box: a slab is thinner than a handle.
            let middle = outside::bounds(keys, frame).center();
            let way = at - middle;
            let at = at + REACH * if way.length() > 0.5 { way.normalized() } else { vec2(0.0, 0.0) };
            if all || frame.view.expand(REACH).contains(at) {
                let place = Rect::from_center_size(at, vec2(2.0, 2.0) * REACH);
                let name = say::box_face(name, boxes::face_word(axis, far));
                list.push(Handle { part: Part::Face { solid: number, axis, far }, place, name });
            }
        }
    }
    list
}

/// Returns all handles of a picture in the order of drawing. `held`: whether one is being dragged.
fn handles(input: &Input<'_>, frame: &Frame, held: bool) -> Vec<Handle> {
    let mut list = solids(input, frame, held);
    if let Some(z) = input.plane_z.filter(|_| frame.side) {
        let place = Rect::from_two_pos(frame.screen(0.0, z), frame.screen(input.room[1], z)).expand2(vec2(0.0, REACH));
        list.push(Handle { part: Part::Plane, place, name: say::SENSOR_PLANE.into() });
    }
    for (number, point) in input.points.iter().enumerate() {
        let at = frame.screen(point[1], if frame.side { point[2] } else { point[0] });
        let place = Rect::from_center_size(at, vec2(2.0, 2.0) * REACH);
        list.push(Handle { part: Part::Point(number), place, name: say::sensor(number + 1) });
    }
    for (number, opening) in input.apertures.iter().enumerate() {
        let rect = frame.opening(opening, input.room);
        list.push(Handle {
            part: Part::Opening(number),
            place: rect.expand(REACH),
            name: say::move_aperture(number + 1),
        });
        let [along, across] = axes(opening.surface, frame.side);
        // Where a larger number of the room lies: depth to the right, x down, z up.
        let (low, high) = if frame.side { (rect.bottom(), rect.top()) } else { (rect.top(), rect.bottom()) };
        let middle = rect.center();
        let ends = [
            (along, [egui::pos2(rect.left(), middle.y), egui::pos2(rect.right(), middle.y)]),
            (across, [egui::pos2(middle.x, low), egui::pos2(middle.x, high)]),
        ];
        for (axis, places) in ends {
            let Some(axis) = axis else { continue };
            for (far, at) in [false, true].into_iter().zip(places) {
                let place = Rect::from_center_size(at, vec2(2.0, 2.0) * REACH);
                let name = say::aperture_edge(number + 1, edge_word(opening.surface, axis, far));
                list.push(Handle { part: Part::Edge { opening: number, axis, far }, place, name });
            }
        }
    }
    list
}

/// Returns the current position of an object, as a request that would leave it there; `None` if there is no such
/// object.
fn present(part: Part, input: &Input<'_>) -> Option<Action> {
    match part {
        Part::Edge { opening: number, .. } | Part::Opening(number) => {
            Some(Action::OpeningMoved(number, *input.apertures.get(number)?))
        }
        Part::Plane => input.plane_z.map(Action::PlaneMoved),
        Part::Point(number) => Some(Action::PointMoved(number, *input.points.get(number)?)),
        Part::Solid(number) | Part::Face { solid: number, .. } => {
            Some(Action::BoxMoved(number, input.outside.get(number)?.0))
        }
    }
}

/// Returns the request that moves an object by `way` \[m\] along the depth and across it in a picture, from its
/// position `start`, with coordinates rounded to `step` \[m\]; `None` if it cannot be moved.
fn target(part: Part, start: Action, way: [f64; 2], step: f64, input: &Input<'_>, side: bool) -> Option<Action> {
    match start {
        Action::OpeningMoved(number, opening) => {
            let mut along = [0.0; 2];
            for (axis, way) in axes(opening.surface, side).into_iter().zip(way) {
                if let Some(axis) = axis {
                    along[axis] = way;
                }
            }
            let new = moved(part, opening, along, step, input.room);
            // Apertures must not overlap: where they would, the aperture does not follow the pointer.
            let free = |(other, placed): (usize, &Opening)| other == number || !overlap(&new, placed);
            input.apertures.iter().enumerate().all(free).then_some(Action::OpeningMoved(number, new))
        }
        Action::PlaneMoved(z) => Some(Action::PlaneMoved(snapped(z + way[1], step).clamp(0.0, input.room[2]))),
        Action::PointMoved(number, mut point) => {
            for (axis, way) in [1, if side { 2 } else { 0 }].into_iter().zip(way) {
                if way != 0.0 {
                    point[axis] = snapped(point[axis] + way, step).clamp(0.0, input.room[axis]);
                }
            }
            Some(Action::PointMoved(number, point))
        }
        Action::BoxMoved(number, keys) => {
            let new = match part {
                Part::Face { axis, far, .. } => boxes::resized(&keys, (axis, far), way, step, input.room, side),
                _ => boxes::moved(&keys, way, step, input.room, side),
            };
            new.map(|new| Action::BoxMoved(number, new))
        }
        Action::Look(_) | Action::BoxGone(_) => None,
    }
}

/// Returns position (and size) of an object in metres as text.
fn metres(part: Part, at: Action) -> String {
    match (part, at) {
        (Part::Edge { axis, .. }, Action::OpeningMoved(_, one)) => {
            let [low, size] = [one.origin[axis], one.size[axis]];
            say::from_to_metres(fixed(low, 2), fixed(low + size, 2), fixed(size, 2))
        }
        (_, Action::OpeningMoved(_, one)) => {
            let up = if one.surface == Surface::Facade { "z" } else { "y" };
            format!("x {} m, {up} {} m", fixed(one.origin[0], 2), fixed(one.origin[1], 2))
        }
        (_, Action::PlaneMoved(z)) => format!("z {} m", fixed(z, 2)),
        (_, Action::PointMoved(_, point)) => {
            let [x, y, z] = point.map(|way| fixed(way, 2));
            format!("x {x} m, y {y} m, z {z} m")
        }
        (Part::Face { axis, .. }, Action::BoxMoved(_, keys)) => {
            let [low, high] = [keys.from[axis], keys.to[axis]];
            say::from_to_metres(fixed(low, 2), fixed(high, 2), fixed(high - low, 2))
        }
        (_, Action::BoxMoved(_, keys)) => {
            let part = |axis: usize| format!("{} … {}", fixed(keys.from[axis], 2), fixed(keys.to[axis], 2));
            format!("x {} m, y {} m, z {} m", part(0), part(1), part(2))
        }
        (_, Action::Look(_) | Action::BoxGone(_)) => String::new(),
    }
}

/// Returns the displacement by the arrow keys of this frame, as numbers of steps along the depth and across it.
fn keys(ui: &Ui, response: &Response, side: bool) -> [f64; 2] {
    if !response.has_focus() {
        return [0.0; 2];
    }
    let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    let pressed = |key| f64::from(u8::from(ui.input(|input| input.key_pressed(key))));
    let up = pressed(Key::ArrowUp) - pressed(Key::ArrowDown);
    [pressed(Key::ArrowRight) - pressed(Key::ArrowLeft), if side { up } else { -up }]
}

/// Draws all handles of a picture, and adds the requests of the user to `actions`. `held`: dragged handle, stored
/// between frames.
pub(super) fn show(ui: &mut Ui, input: &Input<'_>, frame: &Frame, held: &mut Option<Held>, actions: &mut Vec<Action>) {
    let palette = Palette::of(ui.visuals());
    for Handle { part, place, name } in handles(input, frame, held.is_some()) {
        let id = ui.scope_id().with(("handle", part, frame.side));
        let response = ui.interact(place, id, Sense::click_and_drag());
        let response = response.on_hover_cursor(match part {
            Part::Edge { axis, opening, .. } => {
                let surface = input.apertures[opening].surface;
                if axes(surface, frame.side)[0] == Some(axis) {
                    CursorIcon::ResizeHorizontal
                } else {
                    CursorIcon::ResizeVertical
                }
            }
            Part::Plane => CursorIcon::ResizeVertical,
            Part::Face { axis: 1, .. } => CursorIcon::ResizeHorizontal,
            Part::Face { .. } => CursorIcon::ResizeVertical,
            Part::Opening(_) | Part::Point(_) | Part::Solid(_) => CursorIcon::Move,
        });
        let Some(now) = present(part, input) else { continue };
        tile::name(ui, &response, &name, &metres(part, now));
        let step = STEPS[usize::from(ui.input(|input| input.modifiers.shift))];
        if response.drag_started()
            && let Some(from) = ui.input(|input| input.pointer.press_origin())
        {
            *held = Some(Held { id, from, start: now });
        }
        let mut asked = None;
        if let (Some(grip), Some(at)) =
            (held.filter(|grip| grip.id == id && response.dragged()), response.interact_pointer_pos())
        {
            let ((d0, a0), (d1, a1)) = (frame.room(grip.from), frame.room(at));
            asked = target(part, grip.start, [d1 - d0, a1 - a0], step, input, frame.side);
        }
        let way = keys(ui, &response, frame.side);
        if way != [0.0; 2] {
            asked = target(part, now, way.map(|steps| steps * step), step, input, frame.side);
        }
        actions.extend(asked.filter(|asked| *asked != now));
        if let Part::Solid(number) = part
            && response.has_focus()
            && ui.input_mut(|input| input.consume_key(egui::Modifiers::NONE, Key::Delete))
        {
            actions.push(Action::BoxGone(number));
        }
        if response.drag_stopped() {
            *held = None;
        }
        let taken = response.dragged() || response.has_focus();
        if response.hovered() || taken {
            let stroke = Stroke::new(if taken { 2.0 } else { 1.0 }, palette.ink);
            match part {
                Part::Plane => ui.painter().hline(place.x_range(), place.center().y, stroke),
                Part::Solid(number) => {
                    let painter = ui.painter().with_clip_rect(frame.view.intersect(ui.clip_rect()));
                    painter.add(Shape::closed_line(outside::polygon(&input.outside[number].0, frame).to_vec(), stroke))
                }
                _ => ui.painter().rect_stroke(place.shrink(2.0), 2, stroke, StrokeKind::Middle),
            };
        }
        if taken {
            label(ui, place, &metres(part, asked.unwrap_or(now)), frame.view, &palette);
        }
    }
}

/// Draws text beside a handle (`place`), inside the area of the picture.
fn label(ui: &Ui, place: Rect, text: &str, area: Rect, palette: &Palette) {
    let galley = ui.painter().layout_no_wrap(text.to_owned(), FontId::proportional(13.0), palette.ink);
    let size = galley.size() + vec2(8.0, 4.0);
    let wanted = Align2::LEFT_BOTTOM.anchor_size(place.right_top() + vec2(4.0, -2.0), size);
    let limits = area.expand2(vec2(0.0, 10.0));
    let shift = vec2(
        (limits.right() - wanted.right()).min(0.0) + (limits.left() - wanted.left()).max(0.0),
        (limits.top() - wanted.top()).max(0.0),
    );
    let rect = wanted.translate(shift);
    ui.painter().add(Shape::rect_filled(rect, 3, palette.face));
    ui.painter().galley(rect.min + vec2(4.0, 2.0), galley, palette.ink);
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: [f64; 3] = [4.0, 6.0, 3.0];

    fn window() -> Opening {
        Opening { surface: Surface::Facade, origin: [0.5, 0.9], size: [3.0, 1.8] }
    }

    #[test]
    fn edges_snap_keep_the_other_edge_and_stay_in_the_wall() {
        let sill = Part::Edge { opening: 0, axis: 1, far: false };
        let up = moved(sill, window(), [0.0, 0.113], 0.05, ROOM);
        assert_eq!((up.origin, up.size), ([0.5, 1.0], [3.0, 1.7]));
        let fine = moved(sill, window(), [0.0, 0.113], 0.01, ROOM);
        assert_eq!((fine.origin[1], fine.size[1]), (1.01, 1.69));
        let floor = moved(sill, window(), [0.0, -9.0], 0.05, ROOM);
        assert_eq!((floor.origin[1], floor.size[1]), (0.0, 2.7));
        let head = Part::Edge { opening: 0, axis: 1, far: true };
        assert_eq!(moved(head, window(), [0.0, 9.0], 0.05, ROOM).size[1], 2.1);
        assert_eq!(moved(head, window(), [0.0, -9.0], 0.05, ROOM).size[1], LEAST);
    }

    #[test]
    fn a_whole_window_keeps_its_size_and_openings_keep_apart() {
        let all = moved(Part::Opening(0), window(), [9.0, 0.0], 0.05, ROOM);
        assert_eq!((all.origin, all.size), ([1.0, 0.9], [3.0, 1.8]));
        let one = Opening { surface: Surface::Facade, origin: [0.0, 1.0], size: [1.0, 1.0] };
        let two = Opening { origin: [1.5, 1.0], ..one };
        let apertures = [one, two];
        let input = Input { apertures: &apertures, room: ROOM, ..Input::nothing() };
        let start = Action::OpeningMoved(0, one);
        let to = |way| target(Part::Opening(0), start, [0.0, way], 0.05, &input, false);
        assert_eq!(to(0.5), Some(Action::OpeningMoved(0, Opening { origin: [0.5, 1.0], ..one })));
        assert_eq!(to(0.8), None);
    }

    #[test]
    fn plane_and_points_move_in_their_picture() {
        let input = Input { room: ROOM, plane_z: Some(0.85), ..Input::nothing() };
        let plane = target(Part::Plane, Action::PlaneMoved(0.85), [3.0, 0.22], 0.05, &input, true);
        assert_eq!(plane, Some(Action::PlaneMoved(1.05)));
        let point =
            |side| target(Part::Point(0), Action::PointMoved(0, [1.0, 2.0, 0.8]), [0.31, -9.0], 0.05, &input, side);
        assert_eq!(point(false), Some(Action::PointMoved(0, [0.0, 2.3, 0.8])));
        assert_eq!(point(true), Some(Action::PointMoved(0, [1.0, 2.3, 0.0])));
    }
}
