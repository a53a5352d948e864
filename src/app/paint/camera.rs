//! A camera that is rotated round an object with pointer and keys, and the projection of points to the screen.

use crate::compute::polygon::cut;
use egui::{Align2, Color32, EventFilter, FontId, Key, Painter, Pos2, Rect, Response, Ui, Vec2, pos2};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Rotation per point of a drag. \[rad\]
const PER_POINT: f64 = 0.008;
/// Rotation per press of an arrow key. \[rad\]
const PER_KEY: f64 = 0.087;
/// Minimum distance from the camera at which anything is drawn, as a fraction of the object's radius.
const NEAR: f64 = 0.02;

/// Camera: the direction from which an object is looked at, and the zoom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Angle of the viewpoint about the vertical axis z, from +x towards +y. \[rad\]
    pub turn: f64,
    /// Elevation of the viewpoint above the horizontal plane through the object's centre. \[rad\]
    pub tilt: f64,
    /// Magnification; at 1 the whole object is visible.
    pub zoom: f64,
}

impl Camera {
    /// Creates a camera that shows the whole object (zoom 1) from the direction of two angles \[rad\], see the fields.
    pub const fn from(turn: f64, tilt: f64) -> Self {
        Self { turn, tilt, zoom: 1.0 }
    }

    /// Rotates and zooms the camera by the drag, wheel, arrow keys, + and − of this frame; Home returns to `first`.
    /// Returns whether the camera has changed.
    pub fn obey(&mut self, ui: &Ui, response: &Response, first: Self) -> bool {
        let before = *self;
        let drag = if response.dragged() { response.drag_delta() } else { Vec2::ZERO };
        self.turn -= PER_POINT * f64::from(drag.x);
        self.tilt += PER_POINT * f64::from(drag.y);
        if response.hovered() {
            let wheel = ui.input(|input| input.smooth_scroll_delta().y + 200.0 * (input.zoom_delta() - 1.0));
            self.zoom *= f64::from(wheel * 0.004).exp();
        }
        if response.has_focus() {
            let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
            ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
            let pressed = |key| f64::from(u8::from(ui.input(|input| input.key_pressed(key))));
            self.turn += PER_KEY * (pressed(Key::ArrowRight) - pressed(Key::ArrowLeft));
            self.tilt += PER_KEY * (pressed(Key::ArrowUp) - pressed(Key::ArrowDown));
            self.zoom *= 1.25_f64.powf(pressed(Key::Plus) + pressed(Key::Equals) - pressed(Key::Minus));
            if pressed(Key::Home) > 0.0 {
                *self = first;
            }
        }
        self.turn = self.turn.rem_euclid(TAU);
        self.tilt = self.tilt.clamp(-FRAC_PI_2 + 0.01, FRAC_PI_2 - 0.01);
        self.zoom = self.zoom.clamp(0.4, 12.0);
        *self != before
    }

    /// Returns the perspective view of an object, given by its enclosing sphere (centre and radius \[m\]), in a
    /// rectangle of the screen.
    pub fn view(&self, centre: DVec3, radius: f64, rect: Rect) -> View {
        let (sin, cos) = self.turn.sin_cos();
        let (up, level) = self.tilt.sin_cos();
        let outward = DVec3::new(level * cos, level * sin, up);
        let right = DVec3::new(-sin, cos, 0.0);
        // At zoom 1 the sphere is seen whole; at a higher zoom the viewpoint moves into it before magnification
        // increases further.
        let distance = 3.0 * radius / self.zoom.min(6.0);
        let focal = 0.5 * f64::from(rect.width().min(rect.height())) * 2.8 * (self.zoom / 6.0).max(1.0);
        View {
            eye: centre + distance * outward,
            right,
            up: outward.cross(right),
            forward: -outward,
            focal,
            middle: rect.center(),
            near: NEAR * radius,
        }
    }
}

/// Draws text above a screen point on a background rectangle, moved so far that it lies inside `area`; nothing if the
/// area is too small for it. Colours: of the text, of the background.
pub fn words(painter: &Painter, area: Rect, at: Pos2, text: &str, [colour, ground]: [Color32; 2]) {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(13.0), colour);
    let size = galley.size();
    let room = area.shrink(4.0);
    if size.x > room.width() || size.y > room.height() {
        return;
    }
    let place = Align2::CENTER_BOTTOM.anchor_size(at, size).min.clamp(room.min, room.max - size);
    painter.rect_filled(Rect::from_min_size(place, size).expand(2.0), 3, ground);
    painter.galley(place, galley, colour);
}

