//! Plots on paper: panels side by side under one legend, as shapes of a [`Drawing`]. All lengths and positions are in
//! drawing units, x to the right and y down from the upper left corner of the paper.

use super::colours::Inks;
pub use super::colours::SERIES;
use super::font::width;
use super::legend::{self, Name};
use super::plot::{Axis, Form, Plot, Series, crosses};
use super::{Align, Drawing, Frame, Point, Shape, TEXT};
use crate::texts::tiles as say;

/// Height of the strip below a panel for the labels at its ticks: with the name of the x axis under them, and without.
/// \[drawing units\]
const BELOW: [f64; 2] = [40.0, 22.0];
/// Height of the strip above a panel for its title. \[drawing units\]
const ABOVE: f64 = 30.0;

/// Panel of a chart: a plot together with the rectangle of the paper into which its data are drawn.
#[derive(Debug, Clone, Copy)]
pub struct Panel<'a> {
    /// Plot that the panel shows: axes, series and guide lines.
    pub plot: &'a Plot,
    /// Rectangle between the axes, without ticks, labels and title.
    /// \[drawing units from the upper left corner of the paper\]
    pub area: Frame,
    /// Colours of everything that is drawn in the panel.
    pub inks: &'a Inks,
}

/// Draws plots of the same series side by side under one legend, on paper of the given width and height.
/// \[drawing units\]
pub fn draw(plots: &[Plot], [across, down]: [f64; 2]) -> Drawing {
    let inks = &Inks::LIGHT;
    let mut drawing = Drawing::new(across, down);
    let head = Frame::new(20.0, 6.0, across - 40.0, 40.0);
    let series = plots.first().map_or(&[][..], |plot| &plot.series);
    let legend = names(&mut drawing, head, series, inks);
    let room = across / plots.len().max(1) as f64;
    for (k, plot) in plots.iter().enumerate() {
        let frame = Frame::new(k as f64 * room, 6.0 + legend, room - 8.0, down - legend - 6.0);
        let title = say::against(&plot.y.name, &plot.x.name);
        drawing.add(Shape::text([frame.left + 0.5 * frame.width, frame.top + 14.0], title, inks.ink));
        panel(&mut drawing, frame.inside([0.0, ABOVE, 8.0, 0.0]), plot, inks);
    }
    drawing
}

/// Draws the legend of a chart, a sample of each curve with the name of its series, in as many lines as the frame's
/// width needs. Returns the height of the legend. \[drawing units\]
pub fn names(drawing: &mut Drawing, frame: Frame, series: &[Series], inks: &Inks) -> f64 {
    let name = |(k, series): (usize, &Series)| Name {
        sample: inks.curve(k, vec![[0.0, 0.0], [18.0, 0.0]], 2.5),
        text: series.name.clone(),
    };
    let list: Vec<Name> = series.iter().enumerate().map(name).collect();
    legend::names(drawing, frame, &list, inks)
}

/// Draws one plot into a frame, with the ticks and names of its axes. Returns the panel, by which more can be drawn at
/// values of the plot.
pub fn panel<'a>(drawing: &mut Drawing, frame: Frame, plot: &'a Plot, inks: &'a Inks) -> Panel<'a> {
    let wide = |axis: &Axis| marks(axis).iter().map(|mark| width(&axis.tick(*mark, 1.0), TEXT)).fold(0.0, f64::max);
    let named = |axis: &Axis| !axis.name.is_empty();
    let left = wide(&plot.y) + if named(&plot.y) { 26.0 } else { 8.0 };
    let below = if named(&plot.x) { BELOW[0] } else { BELOW[1] };
    let panel = Panel { plot, area: frame.inside([left, 6.0, 10.0, below]), inks };
    panel.axes(drawing);
    panel.guides(drawing);
    for (k, series) in plot.series.iter().enumerate() {
        panel.series(drawing, series, k);
    }
    panel
}

/// Returns the positions of an axis' ticks, as coordinates of the axis (values, or their decimal logarithms): whole
/// decades, or round values.
fn marks(axis: &Axis) -> Vec<f64> {
    let ends = axis.ends();
    let decades = ends[1].floor() - ends[0].ceil();
    if !axis.log || decades < 2.0 {
        return axis.marks(ends, 6);
    }
    let [first, last] = [ends[0].ceil() as i32, ends[1].floor() as i32];
    let every = 1 + (last - first - 1).max(0) / 6;
    (first..=last).filter(|power| (power - first) % every == 0).map(f64::from).collect()
}

