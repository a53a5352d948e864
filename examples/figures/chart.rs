//! Drawing of the figures: panels with axes and lines (SVG), hemispheres in false colours (PNG).

use cfs::compute::direction::Dir;
use cfs::compute::direction::Facade;
use cfs::drawing::{Align, Drawing, Rgb, Shape, TEXT};
use glam::DVec3;
use image::RgbImage;

/// Colours that can be distinguished with all common kinds of colour vision (after Okabe and Ito).
pub const COLOURS: [Rgb; 8] = [
    [30, 30, 30],
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [230, 159, 0],
    [86, 180, 233],
    [150, 150, 150],
];
const INK: Rgb = [30, 30, 30];
const FAINT: Rgb = [222, 222, 222];

/// Line of a panel, with its name in the legend.
pub struct Line {
    pub name: String,
    pub points: Vec<[f64; 2]>,
    pub colour: Rgb,
    pub width: f64,
}

impl Line {
    /// Creates a line in colour number `k`.
    pub fn new(name: impl Into<String>, k: usize, points: Vec<[f64; 2]>) -> Self {
        Self { name: name.into(), points, colour: COLOURS[k % COLOURS.len()], width: 1.6 }
    }

    /// Returns the line wider and paler, to be drawn under another one.
    pub fn wide(self) -> Self {
        Self { width: 5.0, colour: self.colour.map(|c| 255 - (255 - c) / 3), ..self }
    }
}

/// Panel of a figure: axes with lines.
pub struct Panel {
    pub title: String,
    /// Names of the axes.
    pub axes: [&'static str; 2],
    pub x: [f64; 2],
    pub y: [f64; 2],
    pub lines: Vec<Line>,
}

impl Panel {
    /// Creates a panel with ranges that hold all lines; y starts at 0.
    pub fn new(title: impl Into<String>, axes: [&'static str; 2], lines: Vec<Line>) -> Self {
        let all = || lines.iter().flat_map(|line| &line.points);
        let x = all().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(p[0]), b.max(p[0])]);
        let top = all().map(|p| p[1]).fold(0.0, f64::max);
        Self { title: title.into(), axes, x, y: [0.0, nice(top)], lines }
    }
}

/// Returns the smallest round number (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6 or 8 times a power of ten) of at least `top`.
fn nice(top: f64) -> f64 {
    if top <= 0.0 {
        return 1.0;
    }
    let power = 10_f64.powf(top.log10().floor());
    let steps = [1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    steps.into_iter().map(|s| s * power).find(|s| *s >= 0.999 * top).unwrap_or(10.0 * power)
}

/// Returns a round step of about a fifth of a range.
fn step(range: f64) -> f64 {
    let power = 10_f64.powf((range / 5.0).log10().floor());
    [1.0, 2.0, 2.5, 5.0, 10.0].into_iter().map(|s| s * power).find(|s| range / s <= 6.0).unwrap_or(range)
}

fn label(value: f64, step: f64) -> String {
    let digits = (-step.log10().floor()).max(0.0) as usize;
    let digits = if (step * 10_f64.powi(digits as i32)).fract() > 1e-6 { digits + 1 } else { digits };
    format!("{value:.digits$}")
}

const CELL: [f64; 2] = [500.0, 340.0];

/// Draws panels in rows of `columns`.
pub fn sheet(panels: &[Panel], columns: usize) -> Drawing {
    let rows = panels.len().div_ceil(columns);
    let mut shapes = Vec::new();
    for (k, panel) in panels.iter().enumerate() {
        draw(panel, [(k % columns) as f64 * CELL[0], (k / columns) as f64 * CELL[1]], &mut shapes);
    }
    Drawing { width: columns as f64 * CELL[0], height: rows as f64 * CELL[1], shapes }
}

fn draw(panel: &Panel, [left, top]: [f64; 2], shapes: &mut Vec<Shape>) {
    let legend = 18.0 * panel.lines.len().div_ceil(2) as f64;
    let (x0, x1, y0, y1) = (left + 66.0, left + CELL[0] - 22.0, top + CELL[1] - 46.0, top + 34.0 + legend);
    let place = |p: [f64; 2]| {
        let u = (p[0] - panel.x[0]) / (panel.x[1] - panel.x[0]);
        let v = (p[1] - panel.y[0]) / (panel.y[1] - panel.y[0]);
        [x0 + u * (x1 - x0), y0 + v * (y1 - y0)]
    };
    let mut text = |at: [f64; 2], text: String| shapes.push(Shape::text(at, text, INK));
    text([0.5 * (x0 + x1), top + 16.0], panel.title.clone());
    text([0.5 * (x0 + x1), y0 + 34.0], panel.axes[0].to_owned());
    text([left + 34.0, y1 - 12.0], panel.axes[1].to_owned());
    let mut grid = Vec::new();
    for axis in 0..2 {
        let range = if axis == 0 { panel.x } else { panel.y };
        let step = step(range[1] - range[0]);
        let mut k = (range[0] / step - 1e-6).ceil();
        while k * step <= range[1] + 1e-6 * step {
            let value = k * step;
            let [px, py] = place(if axis == 0 { [value, panel.y[0]] } else { [panel.x[0], value] });
            let shown = label(if value == 0.0 { 0.0 } else { value }, step);
            if axis == 0 {
                grid.push(vec![[px, y0], [px, y1]]);
                text([px, y0 + 14.0], shown);
            } else {
                grid.push(vec![[x0, py], [x1, py]]);
                text([x0 - 26.0, py], shown);
            }
            k += 1.0;
        }
    }
    for (k, line) in panel.lines.iter().enumerate() {
        let [x, y] = [x0 + 8.0 + (k % 2) as f64 * 0.5 * (x1 - x0), top + 38.0 + 18.0 * (k / 2) as f64];
        shapes.push(Shape::line([[x, y], [x + 18.0, y]], line.colour, line.width.max(2.5)));
        shapes.push(Shape::words([x + 24.0, y], line.name.clone(), INK, TEXT, Align::Start));
    }
    shapes.extend(grid.into_iter().map(|points| Shape::line(points, FAINT, 1.0)));
    let frame = vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]];
    shapes.push(Shape::line(frame, INK, 1.0));
    for line in &panel.lines {
        let points: Vec<[f64; 2]> =
            line.points.iter().map(|p| place([p[0], p[1].clamp(panel.y[0], panel.y[1])])).collect();
        shapes.push(Shape::line(points, line.colour, line.width));
    }
}

