//! Drawing: shapes on a sheet of paper, and its output as SVG, PNG and pixels.

use super::font;
use super::raster::Raster;
use super::shape::{Frame, Shape, moved};
use super::svg;
use crate::texts::{character_names, export as texts};

/// Drawing: shapes on white paper, later ones on top of earlier ones. Positions are in drawing units, x to the right
/// and y down from the upper left corner of the paper.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// Width of the paper. \[drawing units\]
    pub width: f64,
    /// Height of the paper. \[drawing units\]
    pub height: f64,
    /// Shapes of the drawing, the lowest first.
    pub shapes: Vec<Shape>,
}

impl Drawing {
    /// Creates empty paper of the given width and height. \[drawing units\]
    pub const fn new(width: f64, height: f64) -> Self {
        Self { width, height, shapes: Vec::new() }
    }

    /// Returns the rectangle of the whole paper. \[drawing units\]
    pub const fn frame(&self) -> Frame {
        Frame::new(0.0, 0.0, self.width, self.height)
    }

    /// Adds a shape on top of all others.
    pub fn add(&mut self, shape: Shape) {
        self.shapes.push(shape);
    }

    /// Adds the shapes of another drawing, scaled to the largest size that fits into a frame of this one and centred in
    /// it.
    pub fn place(&mut self, other: &Self, frame: Frame) {
        let scale = (frame.width / other.width).min(frame.height / other.height);
        let [x, y] = frame.centre();
        let corner = [x - 0.5 * scale * other.width, y - 0.5 * scale * other.height];
        self.shapes.extend(other.shapes.iter().map(|shape| moved(shape, scale, corner)));
    }

    /// Returns the drawing as SVG text, one pixel per unit.
    pub fn to_svg(&self) -> String {
        self.svg((1.0, "px"))
    }

    /// Returns the drawing as SVG text. `unit`: size of a drawing unit in the file, as a number of `px` or `mm`.
    pub fn svg(&self, unit: (f64, &str)) -> String {
        svg::write(&self.shapes, [self.width, self.height], unit)
    }

    /// Returns the drawing as bytes of a PNG file, one pixel per drawing unit, anti-aliased.
    ///
    /// # Errors
    /// Returns an error if there are more pixels than a PNG can have.
    pub fn to_png(&self) -> Result<Vec<u8>, png::EncodingError> {
        self.png(1.0, None)
    }

    /// Returns the drawing as bytes of a PNG file with `scale` pixels per drawing unit. `per_metre`: resolution that
    /// the file states, in pixels per metre of paper; `None` if the picture has no size on paper.
    ///
    /// # Errors
    /// Returns an error if there are more pixels than a PNG can have.
    pub fn png(&self, scale: f64, per_metre: Option<f64>) -> Result<Vec<u8>, png::EncodingError> {
        self.raster(scale).to_png(per_metre)
    }

    /// Renders the drawing with `scale` pixels per drawing unit: returns width and height in pixels, and red, green and
    /// blue of each pixel, row by row from the top.
    pub fn to_pixels(&self, scale: f64) -> (usize, usize, Vec<u8>) {
        let raster = self.raster(scale);
        (raster.width, raster.height, raster.pixels)
    }

    fn raster(&self, scale: f64) -> Raster {
        let size = |length: f64| ((length * scale).round() as usize).max(1);
        let mut raster = Raster::white(size(self.width), size(self.height));
        for shape in &self.shapes {
            raster.draw(&moved(shape, scale, [0.0, 0.0]));
        }
        raster
    }
}

