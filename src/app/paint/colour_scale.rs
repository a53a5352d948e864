//! Colours of false-colour scales in the window, and their legend: linear or logarithmic, with unit.

use super::palette::{ColourMapExt as _, Palette};
use crate::drawing::ticks;
use crate::texts::tiles as say;
use egui::{Align2, Color32, FontId, Mesh, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, pos2, vec2};

/// Height that the legend of a colour scale needs. \[points\]
pub const LEGEND_HEIGHT: f32 = 32.0;

pub use crate::drawing::colours::ColourScale;

/// Colours and legend of a [`ColourScale`] in the window.
pub trait ColourScaleExt {
    /// Returns the colour of a value, given in the unit of the scale.
    fn colour(&self, value: f64) -> Color32;

    /// Paints the legend into `rect` (see [`LEGEND_HEIGHT`]): colour bar, ticks, unit, and a needle at the value
    /// `pointed`, i.e. the value under the pointer, if there is one.
    fn paint_legend(&self, painter: &Painter, rect: Rect, unit: &str, pointed: Option<f64>, palette: &Palette);
}

impl ColourScaleExt for ColourScale {
    fn colour(&self, value: f64) -> Color32 {
        self.map.at(self.fraction(value))
    }

    fn paint_legend(&self, painter: &Painter, rect: Rect, unit: &str, pointed: Option<f64>, palette: &Palette) {
        let font = FontId::proportional(13.0);
        // In a narrow tile the spacing of the ticks alone says that the scale is logarithmic.
        let words = if self.log && rect.width() > 170.0 { say::logarithmic(unit) } else { unit.to_owned() };
        let words = painter.layout_no_wrap(words, font.clone(), palette.weak);
        let bar = Rect::from_min_max(
            pos2(rect.left() + 14.0, rect.top() + 3.0),
            pos2((rect.right() - words.size().x - 12.0).max(rect.left() + 40.0), rect.top() + 12.0),
        );
        painter.galley(pos2(bar.right() + 8.0, bar.center().y - 0.5 * words.size().y), words, palette.weak);
        let mut mesh = Mesh::default();
        const STEPS: u32 = 64;
        for i in 0..=STEPS {
            let f = i as f32 / STEPS as f32;
            let x = egui::lerp(bar.x_range(), f);
            mesh.colored_vertex(pos2(x, bar.top()), self.map.at(f));
            mesh.colored_vertex(pos2(x, bar.bottom()), self.map.at(f));
            if i > 0 {
                mesh.add_triangle(2 * i - 2, 2 * i - 1, 2 * i);
                mesh.add_triangle(2 * i - 1, 2 * i, 2 * i + 1);
            }
        }
        painter.add(Shape::mesh(mesh));
        painter.rect_stroke(bar, 0, Stroke::new(1.0, palette.outline), StrokeKind::Outside);
        let room = (bar.width() / 48.0).max(1.0) as usize;
        for mark in self.marks(room) {
            let x = egui::lerp(bar.x_range(), self.fraction(mark));
            painter.line_segment([pos2(x, bar.bottom()), pos2(x, bar.bottom() + 3.0)], Stroke::new(1.0, palette.weak));
            painter.text(pos2(x, bar.bottom() + 3.0), Align2::CENTER_TOP, ticks::tick(mark), font.clone(), palette.ink);
        }
        if let Some(value) = pointed {
            let x = egui::lerp(bar.x_range(), self.fraction(value).clamp(0.0, 1.0));
            needle(painter, pos2(x, bar.top()), palette);
        }
    }
}

fn needle(painter: &Painter, tip: Pos2, palette: &Palette) {
    painter.add(Shape::convex_polygon(
        vec![tip + vec2(0.0, 5.0), tip + vec2(-4.0, -2.0), tip + vec2(4.0, -2.0)],
        palette.ink,
        Stroke::new(1.0, palette.face),
    ));
}