/// Values over a hemisphere, drawn as seen along the normal (direction cosines).
pub struct Disc {
    /// Title above the disc.
    pub title: String,
    /// Values per pixel, row by row.
    pub values: Vec<f64>,
}

/// Number of pixels across a disc.
const DISC: usize = 200;

impl Disc {
    /// Creates a disc from the values of a function of the through direction.
    pub fn new(title: impl Into<String>, value: impl Fn(Dir<Facade>) -> f64) -> Self {
        let at = |k: usize| {
            let [x, y] = [k % DISC, k / DISC].map(|i| 2.0 * (i as f64 + 0.5) / DISC as f64 - 1.0);
            let rest = 1.0 - x * x - y * y;
            if rest > 0.0 { value(Dir::from_unit(DVec3::new(x, -y, rest.sqrt()))) } else { f64::NAN }
        };
        Self { title: title.into(), values: (0..DISC * DISC).map(at).collect() }
    }
}

/// Draws rows of discs as PNG. The discs of a row share one scale, from 0 to the largest value of the row.
pub fn discs(rows: &[Vec<Disc>], gamma: f64) -> anyhow::Result<Vec<u8>> {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let (wide, high) = (DISC + 40, DISC + 44);
    let mut shapes = Vec::new();
    for (r, row) in rows.iter().enumerate() {
        for (c, disc) in row.iter().enumerate() {
            let at = [(c * wide + wide / 2) as f64, (r * high + 18) as f64];
            shapes.push(Shape::text(at, disc.title.clone(), INK));
        }
    }
    let drawing = Drawing { width: (columns * wide) as f64, height: (rows.len() * high + 10) as f64, shapes };
    let mut picture = image::load_from_memory(&drawing.to_png()?)?.to_rgb8();
    for (r, row) in rows.iter().enumerate() {
        let most = row.iter().flat_map(|disc| &disc.values).copied().fold(0.0, f64::max);
        for (c, disc) in row.iter().enumerate() {
            paint(&mut picture, disc, [c * wide + 20, r * high + 34], most, gamma);
        }
    }
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png)?;
    Ok(bytes.into_inner())
}

fn paint(picture: &mut RgbImage, disc: &Disc, [left, top]: [usize; 2], most: f64, gamma: f64) {
    for (k, value) in disc.values.iter().enumerate().filter(|(_, value)| value.is_finite()) {
        let share = if most > 0.0 { (value / most).clamp(0.0, 1.0).powf(gamma) } else { 0.0 };
        picture.put_pixel((left + k % DISC) as u32, (top + k / DISC) as u32, image::Rgb(shade(share)));
    }
}

/// Returns the colour of a value from 0 to 1: dark blue, green, yellow, so that more light is brighter in print too.
fn shade(share: f64) -> Rgb {
    const STOPS: [[f64; 3]; 6] = [
        [38.0, 8.0, 62.0],
        [62.0, 64.0, 136.0],
        [40.0, 120.0, 142.0],
        [48.0, 172.0, 118.0],
        [150.0, 214.0, 58.0],
        [253.0, 236.0, 110.0],
    ];
    // 64 steps keep the compressed file small.
    let place = (share * 63.0).round() / 63.0 * (STOPS.len() - 1) as f64;
    let k = (place as usize).min(STOPS.len() - 2);
    let t = place - k as f64;
    std::array::from_fn(|i| (STOPS[k][i] * (1.0 - t) + STOPS[k + 1][i] * t).round() as u8)
}
