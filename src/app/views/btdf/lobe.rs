//! 3D polar surface of the scattered light for one incident direction: the radius in every emergent direction is the
//! value q or q·cosθ, on a linear or logarithmic scale.

use super::place::Place;
use super::words::{drawn, leaving_text};
use crate::app::paint::body::Body;
use crate::app::paint::camera::{Camera, View, words};
use crate::app::paint::colour_scale::{ColourScale, ColourScaleExt as _};
use crate::app::paint::palette::Palette;
use crate::app::paint::tile::{self, Foot};
use crate::app::views::Cache;
use crate::compute::btdf::Indicatrix;
use crate::compute::direction::{Dir, Facade, Incident, Surface};
use crate::texts::tiles as say;
use egui::{Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, pos2};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Numbers of steps of the emergent directions' polar angle, 0 … 90°, and azimuth, 0 … 360°.
const STEPS: [usize; 2] = [48, 96];
/// First camera: from the side, a little from outside and above.
const FIRST: Camera = Camera::from(-0.45, 0.3);
/// Maximum distance from the pointer to a node that it selects. \[points\]
const REACH: f32 = 14.0;

/// Key of the cached surface: revision number of the data and incident direction, whether q·cosθ is drawn, and scale.
type BodyKey = ((u64, [u64; 3]), bool, ColourScale);

/// Camera and cached surface between frames.
#[derive(Debug, Clone)]
pub struct State {
    camera: Camera,
    body: Cache<BodyKey, Body>,
}

impl Default for State {
    fn default() -> Self {
        Self { camera: FIRST, body: Cache::default() }
    }
}

/// Input of the polar surface in one frame.
pub(super) struct Input<'a> {
    /// Scattered light of the incident direction: q for every emergent direction.
    pub indicatrix: &'a Indicatrix,
    /// Incident direction, in the façade frame.
    pub direction: Incident,
    /// Regular transmittance for this incident direction.
    pub regular: f64,
    /// Common scale of radius and colours.
    pub scale: &'a ColourScale,
    /// Whether q·cosθ is drawn instead of q.
    pub weighted: bool,
    /// Revision number of the data, and the incident direction as bits.
    pub key: (u64, [u64; 3]),
}

/// Returns the direction of undeviated light for a node of the surface: row = step of the polar angle, column = step of
/// the azimuth.
fn node(row: usize, column: usize) -> Dir<Facade> {
    Dir::from_theta_phi(FRAC_PI_2 * row as f64 / STEPS[0] as f64, TAU * column as f64 / STEPS[1] as f64)
}

/// Returns the emergent direction of undeviated light as a vector in the room frame (x along the façade, y into the
/// room, z up).
fn into_room(through: Dir<Facade>) -> DVec3 {
    Surface::Facade.room_from_facade(-through.vector())
}

/// Returns the value of an emergent direction, given by the direction of undeviated light: q or q·cosθ of its cell.
/// \[1/sr\]
fn value(input: &Input<'_>, through: Dir<Facade>) -> f64 {
    let Indicatrix { basis, q } = input.indicatrix;
    basis.index(through).map_or(0.0, |index| drawn(q[index], &basis.cell(index), input.weighted))
}

fn make(input: &Input<'_>) -> Body {
    Body::new(STEPS[0], STEPS[1], |row, column| {
        let through = node(row, column);
        let value = value(input, through);
        let radius = f64::from(input.scale.fraction(value).clamp(0.0, 1.0));
        (radius * into_room(through), input.scale.colour(value))
    })
}

/// Draws an arc of a unit circle in 3D, as far as it lies in front of the camera. `at`: point at an angle \[rad\];
/// `ends`: first and last angle \[rad\].
fn arc(painter: &Painter, view: &View, at: impl Fn(f64) -> DVec3, ends: [f64; 2], stroke: Stroke) {
    let angle = |k: u32| ends[0] + (ends[1] - ends[0]) * f64::from(k) / 48.0;
    let places: Vec<Pos2> = (0..=48).filter_map(|k| Some(view.screen(at(angle(k)))?.0)).collect();
    painter.add(Shape::line(places, stroke));
}