/// Perspective projection of points in 3D to the screen for one position of a camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Position of the viewpoint, in the axes of the object. \[m\]
    pub eye: DVec3,
    /// Unit vector in the axes of the object that points to the right on the screen.
    pub right: DVec3,
    up: DVec3,
    forward: DVec3,
    focal: f64,
    middle: Pos2,
    near: f64,
}

impl View {
    /// Returns the screen position of a point \[m\] and its depth, i.e. its distance in front of the camera along the
    /// viewing direction \[m\]; `None` if it is behind the camera or too near to it.
    pub fn screen(&self, point: DVec3) -> Option<(Pos2, f64)> {
        let from = point - self.eye;
        let depth = from.dot(self.forward);
        if depth < self.near {
            return None;
        }
        let scale = self.focal / depth;
        let (x, y) = (scale * from.dot(self.right), -scale * from.dot(self.up));
        Some((pos2(self.middle.x + x as f32, self.middle.y + y as f32), depth))
    }

    /// Returns the screen positions of the corners of a convex polygon (corners \[m\]), cut to the part in front of the
    /// camera.
    pub fn polygon(&self, corners: &[DVec3]) -> Vec<Pos2> {
        let mut kept = Vec::new();
        // A little farther, so that no corner is lost by rounding.
        cut(corners, |p| (p - self.eye).dot(self.forward) - (1.0 + 1e-9) * self.near, &mut kept);
        kept.into_iter().filter_map(|p| Some(self.screen(p)?.0)).collect()
    }

    /// Returns the unit vector, in the axes of the object, in which the camera sees a screen position.
    pub fn ray(&self, at: Pos2) -> DVec3 {
        let [x, y] = [at.x - self.middle.x, self.middle.y - at.y].map(|v| f64::from(v) / self.focal);
        // The three stand on each other: the sum is at least as long as the first.
        (self.forward + x * self.right + y * self.up).normalize_or_zero()
    }

    /// Whether a plane, given by a point \[m\] and a normal, shows the camera the side that the normal points to.
    pub fn faces(&self, point: DVec3, normal: DVec3) -> bool {
        (self.eye - point).dot(normal) > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::vec2;

    fn rect() -> Rect {
        Rect::from_min_size(pos2(100.0, 50.0), vec2(400.0, 300.0))
    }

    #[test]
    fn rays_go_through_the_points_that_are_seen() {
        let view = Camera { turn: 0.7, tilt: 0.4, zoom: 2.0 }.view(DVec3::new(2.0, 3.0, 1.5), 3.9, rect());
        for point in [DVec3::new(2.0, 3.0, 1.5), DVec3::new(0.1, 5.0, 2.9), DVec3::new(3.0, 1.0, 0.0)] {
            let (at, _) = view.screen(point).unwrap();
            assert!(view.ray(at).dot((point - view.eye).normalize()) > 1.0 - 1e-9);
        }
        assert!(view.screen(view.eye + 2.0 * (view.eye - DVec3::new(2.0, 3.0, 1.5))).is_none());
    }

    #[test]
    fn all_of_a_ball_is_seen_upright_and_nearer_things_are_larger() {
        let centre = DVec3::new(1.0, -2.0, 0.5);
        for (turn, tilt) in [(0.0, 0.0), (2.0, 0.9), (5.0, -0.7)] {
            let view = Camera::from(turn, tilt).view(centre, 2.0, rect());
            assert!((view.screen(centre).unwrap().0 - rect().center()).length() < 1e-3);
            for direction in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE.normalize()] {
                for sign in [-2.0, 2.0] {
                    let (at, _) = view.screen(centre + sign * direction).unwrap();
                    assert!(rect().expand(8.0).contains(at), "{turn} {tilt}: {at}");
                }
            }
            let top = view.screen(centre + DVec3::Z).unwrap().0;
            assert!(top.y < rect().center().y);
            let size = |at: DVec3| (view.screen(at + view.right).unwrap().0 - view.screen(at).unwrap().0).length();
            assert!(size(centre - view.forward) > size(centre + view.forward));
        }
    }
}
