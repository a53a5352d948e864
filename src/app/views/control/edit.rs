//! Editing of the points of a control curve: by dragging, or by keys while the control diagram has the keyboard focus.
//!
//! Profile angles snap to whole degrees and remain between those of the neighbouring points; values snap to those of
//! the states, with Shift held to whole numbers. A double click on the curve adds a point, a right click removes one;
//! drags and double clicks beside the curve change the ranges of the axes. Keys: `,` and `.` select a point, arrows
//! move it, Insert or + adds one after it, Delete removes it.

use super::input::{Input, curve_at, extent};
use crate::app::paint::plot::{Shown, screen};
use egui::{EventFilter, Id, Key, Modifiers, Pos2, Ui};
use egui_plot::PlotTransform;

/// Maximum distance from the pointer to a point of the curve that it selects. \[points of the screen\]
const REACH: f32 = 10.0;
/// Minimum difference of profile angle between neighbouring points of the curve. \[°\]
const GAP: f64 = 1.0;

/// State of the editing between frames: the selected point, and whether it is being dragged.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Editing {
    /// Index of the selected point of the curve, which is marked in the diagram and moved by keys.
    pub chosen: Option<usize>,
    dragged: bool,
}

/// Returns the index of the point of a curve nearest to a screen position within [`REACH`]; `None` if there is none.
fn near(transform: &PlotTransform, curve: &[[f64; 2]], at: Pos2) -> Option<usize> {
    let distance = |k: usize| screen(transform, curve[k]).distance(at);
    (0..curve.len()).filter(|&k| distance(k) <= REACH).min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
}

/// Whether a screen position is on the curve, or on its horizontal continuation beyond its ends, within [`REACH`].
fn on_line(transform: &PlotTransform, curve: &[[f64; 2]], at: Pos2) -> bool {
    // On a steep part the line is far above or below a place right beside it.
    let heights = [-0.5, 0.0, 0.5].map(|aside| {
        let angle = transform.value_from_position(at + egui::vec2(aside * REACH, 0.0)).x;
        curve_at(curve, angle).map_or(f32::NAN, |value| screen(transform, [angle, value]).y)
    });
    let top = heights.into_iter().fold(f32::INFINITY, f32::min);
    let bottom = heights.into_iter().fold(f32::NEG_INFINITY, f32::max);
    (top - REACH..=bottom + REACH).contains(&at.y)
}

/// Whether the pointer is on the curve of the plot `id` or drags a point, so that a drag must not change the ranges of
/// the axes.
pub fn held(ui: &Ui, id: Id, input: &Input<'_>, editing: &Editing) -> bool {
    let pointer = ui.input(|i| i.pointer.press_origin().or(i.pointer.latest_pos()));
    let before = Shown::transform_before(ui, id);
    let on_curve = before.zip(pointer).is_some_and(|(transform, at)| {
        near(&transform, input.curve, at).is_some() || on_line(&transform, input.curve, at)
    });
    input.editable && (editing.dragged || on_curve)
}

/// Returns the value of the state that is nearest to a value, both in the unit of the states.
fn snapped(input: &Input<'_>, value: f64) -> f64 {
    let states = input.states.iter().map(|state| state.value);
    states.min_by(|a, b| (a - value).abs().total_cmp(&(b - value).abs())).unwrap_or(value)
}

/// Returns the curve with the point `index` moved to a profile angle \[°\] and a value; the angle is limited to that
/// between the neighbouring points and to 0 … 90°.
fn moved(curve: &[[f64; 2]], index: usize, [angle, value]: [f64; 2]) -> Vec<[f64; 2]> {
    let mut curve = curve.to_vec();
    let low = if index > 0 { curve[index - 1][0] + GAP } else { 0.0_f64.min(curve[index][0]) };
    let high = curve.get(index + 1).map_or(90.0, |next| next[0] - GAP);
    curve[index] = [angle.round().clamp(low.min(high), high.max(low)), value];
    curve
}

/// Returns the curve with a point added on it at a profile angle \[°\], and the index of that point; `None` if another
/// point is too near or the angle is outside 0 … 90°.
fn with_point(curve: &[[f64; 2]], angle: f64) -> Option<(Vec<[f64; 2]>, usize)> {
    let angle = angle.round();
    let value = curve_at(curve, angle)?;
    let room = curve.iter().all(|point| (point[0] - angle).abs() >= GAP) && (0.0..=90.0).contains(&angle);
    let at = curve.partition_point(|point| point[0] < angle);
    room.then(|| {
        let mut curve = curve.to_vec();
        curve.insert(at, [angle, value]);
        (curve, at)
    })
}

/// Returns the curve with the point `index` removed; `None` if it is the only one.
fn without(curve: &[[f64; 2]], index: usize) -> Option<Vec<[f64; 2]>> {
    (curve.len() > 1 && index < curve.len()).then(|| {
        let mut curve = curve.to_vec();
        curve.remove(index);
        curve
    })
}

