//! Luminous opening of a luminaire: shape and size, and their notation in EULUMDAT and IES files.

/// Shape of the luminous opening of a luminaire.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Shape {
    /// Rectangle, or box with luminous sides; a point without size.
    #[default]
    Rectangular,
    /// Circle or ellipse seen from below; vertical cylinder with luminous sides.
    Round,
    /// Sphere or ellipsoid.
    Ellipsoid,
    /// Horizontal cylinder whose axis lies in the C0–C180 plane; with length 0 a vertical disc.
    CylinderAlongC0,
    /// Horizontal cylinder whose axis lies in the C90–C270 plane; with length 0 a vertical disc.
    CylinderAlongC90,
}

impl Shape {
    /// Returns the key of the shape in files and JSON.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Rectangular => "rectangular",
            Self::Round => "round",
            Self::Ellipsoid => "ellipsoid",
            Self::CylinderAlongC0 => "cylinder along C0",
            Self::CylinderAlongC90 => "cylinder along C90",
        }
    }
}

/// Size and shape of the luminous opening of a luminaire. Sizes are 0 or more. \[m\]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Opening {
    /// Shape of the opening, bounded by the three sizes.
    pub shape: Shape,
    /// Size along the C0–C180 plane ("length" of LM-63, "width" of EULUMDAT). \[m\]
    pub along_c0: f64,
    /// Size along the C90–C270 plane ("width" of LM-63, "length" of EULUMDAT). \[m\]
    pub along_c90: f64,
    /// Vertical size of the opening. \[m\]
    pub height: f64,
}

impl Opening {
    /// Creates a rectangular opening, or a box, of the given sizes \[m\].
    pub const fn rectangular(along_c0: f64, along_c90: f64, height: f64) -> Self {
        Self { shape: Shape::Rectangular, along_c0, along_c90, height }
    }

    /// Creates the opening from width, length and height of an LM-63 file \[m\], of which negative ones mark round
    /// shapes.
    ///
    /// `states_diameter_once`: whether the file is of an edition up to 1995, where the second diameter of a round shape
    /// is 0 and a horizontal cylinder has one negative size; later editions repeat the diameter, and a horizontal
    /// cylinder has two.
    pub(super) fn from_lm63(sizes: [f64; 3], states_diameter_once: bool) -> Self {
        let [mut width, mut length, mut height] = sizes.map(f64::abs);
        let shape = match (sizes.map(|size| size < 0.0), states_diameter_once) {
            ([false, false, false], _) => Shape::Rectangular,
            ([_, _, false], _) => Shape::Round,
            ([false, false, true], _) if length > width => Shape::CylinderAlongC0,
            ([false, false, true], _) if width > 0.0 => Shape::CylinderAlongC90,
            ([true, false, true], false) => Shape::CylinderAlongC0,
            ([false, true, true], false) => Shape::CylinderAlongC90,
            ([_, _, true], _) => Shape::Ellipsoid,
        };
        let either = |a: f64, b: f64| if a == 0.0 { b } else { a };
        match shape {
            Shape::Rectangular => {}
            Shape::Round => (width, length) = (either(width, length), either(length, width)),
            Shape::Ellipsoid => {
                (width, length) = (either(either(width, length), height), either(either(length, width), height));
            }
            Shape::CylinderAlongC0 => (width, height) = (either(width, height), either(height, width)),
            Shape::CylinderAlongC90 => (length, height) = (either(length, height), either(height, length)),
        }
        Self { shape, along_c0: length, along_c90: width, height }
    }

    /// Returns width, length and height of the opening in the notation of LM-63-2002 and later editions, negative where
    /// they mark round shapes. \[m\]
    pub(super) fn to_lm63(self) -> [f64; 3] {
        let (width, length, height) = (self.along_c90, self.along_c0, self.height);
        match self.shape {
            Shape::Rectangular => [width, length, height],
            Shape::Round => [-width, -length, height],
            Shape::Ellipsoid => [-width, -length, -height],
            Shape::CylinderAlongC0 => [-width, length, -height],
            Shape::CylinderAlongC90 => [width, -length, -height],
        }
    }

    /// Whether the opening is a circle seen from below.
    pub fn is_circle(&self) -> bool {
        self.shape == Shape::Round && self.along_c0 == self.along_c90
    }

    /// Returns the area of the largest face of the box that bounds the opening. \[m²\]
    pub fn largest_face(&self) -> f64 {
        let (a, b, c) = (self.along_c0, self.along_c90, self.height);
        (a * b).max(a * c).max(b * c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_of_both_generations_of_editions_are_read() {
        let read = |[width, length, height]: [f64; 3], old: bool| {
            let opening = Opening::from_lm63([width, length, height], old);
            (opening.shape, [opening.along_c90, opening.along_c0, opening.height])
        };
        for (sizes, old, shape, read_as) in [
            ([0.6, 1.2, 0.0], true, Shape::Rectangular, [0.6, 1.2, 0.0]),
            ([-0.5, 0.0, 0.0], true, Shape::Round, [0.5, 0.5, 0.0]),
            ([-0.5, 0.0, 0.0], false, Shape::Round, [0.5, 0.5, 0.0]),
            ([-0.5, -0.5, 0.0], false, Shape::Round, [0.5, 0.5, 0.0]),
            ([-0.5, 0.0, 0.2], true, Shape::Round, [0.5, 0.5, 0.2]),
            ([-0.5, 0.8, 0.0], true, Shape::Round, [0.5, 0.8, 0.0]),
            ([-0.5, 0.0, -0.5], true, Shape::Ellipsoid, [0.5, 0.5, 0.5]),
            ([-0.5, 0.8, -0.4], true, Shape::Ellipsoid, [0.5, 0.8, 0.4]),
            ([0.0, 1.2, -0.1], true, Shape::CylinderAlongC0, [0.1, 1.2, 0.1]),
            ([1.2, 0.0, -0.1], true, Shape::CylinderAlongC90, [1.2, 0.1, 0.1]),
            ([-0.1, 1.2, -0.1], false, Shape::CylinderAlongC0, [0.1, 1.2, 0.1]),
            ([-0.3, 0.0, -0.3], false, Shape::CylinderAlongC0, [0.3, 0.0, 0.3]),
        ] {
            assert_eq!(read(sizes, old), (shape, read_as), "{sizes:?}");
        }
    }

    #[test]
    fn every_shape_is_written_as_it_is_read() {
        use Shape::{CylinderAlongC0, CylinderAlongC90, Ellipsoid, Rectangular, Round};
        for shape in [Rectangular, Round, Ellipsoid, CylinderAlongC0, CylinderAlongC90] {
            let opening = Opening { shape, along_c0: 0.8, along_c90: 0.5, height: 0.3 };
            assert_eq!(Opening::from_lm63(opening.to_lm63(), false), opening);
        }
    }
}
