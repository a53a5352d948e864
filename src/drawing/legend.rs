//! Legends of drawings: a colour scale as a bar with marks and unit, and samples of curves with their names. All
//! lengths are in drawing units.

use super::colours::{ColourScale, Inks};
use super::font::width;
use super::shape::moved;
use super::{Align, Drawing, Frame, Shape, TEXT, ticks};
use crate::texts::tiles as say;

/// Height of the strip that a legend with a colour scale needs, its numbers included. \[drawing units\]
pub const HEIGHT: f64 = 34.0;
/// Height of one line of a legend with names of curves. \[drawing units\]
pub const LINE: f64 = 19.0;

/// Draws a colour scale into a frame: a bar of its colours, round values under it, and at its right the text `unit`
/// (quantity and unit), which says that the scale is logarithmic where it is.
pub fn scale(drawing: &mut Drawing, frame: Frame, scale: &ColourScale, unit: &str, inks: &Inks) {
    let words = if scale.log { say::logarithmic(unit) } else { unit.to_owned() };
    let room = (frame.width - width(&words, TEXT) - 28.0).max(40.0);
    let bar = Frame::new(frame.left + 12.0, frame.top + 2.0, room, 11.0);
    const STEPS: usize = 96;
    for k in 0..STEPS {
        let share = |k: usize| bar.left + bar.width * k as f64 / STEPS as f64;
        let cell = Frame::new(share(k), bar.top, share(k + 1) - share(k), bar.height);
        drawing.add(Shape::cell(cell.corners(), scale.map.rgb((k as f32 + 0.5) / STEPS as f32)));
    }
    drawing.add(Shape::line(bar.outline(), inks.outline, 1.0));
    let at = [bar.right() + 10.0, bar.top + 0.5 * bar.height];
    drawing.add(Shape::words(at, words, inks.weak, TEXT, Align::Start));
    let mut free = f64::NEG_INFINITY;
    for mark in scale.marks((bar.width / 46.0).max(1.0) as usize) {
        let x = bar.left + bar.width * f64::from(scale.fraction(mark));
        drawing.add(Shape::line([[x, bar.bottom()], [x, bar.bottom() + 3.0]], inks.weak, 1.0));
        let text = ticks::tick(mark);
        let half = 0.5 * width(&text, TEXT);
        if x - half > free {
            free = x + half + 4.0;
            drawing.add(Shape::text([x, bar.bottom() + 11.0], text, inks.ink));
        }
    }
}

/// Entry of a legend: a sample of a curve or a symbol, and its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Name {
    /// Sample of the curve, or a symbol in its stead: a shape between (0, 0) and (18, 0), x to the right and y down
    /// from the left end of the entry at half the height of its line. \[drawing units\]
    pub sample: Shape,
    /// Name of the curve, written to the right of the sample.
    pub text: String,
}

/// Draws the entries of a legend side by side, in as many lines as the frame's width needs. Returns the height of all
/// lines. \[drawing units\]
pub fn names(drawing: &mut Drawing, frame: Frame, names: &[Name], inks: &Inks) -> f64 {
    let mut at = [frame.left, frame.top + 0.5 * LINE];
    for name in names {
        let wide = 24.0 + width(&name.text, TEXT);
        if at[0] > frame.left && at[0] + wide > frame.right() {
            at = [frame.left, at[1] + LINE];
        }
        drawing.shapes.push(moved(&name.sample, 1.0, at));
        let words = [at[0] + 24.0, at[1]];
        drawing.add(Shape::words(words, name.text.clone(), inks.ink, TEXT, Align::Start));
        at[0] += wide + 16.0;
    }
    at[1] + 0.5 * LINE - frame.top
}
