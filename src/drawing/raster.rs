//! Rendering of a drawing to pixels, anti-aliased: areas by the share of every pixel that they cover, lines by the
//! pixel's distance from them.

use super::font::{MIDDLE, outlines, width};
use super::shape::{Point, Rgb, Shape};
use png::{BitDepth, ColorType, Encoder, EncodingError, PixelDimensions, Unit};

pub(super) struct Raster {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) pixels: Vec<u8>,
    /// Largest coverage of each pixel by the line that is being drawn, so that joints are not inked twice.
    cover: Vec<f32>,
}

impl Raster {
    pub(super) fn white(width: usize, height: usize) -> Self {
        Self { width, height, pixels: vec![255; 3 * width * height], cover: vec![0.0; width * height] }
    }

    /// Returns the bytes of a PNG file. `per_metre`: resolution that the file states, in pixels per metre of paper;
    /// `None` if the picture has no size on paper.
    pub(super) fn to_png(&self, per_metre: Option<f64>) -> Result<Vec<u8>, EncodingError> {
        // More than a PNG can have fails in the encoder, which checks the bytes against the size.
        let [width, height] = [self.width, self.height].map(|size| u32::try_from(size).unwrap_or(u32::MAX));
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, width, height);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        let density = per_metre.map(|dots| dots.round() as u32);
        encoder.set_pixel_dims(density.map(|dots| PixelDimensions { xppu: dots, yppu: dots, unit: Unit::Meter }));
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.pixels)?;
        writer.finish()?;
        Ok(bytes)
    }

    /// Draws a shape whose positions and lengths are in pixels.
    pub(super) fn draw(&mut self, shape: &Shape) {
        match shape {
            Shape::Line { points, colour, width, dash: None } => self.line(points, *colour, *width),
            Shape::Line { points, colour, width, dash: Some(dash) } => {
                for stroke in strokes(points, *dash) {
                    self.line(&stroke, *colour, *width);
                }
            }
            Shape::Area { points, colour, opacity, edge } => {
                self.fill(std::slice::from_ref(points), *colour, *opacity);
                if let (true, Some(first)) = (*edge > 0.0, points.first()) {
                    let closed: Vec<Point> = points.iter().chain([first]).copied().collect();
                    // At least as wide as closes what two neighbours leave of a pixel that they share.
                    self.line(&closed, *colour, edge.max(1.5));
                }
            }
            Shape::Text { at: [x, y], text, colour, size, align, turn } => {
                let start = -align.share() * width(text, *size);
                let (sin, cos) = turn.to_radians().sin_cos();
                let place = |[u, v]: Point| {
                    let (u, v) = (u + start, v + MIDDLE * size);
                    [x + u * cos - v * sin, y + u * sin + v * cos]
                };
                for letter in outlines(text, *size) {
                    let turned: Vec<Vec<Point>> =
                        letter.into_iter().map(|contour| contour.into_iter().map(place).collect()).collect();
                    self.fill(&turned, *colour, 1.0);
                }
            }
        }
    }

    fn blend(&mut self, x: usize, y: usize, colour: Rgb, share: f64) {
        let start = 3 * (y * self.width + x);
        for (pixel, ink) in self.pixels[start..start + 3].iter_mut().zip(colour) {
            *pixel = (f64::from(*pixel) * (1.0 - share) + f64::from(ink) * share).round() as u8;
        }
    }

    /// Draws a line of a given width \[pixels\]; the coverage of a pixel falls from 1 to 0 over one pixel of distance
    /// at the line's edges.
    fn line(&mut self, points: &[Point], colour: Rgb, width: f64) {
        // What is thinner than a pixel is drawn as wide as one, and paler.
        let (width, ink) = if width < 1.0 { (1.0, width) } else { (width, 1.0) };
        let reach = 0.5 * width + 1.0;
        let mut touched = Vec::new();
        for pair in points.windows(2) {
            let [[ax, ay], [bx, by]] = [pair[0], pair[1]];
            let (dx, dy) = (bx - ax, by - ay);
            let length_squared = dx * dx + dy * dy;
            let span = |a: f64, b: f64, limit: usize| {
                let from = (a.min(b) - reach).floor().max(0.0) as usize;
                from..((a.max(b) + reach).ceil().max(0.0) as usize).min(limit)
            };
            for y in span(ay, by, self.height) {
                // Along a slanted line only what lies near it in this row.
                let across = if dy.abs() > 1e-9 {
                    let at = |row: f64| ax + dx * ((row - ay) / dy).clamp(0.0, 1.0);
                    let (p, q) = (at(y as f64 - reach), at(y as f64 + 1.0 + reach));
                    span(p, q, self.width)
                } else {
                    span(ax, bx, self.width)
                };
                for x in across {
                    let (px, py) = (x as f64 + 0.5 - ax, y as f64 + 0.5 - ay);
                    let along =
                        if length_squared > 0.0 { ((px * dx + py * dy) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
                    let distance = (px - along * dx).hypot(py - along * dy);
                    let share = (0.5 * width + 0.5 - distance).clamp(0.0, 1.0) as f32;
                    let place = y * self.width + x;
                    if share > self.cover[place] {
                        if self.cover[place] == 0.0 {
                            touched.push([x, y]);
                        }
                        self.cover[place] = share;
                    }
                }
            }
        }
        for [x, y] in touched {
            let share = std::mem::take(&mut self.cover[y * self.width + x]);
            self.blend(x, y, colour, f64::from(share) * ink);
        }
    }

    /// Fills the inside of contours by signed areas: each edge adds to every pixel right of it its coverage of the row.
    fn fill(&mut self, contours: &[Vec<Point>], colour: Rgb, opacity: f64) {
        let all = || contours.iter().flatten().filter(|p| p[0].is_finite() && p[1].is_finite());
        let bound = |axis: usize| {
            all().fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], p| [lo.min(p[axis]), hi.max(p[axis])])
        };
        let ([left, right], [top, bottom]) = (bound(0), bound(1));
        let clipped = |value: f64, limit: usize| value.clamp(-1.0, limit as f64 + 1.0);
        let (left, right) = (clipped(left, self.width).floor(), clipped(right, self.width).ceil());
        let (top, bottom) = (clipped(top, self.height).floor().max(0.0), clipped(bottom, self.height).ceil());
        if !(right > left && bottom > top) {
            return;
        }
        let (columns, rows) = ((right - left) as usize + 2, (bottom - top) as usize);
        let mut sums = vec![0.0; columns * rows];
        for contour in contours {
            let next = contour.iter().cycle().skip(1);
            for (a, b) in contour.iter().zip(next) {
                // What lies beside the paper is moved to its edge: its rows are covered all the same.
                edge(&mut sums, columns, rows, [*a, *b].map(|[x, y]| [x.clamp(left, right) - left, y - top]));
            }
        }
        for row in 0..rows {
            let y = top as usize + row;
            if y >= self.height {
                break;
            }
            let mut sum = 0.0;
            for column in 0..columns {
                sum += sums[row * columns + column];
                let x = left as isize + column as isize;
                let share = f64::abs(sum).min(1.0);
                if share > 1e-3 && x >= 0 && (x as usize) < self.width {
                    self.blend(x as usize, y, colour, share * opacity);
                }
            }
        }
    }
}