/// Executes pointer and keys of this frame on the curve. Returns the new curve if it changed, and whether a click was
/// used for it.
pub fn edit(
    ui: &Ui,
    Shown { response, transform, .. }: &Shown,
    input: &Input<'_>,
    editing: &mut Editing,
) -> (Option<Vec<[f64; 2]>>, bool) {
    let curve = input.curve;
    // Undo or another product may have left a shorter curve.
    editing.chosen = editing.chosen.filter(|&k| k < curve.len());
    let pointer = response.interact_pointer_pos();
    let mut taken = editing.dragged;
    let mut new = None;
    if response.drag_started() {
        // Where the button went down: when egui calls it a drag, the pointer has left the point already.
        let origin = ui.input(|i| i.pointer.press_origin()).or(pointer);
        let found = origin.and_then(|at| near(transform, curve, at));
        editing.dragged = found.is_some();
        editing.chosen = found.or(editing.chosen);
    }
    if editing.dragged
        && let (Some(index), Some(at)) = (editing.chosen, pointer)
    {
        taken = true;
        // Pulled out of the chart a point stays at its edge, where it can be taken hold of again.
        let place = transform.value_from_position(transform.frame().clamp(at));
        let (lo, hi) = extent(input);
        let free = ui.input(|i| i.modifiers.shift);
        let value = if free { place.y.round().clamp(lo, hi) } else { snapped(input, place.y) };
        new = Some(moved(curve, index, [place.x, value]));
    }
    if response.drag_stopped() {
        editing.dragged = false;
    }
    let here = pointer.and_then(|at| near(transform, curve, at));
    if response.clicked() && here.is_some() {
        (editing.chosen, taken) = (here, true);
    }
    if response.double_clicked() && here.is_none() {
        let on_line = pointer.filter(|at| on_line(transform, curve, *at));
        if let Some((curve, at)) = on_line.and_then(|at| with_point(curve, transform.value_from_position(at).x)) {
            (new, editing.chosen, taken) = (Some(curve), Some(at), true);
        }
    }
    if response.secondary_clicked()
        && let Some(index) = here
    {
        (new, editing.chosen) = (without(curve, index), None);
    }
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    if response.has_focus() {
        // Else arrows would move the focus to other tiles instead of the point.
        let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        new = by_keys(ui, input, editing).or(new);
    }
    // Snapping mostly gives the same curve: that is not an edit, and costs neither a run nor a step of undo.
    (new.filter(|new| new != curve), taken)
}

/// Executes the keys of this frame on the curve. Returns the new curve if it changed.
fn by_keys(ui: &Ui, input: &Input<'_>, editing: &mut Editing) -> Option<Vec<[f64; 2]>> {
    let curve = input.curve;
    let last = curve.len().checked_sub(1)?;
    // Removed from the input, so that nothing else obeys them too; with Shift as well, as + is typed on many keyboards.
    let pressed =
        |key: Key| ui.input_mut(|i| i.consume_key(Modifiers::NONE, key) || i.consume_key(Modifiers::SHIFT, key));
    // With no point chosen backwards starts at the last one, forwards at the first.
    if pressed(Key::Comma) {
        editing.chosen = Some(editing.chosen.map_or(last, |k| k.saturating_sub(1)));
    }
    if pressed(Key::Period) {
        editing.chosen = Some(editing.chosen.map_or(0, |k| (k + 1).min(last)));
    }
    let step = [
        (Key::ArrowLeft, [-1.0, 0.0]),
        (Key::ArrowRight, [1.0, 0.0]),
        (Key::ArrowDown, [0.0, -1.0]),
        (Key::ArrowUp, [0.0, 1.0]),
    ]
    .into_iter()
    .find_map(|(key, step)| pressed(key).then_some(step));
    let index = editing.chosen?;
    let [angle, value] = curve[index];
    if let Some([right, up]) = step {
        let states = || input.states.iter().map(|state| state.value);
        // Numbers that went through radians differ in their last digits: a state must not be its own neighbour.
        let next = if up > 0.0 {
            states().filter(|v| *v > value + 1e-9).fold(f64::INFINITY, f64::min)
        } else {
            states().filter(|v| *v < value - 1e-9).fold(f64::NEG_INFINITY, f64::max)
        };
        // Beyond the last state there is nothing to snap to: the point stays.
        let value = if up != 0.0 && next.is_finite() { next } else { value };
        return Some(moved(curve, index, [angle + right, value]));
    }
    if pressed(Key::Insert) || pressed(Key::Plus) {
        // After the last point the chart's edge stands for a neighbour.
        let next = curve.get(index + 1).map_or(90.0, |next| next[0]);
        let (curve, at) = with_point(curve, 0.5 * (angle + next))?;
        editing.chosen = Some(at);
        return Some(curve);
    }
    if pressed(Key::Delete) || pressed(Key::Backspace) {
        let curve = without(curve, index)?;
        editing.chosen = Some(index.min(curve.len() - 1));
        return Some(curve);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_stay_in_order_and_a_curve_keeps_one() {
        let curve = [[0.0, 60.0], [30.0, 20.0], [60.0, 0.0]];
        assert_eq!(moved(&curve, 1, [75.0, 10.0])[1], [59.0, 10.0]);
        assert_eq!(moved(&curve, 0, [-20.0, 10.0])[0], [0.0, 10.0]);
        assert_eq!(moved(&curve, 2, [95.3, 5.0])[2], [90.0, 5.0]);
        let (more, at) = with_point(&curve, 45.2).unwrap();
        assert_eq!((more[at], at, more.len()), ([45.0, 10.0], 2, 4));
        assert!(with_point(&curve, 30.3).is_none());
        assert_eq!(without(&curve, 1).unwrap(), [[0.0, 60.0], [60.0, 0.0]]);
        assert!(without(&[[0.0, 1.0]], 0).is_none() && without(&curve, 7).is_none());
    }
}
