//! From a value to a colour and back to a legend that can be read: linear or logarithmic, with unit.

use super::palette::{ColourMap, Palette};
use crate::drawing::ticks;
use egui::{Align2, Color32, FontId, Mesh, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, pos2, vec2};

/// Height that a legend needs. \[points\]
pub const LEGEND_HEIGHT: f32 = 32.0;

/// A colour scale over lo … hi.
#[derive(Debug, Clone, PartialEq)]
pub struct ColourScale {
    /// Value of the first colour, positive when `log`.
    pub lo: f64,
    /// Value of the last colour, above `lo`.
    pub hi: f64,
    /// Logarithmic instead of linear.
    pub log: bool,
    /// The colours.
    pub map: ColourMap,
}

impl ColourScale {
    /// From zero (linear) or `decades` below the top (log) to a round number at or above `max`.
    pub fn up_to(max: f64, log: bool, decades: i32, map: ColourMap) -> Self {
        let hi = if log { ticks::nice_ceil(max) } else { ticks::fine_ceil(max) };
        let lo = if log { hi * 10_f64.powi(-decades.max(1)) } else { 0.0 };
        Self { lo, hi, log, map }
    }

    /// Logarithmic between round numbers around the data; at least one decade, at most six.
    pub fn log_around(min: f64, max: f64, map: ColourMap) -> Self {
        let hi = ticks::nice_ceil(max);
        let lo = 1.0 / ticks::nice_ceil(1.0 / min.clamp(hi * 1e-6, hi * 0.1));
        Self { lo, hi, log: true, map }
    }

    /// 0 at `lo`, 1 at `hi`; not limited. Values that a logarithm cannot take are below the scale.
    pub fn fraction(&self, value: f64) -> f32 {
        if self.log {
            if value > 0.0 { ((value / self.lo).ln() / (self.hi / self.lo).ln()) as f32 } else { -1.0 }
        } else {
            ((value - self.lo) / (self.hi - self.lo)) as f32
        }
    }

    /// Colour of a value.
    pub fn colour(&self, value: f64) -> Color32 {
        self.map.at(self.fraction(value))
    }

    /// Paints the legend into `rect` (see [`LEGEND_HEIGHT`]): bar, ticks, unit, and a needle at `pointed`.
    pub fn paint_legend(&self, painter: &Painter, rect: Rect, unit: &str, pointed: Option<f64>, palette: &Palette) {
        let font = FontId::proportional(13.0);
        // In a narrow tile the spacing of the ticks alone says that the scale is logarithmic.
        let words = if self.log && rect.width() > 170.0 { format!("{unit} (log)") } else { unit.to_owned() };
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
        let marks =
            if self.log { ticks::logarithmic(self.lo, self.hi, room) } else { ticks::linear(self.lo, self.hi, room) };
        for mark in marks {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_run_from_end_to_end() {
        for scale in [
            ColourScale::up_to(0.37, true, 3, ColourMap::Sequential),
            ColourScale::up_to(812.0, false, 3, ColourMap::Sequential),
            ColourScale::log_around(3.0, 4000.0, ColourMap::Sequential),
        ] {
            assert!(scale.hi > scale.lo);
            for k in 0..=10 {
                let f = f64::from(k) / 10.0;
                let value = if scale.log {
                    scale.lo * (scale.hi / scale.lo).powf(f)
                } else {
                    scale.lo + f * (scale.hi - scale.lo)
                };
                assert!((f64::from(scale.fraction(value)) - f).abs() < 1e-6);
            }
        }
        let log = ColourScale::up_to(1.0, true, 3, ColourMap::Sequential);
        assert_eq!(log.colour(0.0), log.colour(1e-9));
        let around = ColourScale::log_around(3.0, 4000.0, ColourMap::Sequential);
        assert!((around.lo - 2.0).abs() < 1e-12 && (around.hi - 5000.0).abs() < 1e-9);
    }
}