/// Adds one edge of a contour to `sums`: its signed coverage of the pixels in each row, stored as differences along the
/// row.
fn edge(sums: &mut [f64], columns: usize, rows: usize, [a, b]: [Point; 2]) {
    if a[1] == b[1] || !(a[1] - b[1]).is_finite() {
        return;
    }
    let (sign, from, to) = if a[1] < b[1] { (1.0, a, b) } else { (-1.0, b, a) };
    let slope = (to[0] - from[0]) / (to[1] - from[1]);
    let mut x = if from[1] < 0.0 { from[0] - from[1] * slope } else { from[0] };
    let first = from[1].max(0.0) as usize;
    for row in first..rows.min(to[1].ceil().max(0.0) as usize) {
        let (upper, lower) = (row as f64, row as f64 + 1.0);
        let height = lower.min(to[1]) - upper.max(from[1]);
        let next = x + slope * height;
        let amount = height * sign;
        let (x0, x1) = if x < next { (x, next) } else { (next, x) };
        let (start, end) = (x0.floor().max(0.0) as usize, x1.ceil().max(0.0) as usize);
        let line = &mut sums[row * columns..(row + 1) * columns];
        if end <= start + 1 {
            let middle = 0.5 * (x + next) - start as f64;
            line[start] += amount * (1.0 - middle);
            line[start + 1] += amount * middle;
        } else {
            // Coverage so far after each column: the edge passes through several of them.
            let steep = 1.0 / (x1 - x0);
            let covered = |column: usize| {
                let right = column as f64 + 1.0;
                if right <= x0 {
                    0.0
                } else if right >= x1 {
                    // Mean of what lies right of the edge over the last column.
                    1.0 - 0.5 * steep * (x1 - column as f64).max(0.0).powi(2)
                } else if (column as f64) < x0 {
                    0.5 * steep * (right - x0).powi(2)
                } else {
                    steep * (column as f64 + 0.5 - x0)
                }
            };
            let mut before = 0.0;
            for (column, place) in line.iter_mut().enumerate().take(end).skip(start) {
                let now = covered(column);
                *place += amount * (now - before);
                before = now;
            }
            line[end] += amount * (1.0 - before);
        }
        x = next;
    }
}

