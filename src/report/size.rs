//! Size of an exported picture in pixels or millimetres.

use super::error::ReportError;
use crate::drawing::Drawing;
use crate::texts::export as texts;
use std::fmt;
use std::str::FromStr;

/// Unit of a picture's size.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum Unit {
    /// Pixels.
    #[default]
    Pixels,
    /// Millimetres on paper, at 300 pixels per inch.
    Millimetres,
}

/// Size of an exported picture: width and height in pixels or millimetres.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Size {
    /// Width of the picture, in `unit`.
    pub width: f64,
    /// Height of the picture, in `unit`.
    pub height: f64,
    /// Unit of width and height.
    pub unit: Unit,
}

/// Area of a drawing up to which letters have the default size; larger pictures have larger letters. \[drawing units²\]
const USUAL: f64 = 800.0 * 600.0;
/// Drawing units per millimetre with which letters have their default size: text is 3.25 mm high.
const FINE: f64 = 4.0;
/// Pixels per millimetre, for 300 per inch.
const DOTS: f64 = 300.0 / 25.4;
/// Minimum width and height of a picture, below which texts do not fit. \[px\]
const LEAST: f64 = 240.0;
/// Maximum width and height of a picture. \[px\]
const MOST: f64 = 8000.0;

impl Default for Size {
    fn default() -> Self {
        Self { width: 1600.0, height: 1200.0, unit: Unit::Pixels }
    }
}

impl Size {
    /// Creates a size if it is within the limits for pictures.
    ///
    /// # Errors
    /// Returns an error if the size is too small for the texts, or too large.
    pub fn new(width: f64, height: f64, unit: Unit) -> Result<Self, ReportError> {
        let size = Self { width, height, unit };
        let wrong = |why| Err(ReportError::Size(size.to_string(), why));
        let pixels = size.pixels();
        if !pixels.iter().all(|side| *side >= LEAST) {
            return wrong(texts::TOO_SMALL);
        }
        if pixels.iter().any(|side| *side > MOST) {
            return wrong(texts::TOO_LARGE);
        }
        Ok(size)
    }

    /// Returns width and height of the picture in pixels.
    pub fn pixels(&self) -> [f64; 2] {
        let dots = if self.unit == Unit::Pixels { 1.0 } else { DOTS };
        [self.width * dots, self.height * dots]
    }

    /// Returns the length of a drawing unit, in the unit of the size (pixels or millimetres).
    fn scale(&self) -> f64 {
        let usual = if self.unit == Unit::Pixels { 1.0 } else { 1.0 / FINE };
        usual * (self.width * self.height / (USUAL * usual * usual)).sqrt().max(1.0)
    }

    /// Returns width and height of the drawing that fills this size. \[drawing units\]
    pub fn paper(&self) -> [f64; 2] {
        let scale = self.scale();
        [self.width / scale, self.height / scale]
    }

    /// Returns a drawing, made for this size, as an SVG file.
    pub fn svg(&self, drawing: &Drawing) -> String {
        drawing.svg((self.scale(), if self.unit == Unit::Pixels { "px" } else { "mm" }))
    }

    /// Returns a drawing, made for this size, as a PNG file.
    ///
    /// # Errors
    /// Returns an error if the picture cannot be encoded.
    pub fn png(&self, drawing: &Drawing) -> Result<Vec<u8>, png::EncodingError> {
        let per_metre = (self.unit == Unit::Millimetres).then_some(1000.0 * DOTS);
        drawing.png(self.pixels()[0] / drawing.width, per_metre)
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}{}", self.width, self.height, if self.unit == Unit::Pixels { "" } else { "mm" })
    }
}

impl FromStr for Size {
    type Err = ReportError;

    fn from_str(text: &str) -> Result<Self, ReportError> {
        let typed = text.trim();
        let (numbers, unit) = match typed.strip_suffix("mm") {
            Some(numbers) => (numbers, Unit::Millimetres),
            None => (typed.strip_suffix("px").unwrap_or(typed), Unit::Pixels),
        };
        let parts = numbers.split_once(['x', '×']).and_then(|(width, height)| {
            let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
            Some((number(width)?, number(height)?))
        });
        let (width, height) = parts.ok_or_else(|| ReportError::Size(text.to_owned(), texts::NOT_TWO_NUMBERS))?;
        Self::new(width, height, unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_in_pixels_and_millimetres() {
        let size: Size = "1600x1200".parse().unwrap();
        assert_eq!((size.paper(), size.pixels()), ([800.0, 600.0], [1600.0, 1200.0]));
        let size: Size = " 160 × 120 mm".parse().unwrap();
        assert_eq!((size.to_string(), size.paper()), ("160x120mm".to_owned(), [640.0, 480.0]));
        let drawing = Drawing::new(640.0, 480.0);
        assert!(size.svg(&drawing).contains("width=\"160mm\" height=\"120mm\""));
        let bytes = size.png(&drawing).unwrap();
        let png = image::load_from_memory(&bytes).unwrap();
        assert_eq!((png.width(), png.height()), (1890, 1417));
        // 300 pixels an inch are 11 811 a metre; of a size in pixels nobody knows how large it is on paper.
        let density = |bytes: &[u8]| {
            let read = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
            read.info().pixel_dims.map(|dims| [dims.xppu, dims.yppu])
        };
        assert_eq!(density(&bytes), Some([11_811; 2]));
        let size: Size = "800x600".parse().unwrap();
        assert_eq!(density(&size.png(&Drawing::new(800.0, 600.0)).unwrap()), None);
        for wrong in ["", "1600", "ax3", "100x100", "9000x1000", "NaNx500", "-1600x1200", "10x10mm"] {
            let error = wrong.parse::<Size>().unwrap_err().to_string();
            assert!(error.contains("expected e.g. 1600x1200"), "{error}");
        }
    }
}
