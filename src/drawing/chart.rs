//! Plots on paper: panels side by side under one legend, as shapes of a [`Drawing`].

use super::plot::{Axis, Form, Plot, Series};
use super::{Drawing, Rgb, Shape};

const INK: Rgb = [30, 30, 30];
const FAINT: Rgb = [222, 222, 222];
/// One for each series; they keep apart for all common kinds of colour vision (after Okabe and Ito).
pub const SERIES: [Rgb; 5] = [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [213, 94, 0]];

/// Room for the labels left of a panel and below it, and for its title. \[px\]
const LEFT: f64 = 84.0;
const BELOW: f64 = 40.0;
const ABOVE: f64 = 30.0;
/// Room for the names of the series. \[px\]
const LEGEND: f64 = 58.0;
/// Room for one name. \[px\]
const NAME: f64 = 320.0;

/// A plot and the paper that it has.
struct Panel<'a> {
    plot: &'a Plot,
    left_right: [f64; 2],
    top_bottom: [f64; 2],
}

/// Draws plots of the same series on paper of a size. \[px\]
pub fn draw(plots: &[Plot], [width, height]: [u32; 2]) -> Drawing {
    let (across, down) = (f64::from(width), f64::from(height));
    let room = across / plots.len().max(1) as f64;
    let panels: Vec<Panel<'_>> = plots
        .iter()
        .enumerate()
        .map(|(k, plot)| Panel {
            plot,
            left_right: [k as f64 * room + LEFT, (k + 1) as f64 * room - 16.0],
            top_bottom: [LEGEND + ABOVE, down - BELOW],
        })
        .collect();
    let mut shapes: Vec<Shape> = panels.iter().flat_map(Panel::frame).collect();
    for panel in &panels {
        let guides = panel.plot.guides.iter();
        let lines = guides
            .map(|guide| guide.ends.iter().filter_map(|end| Some(panel.place(panel.plot.place(*end)?))).collect());
        shapes.extend(lines.map(|points| Shape::Line { points, colour: INK, width: 1.0 }));
    }
    for panel in &panels {
        let at = [0.5 * (panel.left_right[0] + panel.left_right[1]), panel.top_bottom[0] - 14.0];
        let text = format!("{} against {}", panel.plot.y.name, panel.plot.x.name);
        shapes.push(Shape::Text { at, text, colour: INK });
    }
    let names: Vec<&str> =
        plots.first().into_iter().flat_map(|plot| &plot.series).map(|series| &*series.name).collect();
    // As many beside one another as there is room for.
    let columns = ((across / NAME) as usize).clamp(1, names.len().max(1));
    let step = across / columns as f64;
    for (k, (name, colour)) in names.into_iter().zip(SERIES.into_iter().cycle()).enumerate() {
        let (centre, line) = (((k % columns) as f64 + 0.5) * step, 14.0 + 18.0 * (k / columns) as f64);
        // The letters of a PNG are wider than those of any font.
        let half = 6.2 * name.chars().count() as f64;
        let points = vec![[centre - half - 18.0, line], [centre - half, line]];
        shapes.push(Shape::Line { points, colour, width: 3.0 });
        shapes.push(Shape::Text { at: [centre + 6.0, line], text: name.to_owned(), colour: INK });
        for panel in &panels {
            shapes.extend(panel.plot.series.get(k).into_iter().flat_map(|series| panel.series(series, colour)));
        }
    }
    Drawing { width, height, shapes }
}

/// Coordinates of the ticks on paper: whole decades, or round values.
fn marks(axis: &Axis) -> Vec<f64> {
    let ends = axis.ends();
    if !axis.log {
        return axis.marks(ends, 6);
    }
    let [first, last] = [ends[0].ceil() as i32, ends[1].floor() as i32];
    let every = 1 + (last - first - 1).max(0) / 6;
    (first..=last).filter(|power| (power - first) % every == 0).map(f64::from).collect()
}