/// Returns the strokes of a dashed line. `on`, `off`: lengths of stroke and gap. \[pixels\]
fn strokes(points: &[Point], [on, off]: [f64; 2]) -> Vec<Vec<Point>> {
    if !(on > 0.0 && off > 0.0) {
        return vec![points.to_vec()];
    }
    let mut list = Vec::new();
    let mut stroke: Vec<Point> = points.first().copied().into_iter().collect();
    let (mut inked, mut left) = (true, on);
    for pair in points.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let share = done / length;
            let at = [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share];
            if inked {
                stroke.push(at);
                list.push(std::mem::take(&mut stroke));
            } else {
                stroke = vec![at];
            }
            inked = !inked;
            left = if inked { on } else { off };
        }
        left -= length - done;
        if inked {
            stroke.push(b);
        }
    }
    if stroke.len() > 1 {
        list.push(stroke);
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(raster: &Raster) -> f64 {
        raster.pixels.chunks(3).map(|pixel| 1.0 - f64::from(pixel[0]) / 255.0).sum()
    }

    #[test]
    fn ink_is_the_area_at_any_place() {
        let triangle = |dx: f64, dy: f64| vec![[2.3 + dx, 1.1 + dy], [33.7 + dx, 9.6 + dy], [8.2 + dx, 27.9 + dy]];
        let area = 0.5 * ((31.4 * 26.8) - (5.9 * 8.5_f64)).abs();
        for (dx, dy) in [(0.0, 0.0), (0.5, 0.25), (1.37, 2.71)] {
            let mut raster = Raster::white(40, 40);
            raster.fill(&[triangle(dx, dy)], [0; 3], 1.0);
            assert!((grey(&raster) / area - 1.0).abs() < 5e-3, "{} {area}", grey(&raster));
        }
        // A square with a square hole that runs the other way.
        let square = |lo: f64, hi: f64| vec![[lo, lo], [hi, lo], [hi, hi], [lo, hi]];
        let hole: Vec<Point> = square(10.5, 20.5).into_iter().rev().collect();
        let mut raster = Raster::white(40, 40);
        raster.fill(&[square(5.25, 30.25), hole], [0; 3], 1.0);
        assert!((grey(&raster) - 525.0).abs() < 2.0, "{}", grey(&raster));
    }

    #[test]
    fn touching_cells_leave_no_seam() {
        let mut raster = Raster::white(40, 40);
        let cell = |a: f64, b: f64| vec![[a, -1.0], [b, -1.0], [b + 7.3, 41.0], [a + 7.3, 41.0]];
        for (a, b) in [(-20.0, 10.37), (10.37, 17.61), (17.61, 50.0)] {
            raster.draw(&Shape::cell(cell(a, b), [0; 3]));
        }
        assert!(raster.pixels.iter().all(|part| *part < 8));
    }

    #[test]
    fn dashes_have_their_lengths() {
        let list = strokes(&[[0.0, 0.0], [7.0, 0.0], [7.0, 5.0]], [3.0, 2.0]);
        assert_eq!(
            list,
            [vec![[0.0, 0.0], [3.0, 0.0]], vec![[5.0, 0.0], [7.0, 0.0], [7.0, 1.0]], vec![[7.0, 3.0], [7.0, 5.0]]]
        );
    }
}