impl Panel<'_> {
    /// Returns the position on paper of a point given in axis coordinates (values, or decimal logarithms on a
    /// logarithmic axis); a point outside the axes' ranges is drawn on the border of the panel. \[drawing units\]
    pub fn place(&self, point: [f64; 2]) -> Point {
        let along = |coordinate: f64, [first, last]: [f64; 2]| ((coordinate - first) / (last - first)).clamp(0.0, 1.0);
        let [u, v] = [along(point[0], self.plot.x.ends()), along(point[1], self.plot.y.ends())];
        [self.area.left + self.area.width * u, self.area.bottom() - self.area.height * v]
    }

    /// Returns the position on paper of a point given by its values on x and y; `None` if one of them is not a number.
    /// \[drawing units\]
    pub fn of(&self, values: [f64; 2]) -> Option<Point> {
        Some(self.place(self.plot.place(values)?))
    }

    /// Draws the border of the panel, a grid line and a label at every tick, and the names of the axes.
    fn axes(&self, drawing: &mut Drawing) {
        let (area, inks) = (self.area, self.inks);
        let (x, y) = (&self.plot.x, &self.plot.y);
        let mut free = f64::NEG_INFINITY;
        for mark in marks(x) {
            let [at, _] = self.place([mark, 0.0]);
            drawing.add(Shape::line([[at, area.top], [at, area.bottom()]], inks.grid, 1.0));
            let text = x.tick(mark, 1.0);
            let half = 0.5 * width(&text, TEXT);
            if at - half > free {
                free = at + half + 4.0;
                drawing.add(Shape::text([at, area.bottom() + 11.0], text, inks.ink));
            }
        }
        for mark in marks(y) {
            let [_, at] = self.place([0.0, mark]);
            drawing.add(Shape::line([[area.left, at], [area.right(), at]], inks.grid, 1.0));
            let text = y.tick(mark, 1.0);
            drawing.add(Shape::words([area.left - 5.0, at], text, inks.ink, TEXT, Align::End));
        }
        drawing.add(Shape::line(area.outline(), inks.outline, 1.0));
        let [middle_x, middle_y] = area.centre();
        if !x.name.is_empty() {
            drawing.add(Shape::text([middle_x, area.bottom() + 29.0], x.title(), inks.weak));
        }
        if !y.name.is_empty() {
            let wide = marks(y).iter().map(|mark| width(&y.tick(*mark, 1.0), TEXT)).fold(0.0, f64::max);
            drawing.add(Shape::Text {
                at: [area.left - wide - 16.0, middle_y],
                text: y.title(),
                colour: inks.weak,
                size: TEXT,
                align: Align::Middle,
                turn: -90.0,
            });
        }
    }

    /// Draws the guide lines of the plot with their names; a line that leaves the ranges of the axes is left out, and
    /// so is a name that would cover others.
    fn guides(&self, drawing: &mut Drawing) {
        let mut used: Vec<Frame> = Vec::new();
        let runs = self.plot.series.iter().flat_map(|series| self.plot.runs(series));
        let lines: Vec<Vec<Point>> = runs.map(|run| run.into_iter().map(|point| self.place(point)).collect()).collect();
        for guide in &self.plot.guides {
            let ends: Vec<Point> = guide.ends.iter().filter_map(|end| self.of(*end)).collect();
            let inside = |axis: &Axis, k: usize| {
                let [lo, hi] = axis.range;
                guide.ends.iter().all(|end| end[k] >= lo && end[k] <= hi)
            };
            // What lies beyond the scale would be drawn on its border.
            if ends.len() < 2 || !(inside(&self.plot.x, 0) && inside(&self.plot.y, 1)) {
                continue;
            }
            let at = ends[1];
            drawing.add(Shape::line(ends, self.inks.ink, 1.0));
            if !guide.name.is_empty() {
                // Over its end; where another has its name, or a line passes, further along.
                let wide = width(&guide.name, TEXT) + 4.0;
                let y = (at[1] - 8.0).max(self.area.top + 8.0);
                let step = if guide.is_level() { 8.0 } else { wide };
                let count = if guide.is_level() { ((self.area.width - wide) / step) as u32 } else { 3 };
                let first = at[0] - 4.0 - wide;
                let places = (0..count).map(|k| Frame::new(first - step * f64::from(k), y - 8.0, wide, 16.0));
                let free: Vec<Frame> = places.filter(|place| used.iter().all(|other| !other.meets(place))).collect();
                let crossed = |place: &&Frame| {
                    guide.is_level() && crosses(&lines, [place.left, place.right()], [place.top, place.bottom()])
                };
                if let Some(&place) = free.iter().find(|place| !crossed(place)).or(free.first()) {
                    let end = [place.right(), y];
                    drawing.add(Shape::words(end, guide.name.clone(), self.inks.ink, TEXT, Align::End));
                    used.push(place);
                }
            }
        }
    }

    /// Draws a series: its band of lowest and highest values, its line, and its marks. `number`: index of the series,
    /// which determines colour and dashes.
    fn series(&self, drawing: &mut Drawing, series: &Series, number: usize) {
        let colour = self.inks.series[number % self.inks.series.len()];
        for band in self.plot.bands(series) {
            let edge = |side: usize| band.iter().map(move |point| self.place([point[0], point[side]]));
            let points: Vec<Point> = edge(1).chain(edge(2).rev()).collect();
            drawing.add(Shape::Area { points, colour, opacity: 0.2, edge: 0.0 });
        }
        for run in self.plot.runs(series) {
            let points: Vec<Point> = run.into_iter().map(|point| self.place(point)).collect();
            for [x, y] in &points {
                let corners = [[-3.0, -3.0], [3.0, -3.0], [3.0, 3.0], [-3.0, 3.0], [-3.0, -3.0]];
                match series.form {
                    Form::Line => {}
                    Form::Marked => {
                        drawing.add(Shape::line(corners.map(|[u, v]| [x + u, y + v]), colour, 2.0));
                    }
                    Form::Dots => drawing.add(Shape::dot([*x, *y], 1.6, colour)),
                }
            }
            if series.form != Form::Dots && points.len() > 1 {
                drawing.add(self.inks.curve(number, points, 2.0));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::{Guide, Unit};

    fn plot() -> Plot {
        let mut series = Series::line("a", [[0.01, 1e-4], [0.1, 1e-2], [f64::NAN, 1.0], [1.0, 1e9]]);
        series.form = Form::Marked;
        series.band = vec![[1e-4, 1e-3]; 4];
        Plot {
            x: Axis::log([0.01, 1.0], "time", Unit::Seconds),
            y: Axis::log([1e-4, 1.0], "error", Unit::Share),
            series: vec![series],
            guides: vec![
                Guide { name: "limit".to_owned(), ends: [[0.01, 1e-2], [1.0, 1e-2]] },
                Guide { name: "beyond".to_owned(), ends: [[0.01, 1e3], [1.0, 1e3]] },
            ],
        }
    }

    #[test]
    fn a_decade_is_a_constant_length_and_nothing_leaves_the_frame() {
        let plot = plot();
        let area = Frame::new(10.0, 20.0, 100.0, 40.0);
        let panel = Panel { plot: &plot, area, inks: &Inks::LIGHT };
        assert_eq!(panel.of([0.1, 1e-4]), Some([60.0, 60.0]));
        assert_eq!(panel.of([1.0, 1.0]), Some([110.0, 20.0]));
        assert_eq!(panel.of([0.0, 1e9]), Some([10.0, 20.0]));
        assert_eq!(panel.of([f64::NAN, 1.0]), None);
    }

    #[test]
    fn the_name_of_a_level_guide_stands_where_no_line_passes() {
        let falling = Series::line("", [[0.0, 28.0], [2.0, 26.0], [2.2, 10.0], [6.0, 1.0]]);
        let plot = Plot {
            x: Axis::linear([0.0, 6.0], "", Unit::Named("m")),
            y: Axis::linear([0.0, 30.0], "", Unit::Named("lx")),
            series: vec![falling],
            guides: vec![Guide { name: "limit".to_owned(), ends: [[0.0, 0.5], [6.0, 0.5]] }],
        };
        let mut drawing = Drawing::new(400.0, 300.0);
        let panel = panel(&mut drawing, Frame::new(0.0, 0.0, 400.0, 300.0), &plot, &Inks::LIGHT);
        let line: Vec<Point> = plot.runs(&plot.series[0])[0].iter().map(|point| panel.place(*point)).collect();
        let mut ends = drawing.shapes.iter().filter_map(|shape| match shape {
            Shape::Text { text, at, .. } if text == "limit" => Some(*at),
            _ => None,
        });
        let [right, y] = ends.next().unwrap();
        let lines = [line];
        let free = |right: f64| !crosses(&lines, [right - width("limit", TEXT), right], [y - 8.0, y + 8.0]);
        assert!(free(right) && !free(panel.place([6.0, 0.0])[0] - 4.0), "{right}");
    }

    #[test]
    fn every_part_of_a_plot_is_on_paper() {
        let drawing = draw(&[plot(), plot()], [1000.0, 500.0]);
        let text = |shape: &Shape| if let Shape::Text { text, .. } = shape { Some(text.clone()) } else { None };
        let texts: Vec<String> = drawing.shapes.iter().filter_map(text).collect();
        for text in ["10 ms", "100 ms", "1 s", "0.01 %", "100 %", "error against time", "a", "limit"] {
            assert!(texts.iter().any(|one| one == text), "{text}: {texts:?}");
        }
        assert!(!texts.iter().any(|one| one == "beyond"));
        // A name, and on each of two panels three marks, the band and the one line of two points.
        let of_series = |shape: &&Shape| match shape {
            Shape::Line { colour, .. } | Shape::Area { colour, .. } => *colour == SERIES[0],
            Shape::Text { .. } => false,
        };
        assert_eq!(drawing.shapes.iter().filter(of_series).count(), 1 + 2 * (3 + 2 + 1));
    }
}
