//! Pictures that need no window: line drawings with a little text, written as SVG or as PNG, and what an ordinary plot
//! shows, for these drawings ([`chart`]) as for the window. Pure: numbers in, shapes, text and bytes out.
//!
//! Coordinates are pixels, x right, y down. The PNG is drawn without a font library, with the letters of
//! `dot_font`; other characters leave a gap.

pub mod chart;
mod dot_font;
pub mod plot;
pub mod ticks;

use dot_font::glyph;
use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};
use std::fmt::Write as _;

/// Red, green, blue.
pub type Rgb = [u8; 3];

/// A part of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A line through points.
    Line {
        /// Corner points.
        points: Vec<[f64; 2]>,
        /// Colour.
        colour: Rgb,
        /// Width in pixels.
        width: f64,
    },
    /// Text centred on a point.
    Text {
        /// Centre.
        at: [f64; 2],
        /// One line.
        text: String,
        /// Colour.
        colour: Rgb,
    },
}

/// Shapes on white paper, later ones on top.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// What is drawn.
    pub shapes: Vec<Shape>,
}

impl Drawing {
    /// As SVG text.
    pub fn to_svg(&self) -> String {
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\">\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"white\"/>\n",
            w = self.width,
            h = self.height
        );
        for shape in &self.shapes {
            let written = match shape {
                Shape::Line { points, colour: [r, g, b], width } => {
                    let path: Vec<String> = points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
                    let path = path.join(" ");
                    writeln!(
                        svg,
                        "<polyline points=\"{path}\" fill=\"none\" stroke=\"rgb({r},{g},{b})\" \
                         stroke-width=\"{width}\" stroke-linejoin=\"round\"/>"
                    )
                }
                Shape::Text { at: [x, y], text, colour: [r, g, b] } => {
                    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
                    writeln!(
                        svg,
                        "<text x=\"{x:.2}\" y=\"{y:.2}\" fill=\"rgb({r},{g},{b})\" font-family=\"sans-serif\" \
                         font-size=\"14\" text-anchor=\"middle\" dominant-baseline=\"central\">{text}</text>"
                    )
                }
            };
            written.expect("writing to a String cannot fail");
        }
        svg.push_str("</svg>\n");
        svg
    }

    /// As PNG bytes; lines are anti-aliased.
    pub fn to_png(&self) -> Result<Vec<u8>, image::ImageError> {
        let mut raster = Raster::white(self.width as usize, self.height as usize);
        for shape in &self.shapes {
            match shape {
                Shape::Line { points, colour, width } => {
                    raster.line(points, *colour, *width);
                }
                Shape::Text { at, text, colour } => raster.text(*at, text, *colour),
            }
        }
        let mut bytes = Vec::new();
        PngEncoder::new(&mut bytes).write_image(&raster.pixels, self.width, self.height, ExtendedColorType::Rgb8)?;
        Ok(bytes)
    }
}

struct Raster {
    width: usize,
    height: usize,
    pixels: Vec<u8>,
}

impl Raster {
    fn white(width: usize, height: usize) -> Self {
        Self { width, height, pixels: vec![255; 3 * width * height] }
    }

    fn cover(&mut self, x: usize, y: usize, colour: Rgb, share: f64) {
        let start = 3 * (y * self.width + x);
        for (pixel, ink) in self.pixels[start..start + 3].iter_mut().zip(colour) {
            *pixel = (f64::from(*pixel) * (1.0 - share) + f64::from(ink) * share).round() as u8;
        }
    }

    /// Coverage of a pixel by its distance to the line: one pixel of transition. Joints are not inked twice.
    fn line(&mut self, points: &[[f64; 2]], colour: Rgb, width: f64) {
        let reach = 0.5 * width + 1.0;
        let mut coverage = std::collections::BTreeMap::new();
        for pair in points.windows(2) {
            let [[ax, ay], [bx, by]] = [pair[0], pair[1]];
            let (dx, dy) = (bx - ax, by - ay);
            let length_squared = dx * dx + dy * dy;
            let span = |a: f64, b: f64, limit: usize| {
                let from = (a.min(b) - reach).floor().max(0.0) as usize;
                from..((a.max(b) + reach).ceil().max(0.0) as usize).min(limit)
            };
            for y in span(ay, by, self.height) {
                for x in span(ax, bx, self.width) {
                    let (px, py) = (x as f64 + 0.5 - ax, y as f64 + 0.5 - ay);
                    let along =
                        if length_squared > 0.0 { ((px * dx + py * dy) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
                    let distance = (px - along * dx).hypot(py - along * dy);
                    let share = (0.5 * width + 0.5 - distance).clamp(0.0, 1.0);
                    if share > 0.0 {
                        let most = coverage.entry((x, y)).or_insert(share);
                        *most = share.max(*most);
                    }
                }
            }
        }
        for ((x, y), share) in coverage {
            self.cover(x, y, colour, share);
        }
    }

    fn text(&mut self, [centre_x, centre_y]: [f64; 2], text: &str, colour: Rgb) {
        const SCALE: usize = 2;
        const ADVANCE: usize = 6 * SCALE;
        let left = centre_x - 0.5 * (text.chars().count() * ADVANCE) as f64;
        let top = centre_y - 3.5 * SCALE as f64;
        for (k, c) in text.chars().enumerate() {
            for (row, dots) in glyph(c).into_iter().enumerate() {
                for column in (0..5).filter(|column| dots >> (4 - column) & 1 == 1) {
                    for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                        let x = left + (k * ADVANCE + column * SCALE + dx) as f64;
                        let y = top + (row * SCALE + dy) as f64;
                        if x >= 0.0 && y >= 0.0 && (x as usize) < self.width && (y as usize) < self.height {
                            self.cover(x as usize, y as usize, colour, 1.0);
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cross() -> Drawing {
        Drawing {
            width: 40,
            height: 30,
            shapes: vec![
                Shape::Line { points: vec![[0.0, 10.5], [40.0, 10.5]], colour: [200, 0, 0], width: 1.0 },
                Shape::Text { at: [20.0, 20.0], text: "1<2".into(), colour: [0, 0, 0] },
            ],
        }
    }

    #[test]
    fn png_holds_the_line_where_it_was_drawn() {
        let png = image::load_from_memory(&cross().to_png().unwrap()).unwrap().to_rgb8();
        assert_eq!(png.dimensions(), (40, 30));
        assert_eq!(png.get_pixel(5, 10).0, [200, 0, 0]);
        assert_eq!(png.get_pixel(5, 9).0, [255, 255, 255]);
        assert_eq!(png.get_pixel(5, 12).0, [255, 255, 255]);
    }

    #[test]
    fn svg_is_well_formed() {
        let svg = cross().to_svg();
        let tree = roxmltree::Document::parse(&svg).unwrap();
        assert!(tree.descendants().any(|node| node.text() == Some("1<2")));
    }

    #[test]
    fn shapes_beyond_the_paper_are_cut() {
        let mut drawing = cross();
        drawing.shapes.push(Shape::Line { points: vec![[-50.0, -50.0], [90.0, 90.0]], colour: [0; 3], width: 3.0 });
        drawing.shapes.push(Shape::Text { at: [0.0, 0.0], text: "88".into(), colour: [0; 3] });
        assert!(drawing.to_png().is_ok());
    }
}
