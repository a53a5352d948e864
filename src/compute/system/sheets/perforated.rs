//! Perforated and expanded metal, grids of webs, as described.

use crate::compute::system::family::{Family, NoSpecimen, Polygons};
use crate::compute::system::measure::Specimen;

/// Pattern and shape of holes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hole {
    /// Round, given by its diameter. \[m\]
    Round {
        /// Diameter. \[m\]
        diameter: f64,
    },
    /// A rectangle, width and height. \[m\]
    Rectangle {
        /// Width along x. \[m\]
        width: f64,
        /// Height along y. \[m\]
        height: f64,
    },
    /// A rhombus with horizontal and vertical diagonals, as in expanded metal. \[m\]
    Rhombus {
        /// Horizontal diagonal. \[m\]
        width: f64,
        /// Vertical diagonal. \[m\]
        height: f64,
    },
}

/// An opaque Lambertian sheet with equal holes; their walls may run obliquely upwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Perforated {
    /// The hole.
    pub hole: Hole,
    /// Area of the sheet per hole. \[m²\]
    pub area: f64,
    /// Thickness of the sheet. \[m\]
    pub thickness: f64,
    /// How much higher the hole lies on the room side, > 0 = its walls rise inwards (strands of expanded metal). \[m\]
    pub rise: f64,
    /// Diffuse reflectance of the outer face, the inner face and the walls.
    pub reflectance: [f64; 3],
}

impl Perforated {
    /// Height of a hole and the distance from one to the next above it. \[m\] The description knows the area per hole
    /// alone: a square of it, or more where the holes would touch.
    fn pattern(&self) -> [f64; 2] {
        let height = match self.hole {
            Hole::Round { diameter } => diameter,
            Hole::Rectangle { height, .. } | Hole::Rhombus { height, .. } => height,
        };
        [height, self.area.sqrt().max(1.1 * height)]
    }
}

impl Family for Perforated {
    fn word(&self) -> &'static str {
        "perforated"
    }

    fn method(&self) -> &'static str {
        "radiosity in the hole, straight share by clipped polygons"
    }

    fn structure(&self) -> Option<f64> {
        Some(self.area.sqrt())
    }

    /// The sheet between two holes, cut through the middle of both.
    fn drawing(&self, _: &str) -> Polygons {
        let [height, pitch] = self.pattern();
        let (low, high) = (0.5 * height, pitch - 0.5 * height);
        let (inner, rise) = (-self.thickness, self.rise);
        vec![vec![[inner, low + rise], [0.0, low], [0.0, high], [inner, high + rise]]]
    }

    fn drawing_period(&self) -> Option<f64> {
        Some(self.pattern()[1])
    }

    fn is_schematic(&self) -> bool {
        true
    }

    fn specimen(&self, _: &str) -> Result<Box<dyn Specimen>, NoSpecimen> {
        Ok(Box::new(*self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_solid_of_a_sheet_with_holes() {
        let hole = Hole::Rectangle { width: 0.02, height: 0.01 };
        let sheet = Perforated { hole, area: 0.0004, thickness: 0.001, rise: 0.003, reflectance: [0.5; 3] };
        assert!((sheet.drawing_period().unwrap() - 0.02).abs() < 1e-15);
        let web = &sheet.drawing("")[0];
        let next = web.iter().cycle().skip(1);
        let area = 0.5 * web.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>().abs();
        assert!((area - 0.01 * 0.001).abs() < 1e-15);
    }
}
