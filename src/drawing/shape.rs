//! Shapes of drawings: lines, areas and text, and rectangles for their layout. Positions and lengths are in drawing
//! units, x to the right and y down from the upper left corner of the paper.

use std::f64::consts::TAU;

/// Colour in sRGB: red, green and blue, 0 … 255.
pub type Rgb = [u8; 3];
/// Point on paper: x to the right and y down from its upper left corner. \[drawing units\]
pub type Point = [f64; 2];

/// Shape of a drawing: a line, an area or a text. Positions and lengths are in drawing units.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// Line through points, solid or dashed.
    Line {
        /// Points of the line in order; a closed line repeats its first. \[drawing units\]
        points: Vec<Point>,
        /// Colour of the line.
        colour: Rgb,
        /// Width of the line. \[drawing units\]
        width: f64,
        /// Lengths of stroke and gap \[drawing units\]; `None` for a solid line.
        dash: Option<[f64; 2]>,
    },
    /// Filled polygon that does not cross itself.
    Area {
        /// Corners of the polygon in order; the first is not repeated. \[drawing units\]
        points: Vec<Point>,
        /// Colour of the area.
        colour: Rgb,
        /// Opacity of the area, 0 (invisible) … 1 (opaque).
        opacity: f64,
        /// Width of an outline in the colour of the area, so that adjacent areas leave no seam; 0 for none.
        /// \[drawing units\]
        edge: f64,
    },
    /// One line of text.
    Text {
        /// Anchor of the text on paper: vertically at half the height of capital letters, horizontally at the start,
        /// centre or end of the text, depending on `align`. \[drawing units\]
        at: Point,
        /// Characters of the text.
        text: String,
        /// Colour of the text.
        colour: Rgb,
        /// Font size. \[drawing units\]
        size: f64,
        /// Horizontal alignment of the text to the anchor `at`.
        align: Align,
        /// Rotation of the text about the anchor `at`, clockwise. \[°\]
        turn: f64,
    },
}

/// Horizontal alignment of a text: its point that lies at the anchor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Align {
    /// The text begins at the anchor.
    Start,
    /// The text is centred at the anchor.
    #[default]
    Middle,
    /// The text ends at the anchor.
    End,
}

impl Align {
    /// Returns the share of the text's width that lies left of the anchor: 0, 0.5 or 1.
    pub const fn share(self) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::Middle => 0.5,
            Self::End => 1.0,
        }
    }
}

/// Default font size. \[drawing units\]
pub const TEXT: f64 = 13.0;

impl Shape {
    /// Creates a solid line through points. `points`, `width`: in drawing units.
    pub fn line(points: impl Into<Vec<Point>>, colour: Rgb, width: f64) -> Self {
        Self::Line { points: points.into(), colour, width, dash: None }
    }

    /// Creates a dashed line through points. `points`, `width`, `dash` (lengths of stroke and gap): in drawing units.
    pub fn dashed(points: impl Into<Vec<Point>>, colour: Rgb, width: f64, dash: [f64; 2]) -> Self {
        Self::Line { points: points.into(), colour, width, dash: Some(dash) }
    }

    /// Creates an opaque filled polygon from its corners. \[drawing units\]
    pub fn area(points: impl Into<Vec<Point>>, colour: Rgb) -> Self {
        Self::Area { points: points.into(), colour, opacity: 1.0, edge: 0.0 }
    }

    /// Creates an opaque filled polygon with a thin outline of the same colour, so that adjacent polygons leave no
    /// seam. `points`: corners in drawing units.
    pub fn cell(points: impl Into<Vec<Point>>, colour: Rgb) -> Self {
        Self::Area { points: points.into(), colour, opacity: 1.0, edge: 0.8 }
    }

    /// Creates a filled circle. `centre`, `radius`: in drawing units.
    pub fn dot(centre: Point, radius: f64, colour: Rgb) -> Self {
        Self::area(circle(centre, radius), colour)
    }

    /// Creates the outline of a circle. `centre`, `radius`, `width` of the line: in drawing units.
    pub fn ring(centre: Point, radius: f64, colour: Rgb, width: f64) -> Self {
        Self::line(circle(centre, radius), colour, width)
    }

    /// Creates a text of the default size that is centred on a point. \[drawing units\]
    pub fn text(at: Point, text: impl Into<String>, colour: Rgb) -> Self {
        Self::words(at, text, colour, TEXT, Align::Middle)
    }

    /// Creates a text of a given font size and alignment. `at`: anchor, at half the height of capital letters. `at`,
    /// `size`: in drawing units.
    pub fn words(at: Point, text: impl Into<String>, colour: Rgb, size: f64, align: Align) -> Self {
        Self::Text { at, text: text.into(), colour, size, align, turn: 0.0 }
    }
}

