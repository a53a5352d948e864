//! Boxes of obstructions moved and resized by pointer or keys: they remain outside the room, and touch it if they are
//! pushed against it.

use super::input::Frame;
use super::outside::{outline, room, solid};
use super::steps::snapped;
use crate::study::scene_file::BoxKeys;
use crate::texts::{Text, tiles as say};
use egui::Pos2;

/// Minimum size of a box along each axis. \[m\]
const LEAST: f64 = 0.01;
/// Tolerance for lengths typed as decimals, which do not add up exactly. \[m\]
const SLACK: f64 = 1e-6;

/// Returns the name of a face of a box. `axis`: axis perpendicular to the face, 0 x, 1 y, 2 z; `far`: whether it is the
/// face at the larger coordinate.
pub(super) const fn face_word(axis: usize, far: bool) -> Text {
    match (axis, far) {
        (0, false) => say::LEFT_EDGE,
        (0, true) => say::RIGHT_EDGE,
        (1, false) => say::OUTER_EDGE,
        (1, true) => say::INNER_EDGE,
        (_, false) => say::UNDERSIDE,
        (_, true) => say::TOP,
    }
}

/// Whether a box is parallel to the axes of the room, i.e. not rotated about the vertical.
fn is_straight(keys: &BoxKeys) -> bool {
    keys.turn.rem_euclid(360.0) == 0.0
}

/// Returns the faces of a box that can be dragged in a picture: axis perpendicular to the face, whether it is the face
/// at the larger coordinate, and screen position of its middle.
pub(super) fn faces(keys: &BoxKeys, frame: &Frame) -> Vec<(usize, bool, Pos2)> {
    let corners = outline(keys, frame.side);
    let middle = |a: usize, b: usize| {
        let [depth, across] = [0, 1].map(|axis| 0.5 * (corners[a][axis] + corners[b][axis]));
        frame.screen(depth, across)
    };
    if !frame.side {
        // Corners run low x, high x along the near side, then back along the far one.
        return vec![
            (0, false, middle(0, 3)),
            (0, true, middle(1, 2)),
            (1, false, middle(0, 1)),
            (1, true, middle(2, 3)),
        ];
    }
    let mut list = vec![(2, false, middle(0, 1)), (2, true, middle(2, 3))];
    if is_straight(keys) {
        list.extend([(1, false, middle(0, 3)), (1, true, middle(1, 2))]);
    }
    list
}

/// Returns a displacement along x, y and z of the room \[m\], given in a picture along the depth (y) and across it (z
/// if the room is seen from the side, otherwise x) \[m\].
const fn in_room([depth, across]: [f64; 2], side: bool) -> [f64; 3] {
    if side { [0.0, depth, across] } else { [across, depth, 0.0] }
}

fn is_outside(keys: &BoxKeys, size: [f64; 3]) -> bool {
    !solid(keys).overlaps(&room(size), SLACK)
}

/// Returns the wall of the room against which a box is pushed, i.e. the first wall beyond which the whole box lies: the
/// axis perpendicular to it, and whether it is the wall at the larger coordinate. `size` of the room \[m\].
fn stands_before(keys: &BoxKeys, size: [f64; 3]) -> Option<(usize, bool)> {
    let corners = solid(keys).corners();
    let least = |axis: usize| corners.iter().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min);
    let most = |axis: usize| corners.iter().map(|corner| corner[axis]).fold(f64::NEG_INFINITY, f64::max);
    let walls = [(1, false), (2, true), (0, false), (0, true), (1, true), (2, false)];
    walls.into_iter().find(
        |&(axis, beyond)| {
            if beyond { least(axis) >= size[axis] - SLACK } else { most(axis) <= SLACK }
        },
    )
}

/// Returns a box moved by `way` \[m\] along the depth and across it, see [`in_room`], with coordinates rounded to
/// `step` \[m\]; it stops at the wall of the room that it would be pushed through. `size` of the room \[m\]; `None` if
/// the box cannot be moved.
pub(super) fn moved(keys: &BoxKeys, way: [f64; 2], step: f64, size: [f64; 3], side: bool) -> Option<BoxKeys> {
    let mut new = *keys;
    for (axis, way) in in_room(way, side).into_iter().enumerate() {
        if way == 0.0 {
            continue;
        }
        let length = keys.to[axis] - keys.from[axis];
        // The side towards the façade is the one that is measured from it.
        let (from, to) = if axis == 1 {
            let to = snapped(keys.to[1] + way, step);
            (snapped(to - length, 0.0), to)
        } else {
            let from = snapped(keys.from[axis] + way, step);
            (from, snapped(from + length, 0.0))
        };
        (new.from[axis], new.to[axis]) = (from, to);
    }
    if is_outside(&new, size) {
        return Some(new);
    }
    let (axis, beyond) = stands_before(keys, size)?;
    let corners = solid(&new).corners();
    let ends = corners.iter().map(|corner| corner[axis]);
    let back =
        if beyond { size[axis] - ends.fold(f64::INFINITY, f64::min) } else { -ends.fold(f64::NEG_INFINITY, f64::max) };
    // Away from the wall where that does not end on a millimetre.
    let back = 1e-3 * if beyond { (1e3 * back - SLACK).ceil() } else { (1e3 * back + SLACK).floor() };
    new.from[axis] = snapped(new.from[axis] + back, 0.0);
    new.to[axis] = snapped(new.to[axis] + back, 0.0);
    is_outside(&new, size).then_some(new)
}

