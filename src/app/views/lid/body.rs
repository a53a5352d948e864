//! The luminous intensity distribution of an aperture as a 3D body (photometric solid): its radius in every direction
//! is the intensity; the largest intensity is marked.

use super::scaling::{Scaling, towards};
use crate::app::paint::body::Body;
use crate::app::paint::camera::{Camera, words};
use crate::app::paint::palette::{ColourMap, ColourMapExt as _, Palette};
use crate::app::paint::tile::{self, Foot};
use crate::app::views::Cache;
use crate::compute::direction::{Emergent, Surface};
use crate::compute::lid::Lid;
use crate::compute::lid::c_gamma::{Aim, Peaks};
use crate::drawing::lid_curves::table;
use crate::texts::tiles as say;
use egui::{Rect, Sense, Shape, Stroke, Ui};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Step of the angles γ and C between nodes of the body. \[°\]
const STEP: u16 = 3;
/// Numbers of steps of γ, 0 … 180°, and of C, 0 … 360°.
const STEPS: [usize; 2] = [180 / STEP as usize, 360 / STEP as usize];
/// First camera: from the side, a little from above.
const FIRST: Camera = Camera::from(-0.45, 0.3);
/// Maximum distance from the pointer to a node that it selects. \[points\]
const REACH: f32 = 14.0;

/// Camera and cached body between frames.
#[derive(Debug, Clone)]
pub struct State {
    camera: Camera,
    solid: Cache<u64, Solid>,
}

impl Default for State {
    fn default() -> Self {
        Self { camera: FIRST, solid: Cache::default() }
    }
}

/// Input of the 3D body in one frame.
pub(super) struct Input<'a> {
    /// Luminous intensity distribution of an aperture.
    pub lid: &'a Lid,
    /// Largest intensities of the distribution; `None` until they are computed.
    pub peaks: Option<&'a Peaks>,
    /// Revision number of `lid`, which changes whenever the result does.
    pub revision: u64,
    /// Statement of intensities for the whole aperture or per square metre.
    pub scaling: Scaling,
}

/// Returns the angles C and γ of a node of the body, by its index. \[rad\]
fn angles(node: usize) -> (f64, f64) {
    (TAU * (node % STEPS[1]) as f64 / STEPS[1] as f64, PI * (node / STEPS[1]) as f64 / STEPS[0] as f64)
}

/// Returns an emergent direction of an aperture as a vector in the room frame (x along the façade, y into the room, z
/// up).
fn into_room(surface: Surface, to: Emergent) -> DVec3 {
    surface.room_from_facade(to.0.vector())
}

/// 3D body of intensities, scaled so that the largest one is 1.
#[derive(Debug, Clone)]
struct Solid {
    body: Body,
    /// Intensity of every node. \[cd\]
    values: Vec<f64>,
    /// Largest intensity of the nodes. \[cd\]
    largest: f64,
}

impl Solid {
    fn of(lid: &Lid) -> Self {
        let aim = Aim::of(lid.surface);
        let table = table(lid, STEP);
        let values: Vec<f64> = (0..=STEPS[0]).flat_map(|gamma| table.iter().map(move |list| list[gamma])).collect();
        let largest = values.iter().copied().filter(|value| value.is_finite()).fold(0.0, f64::max);
        let body = Body::new(STEPS[0], STEPS[1], |row, column| {
            let node = row * STEPS[1] + column;
            let (c, gamma) = angles(node);
            let share = if largest > 0.0 { values[node] / largest } else { 0.0 };
            (share * into_room(lid.surface, aim.direction(c, gamma)), ColourMap::Sequential.at(share as f32))
        });
        Self { body, values, largest }
    }
}

