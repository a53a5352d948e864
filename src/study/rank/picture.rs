//! Picture of a ranking: bars of the scores, or two objectives plotted against each other.

use super::offered::figure_words;
use super::shortlist::{Entry, Look, Page, Shortlist};
use crate::compute::rank::Place;
use crate::drawing::chart;
use crate::drawing::colours::Inks;
use crate::drawing::plot::{Axis, Plot, Unit};
use crate::drawing::{Align, Drawing, Frame, Shape, TEXT};
use crate::texts::{choose as say, fixed};

/// Height of a row of bars. \[drawing units\]
const ROW: f64 = 19.0;
/// Width of the columns with rank and name. \[drawing units\]
const NAME: f64 = 290.0;
/// Width of the column with the score, to the right of a bar. \[drawing units\]
const WORDS: f64 = 110.0;

impl Shortlist {
    /// Returns the indices of the two objectives on the axes of the plot: the selected ones, else the first two.
    pub fn axes(&self, look: &Look) -> [usize; 2] {
        let place = |key: &String| self.list.figures.iter().position(|figure| figure == key);
        let last = self.list.figures.len().saturating_sub(1);
        let x = place(&look.axes[0]).unwrap_or(0);
        let y = place(&look.axes[1]).unwrap_or(if x == 0 { 1.min(last) } else { 0 });
        [x, y]
    }

    /// Returns a plot with two objectives as axes, whose ranges contain all displayed products with their errors;
    /// without points.
    pub fn plot(&self, look: &Look) -> Plot {
        let axes = self.axes(look);
        let shown = self.shown(look);
        let axis = |k: usize| {
            let ends = shown.iter().filter_map(|entry| entry.figures.get(k));
            let ends = ends.flat_map(|figure| [figure.value - figure.error, figure.value + figure.error]);
            let (low, high) = ends
                .filter(|end| end.is_finite())
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), end| (low.min(end), high.max(end)));
            let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
            let margin = 0.06 * (high - low).max(1e-6);
            let (name, unit) = self.list.figures.get(k).map_or_else(Default::default, |key| figure_words(key));
            let unit = if unit == "%" { Unit::Share } else { Unit::Named(unit) };
            Axis::linear([low - margin, high + margin], name, unit)
        };
        Plot { x: axis(axes[0]), y: axis(axes[1]), series: Vec::new(), guides: Vec::new() }
    }

    /// Draws the displayed products into a frame, as bars or as a plot, and returns a text on how many of them are
    /// drawn.
    pub fn draw(&self, drawing: &mut Drawing, frame: Frame, look: &Look, inks: &Inks) -> String {
        let shown: Vec<&Entry> = self.shown(look).into_iter().filter(|entry| entry.excluded.is_none()).collect();
        let drawn = if look.page == Page::Plot {
            self.points(drawing, frame, &shown, look, inks);
            shown.len()
        } else {
            bars(drawing, frame, &shown, inks)
        };
        say::shown(drawn, self.entries.len())
    }

    /// Draws the displayed products as points with error bars on the plot of two objectives.
    fn points(&self, drawing: &mut Drawing, frame: Frame, shown: &[&Entry], look: &Look, inks: &Inks) {
        let (plot, axes) = (self.plot(look), self.axes(look));
        let panel = chart::panel(drawing, frame, &plot, inks);
        for entry in shown {
            let [Some(x), Some(y)] = axes.map(|k| entry.figures.get(k)) else { continue };
            for (from, to) in [
                ([x.value - x.error, y.value], [x.value + x.error, y.value]),
                ([x.value, y.value - y.error], [x.value, y.value + y.error]),
            ] {
                drawing.add(Shape::line([panel.place(from), panel.place(to)], inks.weak, 1.0));
            }
            let at = panel.place([x.value, y.value]);
            let front = entry.place == Some(Place::Front);
            let size = if front { 4.5 } else { 3.0 };
            let diamond =
                [[0.0, -size], [size, 0.0], [0.0, size], [-size, 0.0]].map(|[dx, dy]| [at[0] + dx, at[1] + dy]);
            drawing.add(Shape::area(diamond, inks.series[usize::from(front)]));
            if front {
                // Names are placed on the side with room.
                let left = at[0] > panel.area.left + 0.7 * panel.area.width;
                let (dx, align) = if left { (-8.0, Align::End) } else { (8.0, Align::Start) };
                drawing.add(Shape::words([at[0] + dx, at[1] + 4.0], entry.name.clone(), inks.ink, TEXT, align));
            }
        }
    }
}

/// Draws as many products as fit into the frame, each with rank, name and a bar of its score, and returns their number.
fn bars(drawing: &mut Drawing, frame: Frame, shown: &[&Entry], inks: &Inks) -> usize {
    let count = ((frame.height / ROW).floor() as usize).min(shown.len());
    let (left, width) = (frame.left + NAME, (frame.width - NAME - WORDS).max(40.0));
    for (k, entry) in shown.iter().take(count).enumerate() {
        let top = frame.top + k as f64 * ROW;
        let middle = top + 0.5 * ROW;
        let (first, last) = entry.ranks;
        let rank = if first == last { first.to_string() } else { format!("{first}–{last}") };
        let front = if entry.place == Some(Place::Front) { "◆ " } else { "" };
        drawing.add(Shape::words([frame.left, middle + 4.0], rank, inks.weak, TEXT, Align::Start));
        let most = ((NAME - 56.0) / 6.4) as usize;
        let mut name = format!("{front}{}", entry.name);
        if name.chars().count() > most {
            name = format!("{}…", name.chars().take(most - 1).collect::<String>());
        }
        drawing.add(Shape::words([frame.left + 48.0, middle + 4.0], name, inks.ink, TEXT, Align::Start));
        let x = |share: f64| left + width * share.clamp(0.0, 1.0);
        let (score, error) = (entry.score.value, entry.score.error);
        let bar = Frame::new(left, top + 4.0, x(score) - left, ROW - 8.0);
        drawing.add(Shape::area(bar.corners(), inks.series[0]));
        drawing.add(Shape::line([[x(score - error), middle], [x(score + error), middle]], inks.ink, 1.5));
        let words = format!("{} ± {}", fixed(score, 3), fixed(error, 3));
        drawing.add(Shape::words([left + width + 8.0, middle + 4.0], words, inks.ink, TEXT, Align::Start));
    }
    count
}
