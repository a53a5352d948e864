//! A small x–y chart. Own, because the sections need a logarithmic axis, gaps in lines and a fixed place beside the
//! picture they belong to.

use super::palette::Palette;
use super::ticks;
use egui::{Align2, FontId, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, pos2};

/// One axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Lower end, positive when `log`.
    pub lo: f64,
    /// Upper end, above `lo`.
    pub hi: f64,
    /// Logarithmic.
    pub log: bool,
    /// What and in which unit, e.g. "depth / m".
    pub label: String,
    /// Ticks instead of the automatic ones: value and text.
    pub marks: Option<Vec<(f64, String)>>,
}

impl Axis {
    /// A linear axis.
    pub fn linear(lo: f64, hi: f64, label: impl Into<String>) -> Self {
        Self { lo, hi: if hi > lo { hi } else { lo + 1.0 }, log: false, label: label.into(), marks: None }
    }

    /// A logarithmic axis.
    pub fn log(lo: f64, hi: f64, label: impl Into<String>) -> Self {
        let lo = if lo > 0.0 { lo } else { 1e-6 };
        Self { lo, hi: if hi > lo { hi } else { 10.0 * lo }, log: true, label: label.into(), marks: None }
    }

    /// With ticks of one's own.
    pub fn with_marks(mut self, marks: Vec<(f64, String)>) -> Self {
        self.marks = Some(marks);
        self
    }

    fn fraction(&self, value: f64) -> f64 {
        if self.log {
            if value > 0.0 { (value / self.lo).ln() / (self.hi / self.lo).ln() } else { -0.02 }
        } else {
            (value - self.lo) / (self.hi - self.lo)
        }
    }

    fn value(&self, fraction: f64) -> f64 {
        if self.log { self.lo * (self.hi / self.lo).powf(fraction) } else { self.lo + fraction * (self.hi - self.lo) }
    }

    fn ticks(&self, count: usize) -> Vec<(f64, String)> {
        if let Some(marks) = &self.marks {
            return marks.clone();
        }
        let values =
            if self.log { ticks::logarithmic(self.lo, self.hi, count) } else { ticks::linear(self.lo, self.hi, count) };
        values.into_iter().map(|v| (v, ticks::tick(v))).collect()
    }
}

/// A chart at its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// The plotting area, axes outside.
    pub area: Rect,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
}

/// Space left of the plotting area. \[points\]
pub const LEFT: f32 = 44.0;
/// Space under the plotting area. \[points\]
pub const BELOW: f32 = 32.0;

impl Chart {
    /// Within a rectangle that also holds ticks and labels.
    pub fn within(rect: Rect, x: Axis, y: Axis) -> Self {
        let area = Rect::from_min_max(
            pos2(rect.left() + LEFT, rect.top() + 24.0),
            pos2((rect.right() - 10.0).max(rect.left() + LEFT + 10.0), (rect.bottom() - BELOW).max(rect.top() + 34.0)),
        );
        Self { area, x, y }
    }

    /// Screen point; not limited to the area.
    pub fn screen(&self, x: f64, y: f64) -> Pos2 {
        pos2(
            egui::lerp(self.area.x_range(), self.x.fraction(x) as f32),
            egui::lerp(self.area.bottom()..=self.area.top(), self.y.fraction(y) as f32),
        )
    }

    /// Values at a screen point; `None` outside the area.
    pub fn value(&self, at: Pos2) -> Option<(f64, f64)> {
        self.area.contains(at).then(|| {
            let fx = (at.x - self.area.left()) / self.area.width();
            let fy = (self.area.bottom() - at.y) / self.area.height();
            (self.x.value(f64::from(fx)), self.y.value(f64::from(fy)))
        })
    }

    /// Grid, ticks and labels; the label of y stands above the axis.
    pub fn paint(&self, painter: &Painter, palette: &Palette) {
        let (small, font) = (FontId::proportional(11.0), FontId::proportional(13.0));
        let grid = Stroke::new(1.0, palette.grid);
        for (value, text) in self.x.ticks((self.area.width() / 48.0).max(1.0) as usize) {
            let x = self.screen(value, self.y.lo).x;
            painter.vline(x, self.area.y_range(), grid);
            painter.text(pos2(x, self.area.bottom() + 2.0), Align2::CENTER_TOP, text, small.clone(), palette.weak);
        }
        for (value, text) in self.y.ticks((self.area.height() / 26.0).max(1.0) as usize) {
            let y = self.screen(self.x.lo, value).y;
            painter.hline(self.area.x_range(), y, grid);
            painter.text(pos2(self.area.left() - 5.0, y), Align2::RIGHT_CENTER, text, small.clone(), palette.weak);
        }
        painter.rect_stroke(self.area, 0, Stroke::new(1.0, palette.outline), StrokeKind::Middle);
        painter.text(
            pos2(self.area.center().x, self.area.bottom() + 15.0),
            Align2::CENTER_TOP,
            &self.x.label,
            font.clone(),
            palette.weak,
        );
        let at = pos2(self.area.left() - LEFT + 4.0, self.area.top() - 7.0);
        painter.text(at, Align2::LEFT_BOTTOM, &self.y.label, font, palette.weak);
    }

    /// A line through points; what is not finite makes a gap.
    pub fn line(&self, painter: &Painter, points: impl IntoIterator<Item = (f64, f64)>, stroke: Stroke) {
        let painter = painter.with_clip_rect(self.area.expand(1.0).intersect(painter.clip_rect()));
        let mut run = vec![];
        for (x, y) in points {
            if x.is_finite() && y.is_finite() {
                run.push(self.screen(x, y));
            } else if run.len() > 1 {
                painter.add(Shape::line(std::mem::take(&mut run), stroke));
            } else {
                run.clear();
            }
        }
        if run.len() > 1 {
            painter.add(Shape::line(run, stroke));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::vec2;

    #[test]
    fn screen_and_value_are_inverse_on_both_axes() {
        let rect = Rect::from_min_size(Pos2::ZERO, vec2(300.0, 150.0));
        let chart = Chart::within(rect, Axis::linear(-90.0, 90.0, "x"), Axis::log(1.0, 1000.0, "y"));
        let (x, y) = chart.value(chart.screen(30.0, 50.0)).unwrap();
        assert!((x - 30.0).abs() < 1e-3 && (y / 50.0 - 1.0).abs() < 1e-4);
        assert!(chart.value(Pos2::ZERO).is_none());
        // What a logarithm cannot take lies just under the area.
        assert!(chart.screen(0.0, 0.0).y > chart.area.bottom());
    }
}