/// Draws the body. Returns the line for the node under the pointer.
pub(super) fn show(ui: &mut Ui, rect: Rect, input: &Input<'_>, state: &mut State) -> Option<Foot> {
    let palette = Palette::of(ui.visuals());
    let response = ui.interact(rect, ui.scope_id().with("body"), Sense::click_and_drag());
    if response.clicked() {
        response.request_focus();
    }
    if state.camera.obey(ui, &response, FIRST) {
        ui.ctx().request_repaint();
    }
    let lid = input.lid;
    let view = state.camera.view(DVec3::ZERO, 1.15, rect);
    let painter = ui.painter_at(rect);
    let Solid { body, values, largest } = state.solid.get(input.revision, || Solid::of(lid));
    let ray = |to: DVec3, stroke: Stroke, word: &str, colour| {
        if let (Some((from, _)), Some((end, _))) = (view.screen(DVec3::ZERO), view.screen(to)) {
            painter.line_segment([from, end], stroke);
            words(&painter, rect, end, word, [colour, palette.face.gamma_multiply(0.7)]);
        }
    };
    // The aperture's plane, and what is what in the room.
    let ring = |k: u32| {
        let (sin, cos) = (TAU * f64::from(k) / 64.0).sin_cos();
        let point = if lid.surface == Surface::Facade { DVec3::new(cos, 0.0, sin) } else { DVec3::new(cos, sin, 0.0) };
        Some(view.screen(point)?.0)
    };
    painter.add(Shape::closed_line((0..64).filter_map(ring).collect(), Stroke::new(1.0, palette.outline)));
    let thin = Stroke::new(1.0, palette.weak);
    ray(DVec3::Y, thin, say::INTO_THE_ROOM.get(), palette.weak);
    ray(-DVec3::Z, thin, say::DOWN.get(), palette.weak);
    body.paint(&painter, &view, DVec3::ZERO, 1.0);
    for beam in &lid.beams {
        let to = into_room(lid.surface, beam.direction);
        if let (Some((from, _)), Some((end, _))) = (view.screen(DVec3::ZERO), view.screen(1.1 * to)) {
            painter.extend(Shape::dashed_line(&[from, end], Stroke::new(2.0, palette.beam), 2.0, 4.0));
        }
    }
    let aim = Aim::of(lid.surface);
    let mut text = say::largest_drawn(input.scaling.text(*largest));
    if let Some(peak) = input.peaks.and_then(|peaks| peaks.scattered).filter(|_| *largest > 0.0) {
        let to = aim.direction(peak.c, peak.gamma);
        let value = input.scaling.text(peak.intensity);
        let label = say::peak_alone(&value);
        text = say::peak_to(value, towards(lid.surface, to));
        // The file's mean over its step may be less than the largest value drawn.
        let length = 1.05 * (peak.intensity / *largest).clamp(1.0, 1.1);
        ray(length * into_room(lid.surface, to), Stroke::new(2.0, palette.second), &label, palette.ink);
    }
    tile::name(ui, &response, say::LID_BODY, &text);
    let at = response.hover_pos().filter(|_| !response.dragged())?;
    let node = body.nearest(&view, DVec3::ZERO, 1.0, at, REACH)?;
    let (place, _) = view.screen(body.point(node)?)?;
    painter.circle(place, 3.5, palette.ink, Stroke::new(1.5, palette.face));
    let (c, gamma) = angles(node);
    let to = aim.direction(c, gamma);
    let value = input.scaling.text(values[node]);
    Some(Foot::from([format!("{} · {value}", towards(lid.surface, to)), value]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::lid::EmergentLuminance;

    #[test]
    fn the_body_of_an_even_window_is_the_ball_that_a_diffuser_has() {
        for surface in [Surface::Facade, Surface::Roof] {
            let parts = vec![EmergentLuminance::Uniform(1000.0)];
            let lid = Lid { surface, size: [2.0, 1.5], parts, beams: Vec::new() };
            let Solid { body, largest, .. } = Solid::of(&lid);
            assert!((largest - 3000.0).abs() < 1e-6, "{largest}");
            let inward = if surface == Surface::Facade { DVec3::Y } else { -DVec3::Z };
            for node in 0..(STEPS[0] + 1) * STEPS[1] {
                let point = body.point(node).unwrap();
                // I = I₀ cosθ is a sphere through the origin, half as large, round the half of the normal.
                let off = (point - 0.5 * inward).length();
                assert!(point.length() < 1e-9 || (off - 0.5).abs() < 1e-9, "{surface:?} {point}");
            }
        }
    }
}
