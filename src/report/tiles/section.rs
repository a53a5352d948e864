//! Section of a described system: outside at the left, room side at the right, with a scale.

use crate::compute::system::SystemDescription;
use crate::drawing::colours::Inks;
use crate::drawing::{Align, Drawing, Frame, Point, Shape, TEXT};
use crate::texts::{decimal, export as texts};

/// Number of periods of the system (e.g. slats) that are drawn.
const PERIODS: usize = 3;

/// Draws the vertical section of a described system in one state. Returns `false` if the system has no section.
pub fn section(drawing: &mut Drawing, frame: Frame, system: &SystemDescription, state: &str, inks: &Inks) -> bool {
    let family = system.family();
    let one = family.drawing(state);
    let period = family.drawing_period().unwrap_or(0.0);
    let count = if period > 0.0 { PERIODS } else { 1 };
    let lifted = |k: usize, polygon: &[[f64; 2]]| -> Vec<[f64; 2]> {
        polygon.iter().map(|[z, y]| [*z, y + k as f64 * period]).collect()
    };
    let polygons: Vec<Vec<[f64; 2]>> =
        (0..count).flat_map(|k| one.iter().map(move |polygon| lifted(k, polygon)).collect::<Vec<_>>()).collect();
    let range = |axis: usize| {
        let values = polygons.iter().flatten().map(|point| point[axis]);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], value| [lo.min(value), hi.max(value)])
    };
    let (z, y) = (range(0), range(1));
    if !(z[1] - z[0]).is_finite() {
        return false;
    }
    let inner = frame.inside([10.0, 20.0, 10.0, 24.0]);
    let scale = (inner.width / (z[1] - z[0]).max(1e-9)).min(inner.height / (y[1] - y[0]).max(1e-9));
    let [cx, cy] = inner.centre();
    // Outside is on the left: outward runs to the left.
    let place = |p: &[f64; 2]| -> Point {
        [cx + scale * (0.5 * (z[0] + z[1]) - p[0]), cy + scale * (0.5 * (y[0] + y[1]) - p[1])]
    };
    for polygon in &polygons {
        let mut points: Vec<Point> = polygon.iter().map(place).collect();
        drawing.add(Shape::area(points.clone(), inks.grid));
        points.extend(points.first().copied());
        drawing.add(Shape::line(points, inks.ink, 1.0));
    }
    let mut write = |at: Point, text: &str, align| drawing.add(Shape::words(at, text, inks.weak, TEXT, align));
    write([frame.left, frame.top + 8.0], texts::OUTSIDE.get(), Align::Start);
    write([frame.right(), frame.top + 8.0], texts::INSIDE.get(), Align::End);
    let most = 1000.0 * 0.35 * frame.width / scale;
    let decade = 10_f64.powf(most.log10().floor());
    let bar = [5.0, 2.0, 1.0].into_iter().map(|step| step * decade).find(|bar| *bar <= most).unwrap_or(decade);
    let (left, bottom) = (frame.left + 2.0, frame.bottom() - 8.0);
    let right = left + 1e-3 * bar * scale;
    let length = decimal(((1e6 * bar).round() / 1e6).to_string());
    let words = if system.upright { texts::scale_bar_above(length) } else { texts::scale_bar(length) };
    write([right + 6.0, bottom], &words, Align::Start);
    drawing.add(Shape::line([[left, bottom], [right, bottom]], inks.weak, 1.5));
    for x in [left, right] {
        drawing.add(Shape::line([[x, bottom - 3.5], [x, bottom + 3.5]], inks.weak, 1.5));
    }
    true
}