/// Returns a box with one face, given as by [`faces`], moved by `way` \[m\] along the depth and across it; the opposite
/// face remains. Other parameters as in [`moved`].
pub(super) fn resized(
    keys: &BoxKeys,
    (axis, far): (usize, bool),
    way: [f64; 2],
    step: f64,
    size: [f64; 3],
    side: bool,
) -> Option<BoxKeys> {
    let way = in_room(way, side);
    let (sin, cos) = keys.turn.to_radians().sin_cos();
    // Along the box's own axis.
    let along = match axis {
        0 => cos * way[0] + sin * way[1],
        1 => cos * way[1] - sin * way[0],
        _ => way[2],
    };
    let [low, high] = [keys.from[axis], keys.to[axis]];
    let mut new = *keys;
    if axis == 2 || is_straight(keys) {
        let wall = stands_before(keys, size);
        if far {
            let most = if wall == Some((axis, false)) { 0.0 } else { f64::INFINITY };
            new.to[axis] = snapped(high + along, step).min(most).max(snapped(low + LEAST, 0.0));
        } else {
            let least = if wall == Some((axis, true)) { size[axis] } else { f64::NEG_INFINITY };
            new.from[axis] = snapped(low + along, step).max(least).min(snapped(high - LEAST, 0.0));
        }
        return is_outside(&new, size).then_some(new);
    }
    // A rotated box is rotated about its middle, which moves by half of what it grows.
    let length = snapped(high - low + if far { along } else { -along }, step).max(LEAST);
    let shift = 0.5 * (length - (high - low)) * if far { 1.0 } else { -1.0 };
    let shift = if axis == 0 { [cos * shift, sin * shift] } else { [-sin * shift, cos * shift] };
    for (k, shift) in shift.into_iter().enumerate() {
        let centre = 0.5 * (keys.from[k] + keys.to[k]) + shift;
        let length = if k == axis { length } else { keys.to[k] - keys.from[k] };
        new.from[k] = snapped(centre - 0.5 * length, 0.0);
        new.to[k] = snapped(new.from[k] + length, 0.0);
    }
    is_outside(&new, size).then_some(new)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: [f64; 3] = [4.0, 6.0, 3.0];

    fn overhang() -> BoxKeys {
        BoxKeys { from: [-0.5, -1.2, 2.8], to: [4.5, 0.0, 2.95], turn: 0.0 }
    }

    #[test]
    fn a_box_moves_in_steps_and_is_stopped_by_the_facade() {
        let out = moved(&overhang(), [-0.32, 0.11], 0.05, ROOM, true).unwrap();
        assert_eq!((out.from, out.to), ([-0.5, -1.5, 2.9], [4.5, -0.3, 3.05]));
        let fine = moved(&overhang(), [-0.32, 0.0], 0.01, ROOM, true).unwrap();
        assert_eq!([fine.from[1], fine.to[1]], [-1.52, -0.32]);
        // Pushed into the room it stays against the wall, wherever it goes along it.
        let against = moved(&overhang(), [2.0, 0.4], 0.05, ROOM, false).unwrap();
        assert_eq!((against.from, against.to), ([-0.1, -1.2, 2.8], [4.9, 0.0, 2.95]));
        // Above the roof it may go over the room.
        let above = BoxKeys { from: [1.0, -1.0, 3.2], to: [2.0, -0.5, 4.0], turn: 0.0 };
        assert_eq!(moved(&above, [2.0, 0.0], 0.05, ROOM, false).unwrap().to[1], 1.5);
    }

    #[test]
    fn a_face_moves_alone_and_keeps_out_of_the_room() {
        let longer = resized(&overhang(), (1, false), [-0.33, 0.0], 0.05, ROOM, true).unwrap();
        assert_eq!((longer.from[1], longer.to), (-1.55, overhang().to));
        let wall = resized(&overhang(), (1, true), [1.0, 0.0], 0.05, ROOM, true).unwrap();
        assert_eq!(wall, overhang());
        let thin = resized(&overhang(), (2, true), [0.0, -5.0], 0.05, ROOM, true).unwrap();
        assert!((thin.to[2] - thin.from[2] - LEAST).abs() < 1e-9);
    }

    #[test]
    fn a_turned_box_keeps_its_opposite_face() {
        let keys = BoxKeys { from: [-8.0, -18.0, 0.0], to: [6.0, -12.0, 8.0], turn: 20.0 };
        let (sin, cos) = 20_f64.to_radians().sin_cos();
        // A metre along its own x axis.
        let wider = resized(&keys, (0, true), [sin, cos], 0.05, ROOM, false).unwrap();
        assert!((wider.to[0] - wider.from[0] - 15.0).abs() < 1e-3 && (wider.to[1] - wider.from[1] - 6.0).abs() < 1e-3);
        let corner = |keys: &BoxKeys| solid(keys).corners()[0];
        assert!(corner(&keys).distance(corner(&wider)) < 2e-3);
        let beside = BoxKeys { from: [1.0, -3.0, 0.0], to: [2.0, -0.2, 3.0], turn: 30.0 };
        let pushed = moved(&beside, [4.0, 0.0], 0.05, ROOM, false).unwrap();
        let nearest = solid(&pushed).corners().iter().map(|corner| corner.y).fold(f64::NEG_INFINITY, f64::max);
        assert!(nearest <= 1e-6 && nearest > -2e-3, "{nearest}");
    }
}