/// Draws unit circles in the plane of the façade and half circles in the horizontal and the vertical plane of the room,
/// and the directions "up" and "into the room".
fn axes(painter: &Painter, view: &View, palette: &Palette) {
    let stroke = Stroke::new(1.0, palette.outline);
    arc(painter, view, |a| DVec3::new(a.cos(), 0.0, a.sin()), [0.0, TAU], stroke);
    arc(painter, view, |a| DVec3::new(a.cos(), a.sin(), 0.0), [0.0, std::f64::consts::PI], stroke);
    arc(painter, view, |a| DVec3::new(0.0, a.cos(), a.sin()), [-FRAC_PI_2, FRAC_PI_2], stroke);
    for (end, word) in [(DVec3::Z, say::UP), (DVec3::Y, say::INTO_THE_ROOM)] {
        if let (Some((from, _)), Some((to, _))) = (view.screen(DVec3::ZERO), view.screen(1.12 * end)) {
            painter.line_segment([from, to], Stroke::new(1.0, palette.weak));
            words(painter, painter.clip_rect(), to, word.get(), [palette.weak, egui::Color32::TRANSPARENT]);
        }
    }
}

/// Draws the surface with the incident direction as an arrow. Returns text and value \[1/sr\] for the node under the
/// pointer.
pub(super) fn show(ui: &mut Ui, place: &Place, input: &Input<'_>, state: &mut State) -> (Option<Foot>, Option<f64>) {
    let palette = Palette::of(ui.visuals());
    let bottom = place.legend.map_or(place.rect.bottom(), |legend| legend.top());
    let rect = Rect::from_min_max(place.rect.min, pos2(place.rect.right(), bottom));
    let response = ui.interact(rect, ui.scope_id().with("lobe"), Sense::click_and_drag());
    if response.clicked() {
        response.request_focus();
    }
    if state.camera.obey(ui, &response, FIRST) {
        ui.ctx().request_repaint();
    }
    let view = state.camera.view(DVec3::ZERO, 1.15, rect);
    let painter = ui.painter_at(rect);
    axes(&painter, &view, &palette);
    let body = state.body.get((input.key, input.weighted, input.scale.clone()), || make(input));
    body.paint(&painter, &view, DVec3::ZERO, 1.0);
    let from = Surface::Facade.room_from_facade(input.direction.0.vector());
    if let (Some((start, _)), Some((end, _))) = (view.screen(1.1 * from), view.screen(0.04 * from)) {
        painter.arrow(start, end - start, Stroke::new(2.5, palette.sun));
    }
    if input.regular > 0.0
        && let (Some((start, _)), Some((end, _))) = (view.screen(DVec3::ZERO), view.screen(-1.1 * from))
    {
        painter.extend(Shape::dashed_line(&[start, end], Stroke::new(2.0, palette.beam), 3.0, 3.0));
    }
    let largest = input.indicatrix.basis.cells().zip(&input.indicatrix.q);
    let largest = largest.map(|(cell, q)| drawn(*q, &cell, input.weighted)).fold(0.0, f64::max);
    let what = if input.weighted { "q·cosθ" } else { "q" };
    let text = say::largest_q(what, crate::drawing::ticks::number(largest, 3));
    tile::name(ui, &response, say::EMERGENT_BODY, &text);
    let hovered = response.hover_pos().filter(|_| !response.dragged());
    let Some(index) = hovered.and_then(|at| body.nearest(&view, DVec3::ZERO, 1.0, at, REACH)) else {
        return (None, None);
    };
    let through = node(index / STEPS[1], index % STEPS[1]);
    let value = value(input, through);
    if let Some((at, _)) = body.point(index).and_then(|point| view.screen(point)) {
        painter.circle(at, 3.5, palette.ink, Stroke::new(1.5, palette.face));
    }
    (Some(leaving_text(through, value, input.weighted)), Some(value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::paint::palette::ColourMap;
    use crate::compute::basis::{AzimuthMap, RingBasis};

    #[test]
    fn the_body_reaches_where_the_light_goes() {
        let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        // All light from above goes down, into the cell of its through-name.
        let up = Dir::from_theta_phi(0.7, FRAC_PI_2);
        let own = basis.index(up).unwrap();
        let q = (0..basis.len()).map(|cell| if cell == own { 2.0 } else { 0.0 }).collect();
        let indicatrix = Indicatrix { basis, q };
        let scale = ColourScale { lo: 0.0, hi: 2.0, log: false, map: ColourMap::Sequential };
        let input = Input {
            indicatrix: &indicatrix,
            direction: Incident(up),
            regular: 0.0,
            scale: &scale,
            weighted: false,
            key: (0, [0; 3]),
        };
        let body = make(&input);
        let far: Vec<DVec3> =
            (0..(STEPS[0] + 1) * STEPS[1]).filter_map(|k| body.point(k)).filter(|point| point.length() > 0.5).collect();
        assert!(!far.is_empty());
        for point in far {
            // Into the room and down.
            assert!(point.y > 0.0 && point.z < 0.0 && (point.length() - 1.0).abs() < 1e-6, "{point}");
        }
    }
}