impl Panel<'_> {
    /// Place on paper of a point in coordinates; what lies outside the axes' ranges is drawn on the border.
    fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let along = |coordinate: f64, [first, last]: [f64; 2]| ((coordinate - first) / (last - first)).clamp(0.0, 1.0);
        let ([left, right], [top, bottom]) = (self.left_right, self.top_bottom);
        let [u, v] = [along(point[0], self.plot.x.ends()), along(point[1], self.plot.y.ends())];
        [left + (right - left) * u, bottom + (top - bottom) * v]
    }

    /// Border, and a line and a label at every tick.
    fn frame(&self) -> Vec<Shape> {
        let mut shapes = Vec::new();
        let ([left, right], [top, bottom]) = (self.left_right, self.top_bottom);
        let line = |points: Vec<[f64; 2]>, colour| Shape::Line { points, colour, width: 1.0 };
        let (x, y) = (&self.plot.x, &self.plot.y);
        for mark in marks(x) {
            let [at, _] = self.place([mark, 0.0]);
            shapes.push(line(vec![[at, top], [at, bottom]], FAINT));
            shapes.push(Shape::Text { at: [at, bottom + 14.0], text: x.tick(mark, 1.0), colour: INK });
        }
        for mark in marks(y) {
            let [_, at] = self.place([0.0, mark]);
            shapes.push(line(vec![[left, at], [right, at]], FAINT));
            shapes.push(Shape::Text { at: [left - 36.0, at], text: y.tick(mark, 1.0), colour: INK });
        }
        shapes.push(line(vec![[left, top], [right, top], [right, bottom], [left, bottom], [left, top]], INK));
        shapes
    }

    /// Marks, lines and the edges of the band; a drawing has no areas.
    fn series(&self, series: &Series, colour: Rgb) -> Vec<Shape> {
        let mut shapes = Vec::new();
        let line = |points: Vec<[f64; 2]>, width| Shape::Line { points, colour, width };
        for band in self.plot.bands(series) {
            let edge = |side: usize| band.iter().map(|point| self.place([point[0], point[side]])).collect();
            shapes.extend([1, 2].map(|side| line(edge(side), 0.5)));
        }
        for run in self.plot.runs(series) {
            let points: Vec<[f64; 2]> = run.into_iter().map(|point| self.place(point)).collect();
            for [x, y] in &points {
                let corners = [[-3.0, -3.0], [3.0, -3.0], [3.0, 3.0], [-3.0, 3.0], [-3.0, -3.0]];
                match series.form {
                    Form::Line => {}
                    Form::Marked => shapes.push(line(corners.map(|[u, v]| [x + u, y + v]).into(), 2.0)),
                    Form::Dots => shapes.push(line(vec![[x - 1.0, *y], [x + 1.0, *y]], 2.0)),
                }
            }
            if series.form != Form::Dots && points.len() > 1 {
                shapes.push(line(points, 1.5));
            }
        }
        shapes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::plot::{Guide, Unit};

    fn plot() -> Plot {
        let mut series = Series::line("a", [[0.01, 1e-4], [0.1, 1e-2], [f64::NAN, 1.0], [1.0, 1e9]]);
        series.form = Form::Marked;
        series.band = vec![[1e-4, 1e-3]; 4];
        Plot {
            x: Axis::log([0.01, 1.0], "time", Unit::Seconds),
            y: Axis::log([1e-4, 1.0], "error", Unit::Share),
            series: vec![series],
            guides: vec![Guide { name: String::new(), ends: [[0.01, 1e-4], [1.0, 1.0]] }],
        }
    }

    #[test]
    fn a_decade_is_a_constant_length_and_nothing_leaves_the_frame() {
        let plot = plot();
        let panel = Panel { plot: &plot, left_right: [10.0, 110.0], top_bottom: [20.0, 60.0] };
        let place = |point| panel.place(plot.place(point).unwrap());
        assert_eq!(place([0.1, 1e-4]), [60.0, 60.0]);
        assert_eq!(place([1.0, 1.0]), [110.0, 20.0]);
        assert_eq!(place([0.0, 1e9]), [10.0, 20.0]);
    }

    #[test]
    fn every_part_of_a_plot_is_on_paper() {
        let drawing = draw(&[plot(), plot()], [1000, 500]);
        let texts: Vec<&str> = drawing
            .shapes
            .iter()
            .filter_map(|shape| match shape {
                Shape::Text { text, .. } => Some(text.as_str()),
                Shape::Line { .. } => None,
            })
            .collect();
        for text in ["10 ms", "100 ms", "1 s", "0.01 %", "100 %", "error against time", "a"] {
            assert!(texts.contains(&text), "{text}: {texts:?}");
        }
        // Two panels: three marks, two edges of the band and the one line of two points each.
        let of_series = |shape: &&Shape| matches!(shape, Shape::Line { colour, .. } if *colour == SERIES[0]);
        assert_eq!(drawing.shapes.iter().filter(of_series).count(), 1 + 2 * (3 + 2 * 2 + 1));
    }
}
