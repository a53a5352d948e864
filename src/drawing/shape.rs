//! Shapes of drawings: lines, areas and text, and rectangles for their layout.

use std::f64::consts::TAU;

/// Colour: red, green, blue.
pub type Rgb = [u8; 3];
/// Point, x right and y down.
pub type Point = [f64; 2];

/// Shape of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// Line through points.
    Line {
        /// Corner points.
        points: Vec<Point>,
        /// Colour.
        colour: Rgb,
        /// Width.
        width: f64,
        /// Lengths of stroke and gap; `None`: solid.
        dash: Option<[f64; 2]>,
    },
    /// Inside of a polygon that does not cross itself.
    Area {
        /// Corner points.
        points: Vec<Point>,
        /// Colour.
        colour: Rgb,
        /// Opacity, 0 … 1.
        opacity: f64,
        /// Width of an outline in the same colour: neighbours that share a border leave no seam.
        edge: f64,
    },
    /// Line of text.
    Text {
        /// Middle of the height of the letters; across, the point that `align` states.
        at: Point,
        /// Text of the line.
        text: String,
        /// Colour.
        colour: Rgb,
        /// Size of the font.
        size: f64,
        /// End of the text that lies at the point.
        align: Align,
        /// Rotation, clockwise. \[°\]
        turn: f64,
    },
}

/// Alignment: the end of a text that lies at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Align {
    /// Left end.
    Start,
    /// Centre.
    #[default]
    Middle,
    /// Right end.
    End,
}

impl Align {
    /// Returns the share of the width that lies left of the place.
    pub const fn share(self) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::Middle => 0.5,
            Self::End => 1.0,
        }
    }
}

/// Default size of text.
pub const TEXT: f64 = 13.0;

impl Shape {
    /// Creates a solid line.
    pub fn line(points: impl Into<Vec<Point>>, colour: Rgb, width: f64) -> Self {
        Self::Line { points: points.into(), colour, width, dash: None }
    }

    /// Creates a dashed line.
    pub fn dashed(points: impl Into<Vec<Point>>, colour: Rgb, width: f64, dash: [f64; 2]) -> Self {
        Self::Line { points: points.into(), colour, width, dash: Some(dash) }
    }

    /// Creates an area in one colour.
    pub fn area(points: impl Into<Vec<Point>>, colour: Rgb) -> Self {
        Self::Area { points: points.into(), colour, opacity: 1.0, edge: 0.0 }
    }

    /// Creates an area whose neighbours share its borders.
    pub fn cell(points: impl Into<Vec<Point>>, colour: Rgb) -> Self {
        Self::Area { points: points.into(), colour, opacity: 1.0, edge: 0.8 }
    }

    /// Creates a filled circle.
    pub fn dot(centre: Point, radius: f64, colour: Rgb) -> Self {
        Self::area(circle(centre, radius), colour)
    }

    /// Creates the outline of a circle.
    pub fn ring(centre: Point, radius: f64, colour: Rgb, width: f64) -> Self {
        Self::line(circle(centre, radius), colour, width)
    }

    /// Creates a text centred on a point.
    pub fn text(at: Point, text: impl Into<String>, colour: Rgb) -> Self {
        Self::words(at, text, colour, TEXT, Align::Middle)
    }

    /// Creates a text of a given size and alignment.
    pub fn words(at: Point, text: impl Into<String>, colour: Rgb, size: f64, align: Align) -> Self {
        Self::Text { at, text: text.into(), colour, size, align, turn: 0.0 }
    }
}

/// Returns a closed circle as a polygon; the last point is the first.
pub fn circle([x, y]: Point, radius: f64) -> Vec<Point> {
    let count = (24.0 + radius).min(180.0) as usize;
    let angle = |k: usize| TAU * k as f64 / count as f64;
    (0..=count).map(|k| [x + radius * angle(k).cos(), y + radius * angle(k).sin()]).collect()
}

/// Rectangle of a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// x of the left edge.
    pub left: f64,
    /// y of the upper edge.
    pub top: f64,
    /// Width, to the right.
    pub width: f64,
    /// Height, downwards.
    pub height: f64,
}

impl Frame {
    /// Creates a frame from its upper left corner and its size.
    pub const fn new(left: f64, top: f64, width: f64, height: f64) -> Self {
        Self { left, top, width, height }
    }

    /// Returns x of the right edge.
    pub const fn right(&self) -> f64 {
        self.left + self.width
    }

    /// Returns y of the lower edge.
    pub const fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Returns the middle.
    pub const fn centre(&self) -> Point {
        [self.left + 0.5 * self.width, self.top + 0.5 * self.height]
    }

    /// Returns the frame reduced by margins left, above, right and below.
    pub const fn inside(&self, [left, above, right, below]: [f64; 4]) -> Self {
        let (width, height) = (self.width - left - right, self.height - above - below);
        Self::new(self.left + left, self.top + above, width.max(1.0), height.max(1.0))
    }

    /// Splits the frame into a left part of a share of its width and a right one.
    pub const fn split(&self, share: f64) -> [Self; 2] {
        let width = self.width * share;
        let right = Self::new(self.left + width, self.top, self.width - width, self.height);
        [Self::new(self.left, self.top, width, self.height), right]
    }

    /// Splits the frame into the part above and a strip of `height` at the bottom.
    pub const fn cut_bottom(&self, height: f64) -> [Self; 2] {
        let above = Self::new(self.left, self.top, self.width, self.height - height);
        [above, Self::new(self.left, self.top + self.height - height, self.width, height)]
    }

    /// Returns the corners in order around the frame.
    pub const fn corners(&self) -> [Point; 4] {
        let (right, bottom) = (self.right(), self.bottom());
        [[self.left, self.top], [right, self.top], [right, bottom], [self.left, bottom]]
    }

    /// Returns the corners as a closed line.
    pub fn outline(&self) -> Vec<Point> {
        let [a, b, c, d] = self.corners();
        vec![a, b, c, d, a]
    }

    /// Whether any part of another frame lies in this one.
    pub fn meets(&self, other: &Self) -> bool {
        self.left < other.right() && other.left < self.right() && self.top < other.bottom() && other.top < self.bottom()
    }

    /// Whether all of another frame lies in this one.
    pub fn holds(&self, other: &Self) -> bool {
        other.left >= self.left
            && other.right() <= self.right()
            && other.top >= self.top
            && other.bottom() <= self.bottom()
    }
}

/// Returns a shape enlarged about the origin, then moved.
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