/// Returns the points of a circle as a closed polygon, whose last point is the first. `[x, y]`: centre. All lengths are
/// in drawing units.
pub fn circle([x, y]: Point, radius: f64) -> Vec<Point> {
    let count = (24.0 + radius).min(180.0) as usize;
    let angle = |k: usize| TAU * k as f64 / count as f64;
    (0..=count).map(|k| [x + radius * angle(k).cos(), y + radius * angle(k).sin()]).collect()
}

/// Rectangle of a drawing, for layout. Positions are in drawing units, x to the right and y down from the upper left
/// corner of the paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// x coordinate of the left edge. \[drawing units\]
    pub left: f64,
    /// y coordinate of the upper edge. \[drawing units\]
    pub top: f64,
    /// Width, to the right. \[drawing units\]
    pub width: f64,
    /// Height, downwards. \[drawing units\]
    pub height: f64,
}

impl Frame {
    /// Creates a rectangle from its upper left corner, width and height. \[drawing units\]
    pub const fn new(left: f64, top: f64, width: f64, height: f64) -> Self {
        Self { left, top, width, height }
    }

    /// Returns the x coordinate of the right edge. \[drawing units\]
    pub const fn right(&self) -> f64 {
        self.left + self.width
    }

    /// Returns the y coordinate of the lower edge. \[drawing units\]
    pub const fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Returns the centre of the rectangle. \[drawing units\]
    pub const fn centre(&self) -> Point {
        [self.left + 0.5 * self.width, self.top + 0.5 * self.height]
    }

    /// Returns the rectangle reduced by margins at its left, above, right and below, but at least 1 wide and high.
    /// \[drawing units\]
    pub const fn inside(&self, [left, above, right, below]: [f64; 4]) -> Self {
        let (width, height) = (self.width - left - right, self.height - above - below);
        Self::new(self.left + left, self.top + above, width.max(1.0), height.max(1.0))
    }

    /// Splits the rectangle by a vertical line into a left part, of the given share of the width, and the right
    /// remainder.
    pub const fn split(&self, share: f64) -> [Self; 2] {
        let width = self.width * share;
        let right = Self::new(self.left + width, self.top, self.width - width, self.height);
        [Self::new(self.left, self.top, width, self.height), right]
    }

    /// Splits the rectangle by a horizontal line into the upper part and a strip of `height` at the bottom.
    /// \[drawing units\]
    pub const fn cut_bottom(&self, height: f64) -> [Self; 2] {
        let above = Self::new(self.left, self.top, self.width, self.height - height);
        [above, Self::new(self.left, self.top + self.height - height, self.width, height)]
    }

    /// Returns the corners clockwise, from the upper left one.
    pub const fn corners(&self) -> [Point; 4] {
        let (right, bottom) = (self.right(), self.bottom());
        [[self.left, self.top], [right, self.top], [right, bottom], [self.left, bottom]]
    }

    /// Returns the border as a closed line, whose last point is the first.
    pub fn outline(&self) -> Vec<Point> {
        let [a, b, c, d] = self.corners();
        vec![a, b, c, d, a]
    }

    /// Whether this rectangle and another one overlap.
    pub fn meets(&self, other: &Self) -> bool {
        self.left < other.right() && other.left < self.right() && self.top < other.bottom() && other.top < self.bottom()
    }

    /// Whether another rectangle lies entirely within this one.
    pub fn holds(&self, other: &Self) -> bool {
        other.left >= self.left
            && other.right() <= self.right()
            && other.top >= self.top
            && other.bottom() <= self.bottom()
    }
}

/// Returns a shape enlarged by `scale` about the origin, then moved to the right and down. \[drawing units\]
pub fn moved(shape: &Shape, scale: f64, [right, down]: Point) -> Shape {
    let place = |[x, y]: &Point| [right + scale * x, down + scale * y];
    let all = |points: &[Point]| points.iter().map(place).collect();
    match shape {
        Shape::Line { points, colour, width, dash } => Shape::Line {
            points: all(points),
            colour: *colour,
            width: width * scale,
            dash: dash.map(|dash| dash.map(|length| length * scale)),
        },
        Shape::Area { points, colour, opacity, edge } => {
            Shape::Area { points: all(points), colour: *colour, opacity: *opacity, edge: edge * scale }
        }
        Shape::Text { at, text, colour, size, align, turn } => Shape::Text {
            at: place(at),
            text: text.clone(),
            colour: *colour,
            size: size * scale,
            align: *align,
            turn: *turn,
        },
    }
}
