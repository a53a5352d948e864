//! The picture of [`accuracy`](super::accuracy): time against true error of every method, and stated against true error
//! of every sensor. The window, SVG and PNG show the same shapes.

use super::accuracy::{Accuracy, Quantity, Rung, Series};
use crate::formats::drawing::{Drawing, Rgb, Shape};
use crate::formats::log_chart::{LogChart, decades, per_cent, seconds};

/// Colours of the paper's side: the window has two themes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Colours {
    /// Text and frame.
    pub ink: Rgb,
    /// Lines of the grid.
    pub faint: Rgb,
    /// One for each series.
    pub series: [Rgb; 5],
}

impl Colours {
    /// On white paper. The series keep apart for all common kinds of colour vision (after Okabe and Ito).
    pub const PAPER: Self = Self {
        ink: [30, 30, 30],
        faint: [222, 222, 222],
        series: [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [213, 94, 0]],
    };
    /// On a dark window.
    pub const DARK: Self = Self {
        ink: [225, 225, 225],
        faint: [62, 62, 66],
        series: [[86, 180, 233], [230, 159, 0], [0, 190, 140], [225, 150, 195], [240, 120, 60]],
    };
}

/// Most dots of one series in the right panel.
const MOST_DOTS: usize = 400;
/// Room for the labels left of a panel and below it, and for its title. \[px\]
const LEFT: f64 = 84.0;
const BELOW: f64 = 40.0;
const ABOVE: f64 = 30.0;
/// Room for the names of the series. \[px\]
const LEGEND: f64 = 58.0;

/// What a series is called.
pub fn name(series: &Series) -> String {
    match series.quantity {
        Quantity::Direct => series.method.to_owned(),
        Quantity::Total => String::from("with interreflection"),
    }
}

/// Draws both panels on paper of a size, side by side or, on upright paper, one above the other. \[px\]
pub fn plot(accuracy: &Accuracy, width: u32, height: u32, colours: &Colours) -> Drawing {
    let (across, down) = (f64::from(width), f64::from(height));
    let upright = height > width;
    let (middle, bottom) = if upright { (across, 0.5 * (down + LEGEND) - BELOW) } else { (0.5 * across, down - BELOW) };
    let rungs = || accuracy.series.iter().flat_map(|series| &series.rungs);
    let time = decades(rungs().map(|rung| rung.sky), 9);
    let error = decades(rungs().map(Rung::rms), 9);
    let both = decades(rungs().flat_map(|rung| rung.errors.iter().flat_map(|e| [e.stated, e.real])), 9);
    let left = LogChart { left_right: [LEFT, middle - 16.0], top_bottom: [LEGEND + ABOVE, bottom], x: time, y: error };
    let right = LogChart {
        left_right: if upright { left.left_right } else { [middle + LEFT, across - 16.0] },
        top_bottom: if upright { [bottom + BELOW + ABOVE, down - BELOW] } else { left.top_bottom },
        x: both,
        y: both,
    };
    let mut shapes =
        left.frame(colours.ink, colours.faint, |x, power| if x { seconds(power) } else { per_cent(power) });
    shapes.extend(right.frame(colours.ink, colours.faint, |_, power| per_cent(power)));
    let ends = both.map(|power| 10_f64.powi(power));
    shapes.push(Shape::Line { points: ends.map(|end| right.place(end, end)).into(), colour: colours.ink, width: 1.0 });
    for (chart, text) in
        [(&left, "true error (RMS) against time a new sky"), (&right, "stated error against true error, by sensor")]
    {
        let at = [0.5 * (chart.left_right[0] + chart.left_right[1]), chart.top_bottom[0] - 14.0];
        shapes.push(Shape::Text { at, text: text.to_owned(), colour: colours.ink });
    }
    // As many beside one another as there is room for their names.
    let room = if upright { 210.0 } else { 320.0 };
    let columns = ((across / room) as usize).clamp(1, accuracy.series.len().max(1));
    let step = across / columns as f64;
    for (k, (series, colour)) in accuracy.series.iter().zip(colours.series.into_iter().cycle()).enumerate() {
        let (centre, line) = (((k % columns) as f64 + 0.5) * step, 14.0 + 18.0 * (k / columns) as f64);
        let text = name(series);
        // Upright paper is the window's, with its narrow letters; a PNG's dots are wider than those of any font.
        let (half, aside) = if upright { (4.5, 10.0) } else { (6.2, 6.0) };
        let half = half * text.chars().count() as f64;
        shapes.push(Shape::Line {
            points: vec![[centre - half - 18.0, line], [centre - half, line]],
            colour,
            width: 3.0,
        });
        shapes.push(Shape::Text { at: [centre + aside, line], text, colour: colours.ink });
        front(&left, series, colour, &mut shapes);
        dots(&right, series, colour, &mut shapes);
    }
    Drawing { width, height, shapes }
}

/// A line through the rungs, a square at each.
fn front(chart: &LogChart, series: &Series, colour: Rgb, shapes: &mut Vec<Shape>) {
    let points: Vec<[f64; 2]> = series.rungs.iter().map(|rung| chart.place(rung.sky, rung.rms())).collect();
    for [x, y] in &points {
        let corners = [[-3.0, -3.0], [3.0, -3.0], [3.0, 3.0], [-3.0, 3.0], [-3.0, -3.0]];
        shapes.push(Shape::Line { points: corners.map(|[u, v]| [x + u, y + v]).into(), colour, width: 2.0 });
    }
    if points.len() > 1 {
        shapes.push(Shape::Line { points, colour, width: 1.5 });
    }
}

/// A dot a sensor and rung: true error to the right, stated error up; above the diagonal the statement holds.
fn dots(chart: &LogChart, series: &Series, colour: Rgb, shapes: &mut Vec<Shape>) {
    let count: usize = series.rungs.iter().map(|rung| rung.errors.len()).sum();
    let every = count.div_ceil(MOST_DOTS).max(1);
    for e in series.rungs.iter().flat_map(|rung| &rung.errors).step_by(every) {
        let [x, y] = chart.place(e.real, e.stated);
        shapes.push(Shape::Line { points: vec![[x - 1.0, y], [x + 1.0, y]], colour, width: 2.0 });
    }
}
