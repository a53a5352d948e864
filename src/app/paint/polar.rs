//! Polar diagrams of luminous intensities in the style of lighting design: nadir at the bottom, rings of equal value,
//! angles at the rim.

use super::palette::Palette;
use crate::drawing::ticks;
use egui::{Align2, FontId, Painter, Pos2, Rect, Stroke, pos2};
use std::f64::consts::{PI, TAU};

/// Width of the space for the angle labels round the rim. \[points\]
const RIM: f32 = 26.0;

/// Axes of a polar diagram on the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PolarAxes {
    /// Screen position of the diagram's pole (value 0).
    pub centre: Pos2,
    /// Radius of the outermost ring. \[points\]
    pub radius: f32,
    /// Value of the outermost ring, in the unit of the plotted quantity.
    pub max: f64,
}

impl PolarAxes {
    /// Creates the largest diagram within a rectangle. `max`: largest value to show, rounded up for the outermost ring.
    pub fn within(rect: Rect, max: f64) -> Self {
        let radius = (0.5 * rect.width().min(rect.height()) - RIM).max(10.0);
        Self { centre: rect.center(), radius, max: ticks::fine_ceil(max) }
    }

    /// Returns the screen position of a value at an angle, which is counted from straight down towards the right
    /// \[rad\].
    pub fn screen(&self, angle: f64, value: f64) -> Pos2 {
        let r = (value / self.max).clamp(0.0, 1.05) as f32 * self.radius;
        self.centre + egui::vec2(angle.sin() as f32, angle.cos() as f32) * r
    }

    /// Returns the angle of a screen position, counted from straight down towards the right, −π … π \[rad\], and the
    /// value at its distance from the pole.
    pub fn value(&self, at: Pos2) -> (f64, f64) {
        let d = at - self.centre;
        (f64::from(d.x).atan2(f64::from(d.y)), f64::from(d.length() / self.radius) * self.max)
    }

    /// Draws rings with their values along the angle `label_angle` \[rad\], and spokes every 30° with the text that
    /// `label` gives for their angle \[rad\].
    pub fn paint(&self, painter: &Painter, label: impl Fn(f64) -> String, label_angle: f64, palette: &Palette) {
        let grid = Stroke::new(1.0, palette.grid);
        let font = FontId::proportional(13.0);
        for k in 0..12 {
            let angle = f64::from(k) * PI / 6.0;
            painter.line_segment([self.centre, self.screen(angle, self.max)], grid);
            let at = self.centre + (self.screen(angle, self.max) - self.centre) * (1.0 + 0.47 * RIM / self.radius);
            if self.radius > 55.0 || k % 3 == 0 {
                painter.text(at, Align2::CENTER_CENTER, label(angle), font.clone(), palette.weak);
            }
        }
        let rings = ticks::linear(0.0, self.max, if self.radius > 80.0 { 4 } else { 2 });
        for value in rings.iter().filter(|v| **v > 0.0) {
            painter.circle_stroke(self.centre, (value / self.max) as f32 * self.radius, grid);
        }
        painter.circle_stroke(self.centre, self.radius, Stroke::new(1.0, palette.outline));
        // The outermost value would lie on the angles.
        for value in rings.into_iter().filter(|v| *v > 0.0 && *v < 0.999 * self.max) {
            let at = self.screen(label_angle, value);
            painter.text(pos2(at.x + 2.0, at.y), Align2::LEFT_BOTTOM, ticks::tick(value), font.clone(), palette.weak);
        }
    }

    /// Returns the screen positions of a closed curve through values at equally spaced angles over a full turn, the
    /// first straight down.
    pub fn curve(&self, samples: &[f64]) -> Vec<Pos2> {
        let n = samples.len() as f64;
        samples.iter().enumerate().map(|(k, v)| self.screen(TAU * k as f64 / n, v.max(0.0))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::vec2;

    #[test]
    fn nadir_is_down_and_ninety_is_right() {
        let axes = PolarAxes::within(
            Rect::from_min_size(Pos2::ZERO, vec2(240.0 + 2.0 * RIM - 40.0, 240.0 + 2.0 * RIM - 40.0)),
            97.0,
        );
        assert_eq!(axes.max, 100.0);
        let down = axes.screen(0.0, 100.0) - axes.centre;
        assert!(down.y > 99.0 && down.x.abs() < 1e-3);
        let right = axes.screen(0.5 * PI, 50.0) - axes.centre;
        assert!((right.x - 50.0).abs() < 1e-3 && right.y.abs() < 1e-3);
        let (angle, value) = axes.value(axes.screen(-2.0, 30.0));
        assert!((angle + 2.0).abs() < 1e-5 && (value - 30.0).abs() < 1e-4);
    }
}