/// Returns a message that names the characters of all drawings that the font does not have (PNG and PDF show a box for
/// each); `None` if it has all.
pub fn missing_characters(drawings: &[Drawing]) -> Option<String> {
    let (mut missing, mut first) = (Vec::new(), None);
    for shape in drawings.iter().flat_map(|drawing| &drawing.shapes) {
        let Shape::Text { text, .. } = shape else { continue };
        for character in font::missing_characters(text) {
            first.get_or_insert(text);
            if !missing.contains(&character) {
                missing.push(character);
            }
        }
    }
    first.map(|text| texts::missing_characters(text, character_names(&missing)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_that_are_drawn_as_boxes_are_named_once() {
        let mut drawing = cross();
        assert_eq!(missing_characters(&[drawing.clone()]), None);
        drawing.add(Shape::text([0.0, 0.0], "Room – 铝百叶窗 80", [0; 3]));
        drawing.add(Shape::text([0.0, 0.0], "百叶", [0; 3]));
        let message = missing_characters(&[cross(), drawing.clone(), drawing.clone()]).unwrap();
        assert!(message.contains("Room – 铝百叶窗 80") && message.contains("铝 (U+94DD)"), "{message}");
        assert_eq!(message.matches("U+").count(), 4, "{message}");
        // What is said is true: an SVG has the text, in the order of its letters.
        assert!(drawing.to_svg().contains("铝百叶窗"));
        drawing.shapes = vec![Shape::text([0.0, 0.0], "תריס 80", [0; 3])];
        assert!(missing_characters(&[drawing.clone()]).is_none() && drawing.to_svg().contains(">תריס 80<"));
    }

    fn cross() -> Drawing {
        Drawing {
            width: 40.0,
            height: 30.0,
            shapes: vec![
                Shape::line([[0.0, 10.5], [40.0, 10.5]], [200, 0, 0], 1.0),
                Shape::area([[30.0, 20.0], [38.0, 20.0], [38.0, 28.0], [30.0, 28.0]], [0, 0, 200]),
                Shape::text([15.0, 22.0], "1<2", [0, 0, 0]),
            ],
        }
    }

    #[test]
    fn png_holds_line_and_area_where_they_were_drawn() {
        let png = image::load_from_memory(&cross().to_png().unwrap()).unwrap().to_rgb8();
        assert_eq!(png.dimensions(), (40, 30));
        assert_eq!(png.get_pixel(5, 10).0, [200, 0, 0]);
        assert_eq!(png.get_pixel(5, 9).0, [255, 255, 255]);
        assert_eq!(png.get_pixel(34, 24).0, [0, 0, 200]);
        assert_eq!((png.get_pixel(34, 19).0, png.get_pixel(38, 24).0), ([255; 3], [255; 3]));
        // The letters are dark and stand about their middle.
        let dark = |x: u32, y: u32| png.get_pixel(x, y).0.iter().all(|part| *part < 110);
        let rows: Vec<u32> = (14..30).filter(|y| (0..28).any(|x| dark(x, *y))).collect();
        let middle = 0.5 * f64::from(rows[0] + rows[rows.len() - 1]);
        assert!((middle - 21.5).abs() < 1.6 && rows.len() >= 8 && rows.len() <= 12, "{rows:?}");
        // Twice as fine.
        let png = image::load_from_memory(&cross().png(2.0, None).unwrap()).unwrap().to_rgb8();
        assert_eq!((png.dimensions(), png.get_pixel(68, 48).0), ((80, 60), [0, 0, 200]));
    }

    #[test]
    fn svg_is_well_formed_and_says_its_size() {
        let svg = cross().svg((0.25, "mm"));
        let tree = roxmltree::Document::parse(&svg).unwrap();
        assert!(tree.descendants().any(|node| node.text() == Some("1<2")));
        assert_eq!(tree.root_element().attribute("width"), Some("10mm"));
        assert_eq!(tree.root_element().attribute("viewBox"), Some("0 0 40 30"));
        assert_eq!(tree.descendants().filter(|node| node.has_tag_name("polygon")).count(), 1);
    }

    #[test]
    fn shapes_beyond_the_paper_are_cut() {
        let mut drawing = cross();
        drawing.add(Shape::line([[-50.0, -50.0], [90.0, 90.0]], [0; 3], 3.0));
        drawing.add(Shape::area([[-50.0, -50.0], [5.0, -50.0], [5.0, 90.0], [-50.0, 90.0]], [9, 9, 9]));
        drawing.add(Shape::text([0.0, 0.0], "88", [0; 3]));
        let png = image::load_from_memory(&drawing.to_png().unwrap()).unwrap().to_rgb8();
        assert_eq!((png.get_pixel(2, 25).0, png.get_pixel(6, 29).0), ([9, 9, 9], [255; 3]));
    }

    #[test]
    fn a_drawing_is_placed_as_large_as_fits() {
        let mut paper = Drawing::new(200.0, 100.0);
        paper.place(&cross(), Frame::new(100.0, 0.0, 100.0, 60.0));
        let Shape::Line { points, width, .. } = &paper.shapes[0] else { panic!("a line") };
        assert_eq!((points[0], points[1], *width), ([110.0, 21.0], [190.0, 21.0], 2.0));
    }
}
