//! Description of perforated sheets, and the exact share of light of one direction that passes undeviated: the overlap
//! of the two ends of a hole as seen along the light, in closed form.

use crate::compute::direction::{Dir, Facade};

/// Shape and size of the holes of a perforated sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hole {
    /// Round hole, given by its diameter. \[m\]
    Round {
        /// Diameter of the hole. \[m\]
        diameter: f64,
    },
    /// Rectangular hole, given by width and height. \[m\]
    Rectangle {
        /// Width of the hole along x (horizontal). \[m\]
        width: f64,
        /// Height of the hole along y (vertical). \[m\]
        height: f64,
    },
    /// Rhombic hole with horizontal and vertical diagonals, as in expanded metal. \[m\]
    Rhombus {
        /// Horizontal diagonal of the hole. \[m\]
        width: f64,
        /// Vertical diagonal of the hole. \[m\]
        height: f64,
    },
}

/// Perforated sheet: opaque Lambertian sheet with equal holes, whose walls may rise obliquely towards the room.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Perforated {
    /// Shape and size of the holes.
    pub hole: Hole,
    /// Area of the sheet per hole. \[m²\]
    pub area: f64,
    /// Thickness of the sheet. \[m\]
    pub thickness: f64,
    /// Height by which the room-side end of a hole lies above its outer end, > 0 for walls that rise inwards (strands
    /// of expanded metal). \[m\]
    pub rise: f64,
    /// Diffuse reflectances of the outer face, the inner face and the walls of the holes, in this order.
    pub reflectance: [f64; 3],
}

impl Hole {
    /// Returns the area of the hole. \[m²\]
    pub fn area(&self) -> f64 {
        self.overlap([0.0, 0.0])
    }

    /// Returns the area that the hole has in common with its copy displaced by (`x`, `y`) \[m\]. \[m²\]
    pub fn overlap(&self, [x, y]: [f64; 2]) -> f64 {
        match *self {
            Self::Round { diameter } => {
                // Two segments of the circle, on both sides of the common chord.
                let part = x.hypot(y) / diameter;
                if part >= 1.0 {
                    0.0
                } else {
                    0.5 * diameter * diameter * (part.acos() - part * (1.0 - part * part).sqrt())
                }
            }
            Self::Rectangle { width, height } => (width - x.abs()).max(0.0) * (height - y.abs()).max(0.0),
            Self::Rhombus { width, height } => {
                // In halves of its diagonals a square on its corner; along its sides a product.
                let (u, v) = (2.0 * x / width, 2.0 * y / height);
                let side = |moved: f64| (2.0 - moved.abs()).max(0.0);
                0.125 * width * height * side(u + v) * side(u - v)
            }
        }
    }
}

impl Perforated {
    /// Returns the height of a hole and the vertical distance from one hole to the next. \[m\] The description gives
    /// only the area per hole: a square of it is assumed, or more where the holes would touch.
    pub(super) fn pattern(&self) -> [f64; 2] {
        let height = match self.hole {
            Hole::Round { diameter } => diameter,
            Hole::Rectangle { height, .. } | Hole::Rhombus { height, .. } => height,
        };
        [height, self.area.sqrt().max(1.1 * height)]
    }

    /// Returns the open share of the sheet's area, 0 … 1.
    pub fn open(&self) -> f64 {
        self.hole.area() / self.area
    }

    /// Returns the share of light with the direction of undeviated light `direction` that passes undeviated, 0 … 1; the
    /// same from both sides.
    pub fn straight(&self, direction: Dir<Facade>) -> f64 {
        let v = direction.vector();
        if v.z <= 0.0 {
            return 0.0;
        }
        let depth = self.thickness / v.z;
        self.hole.overlap([depth * v.x, depth * v.y + self.rise]) / self.area
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::polygon::{area, cut_by_all};
    use glam::DVec2;
    use std::f64::consts::PI;

    /// The overlap of polygons by cutting one at the other's edges.
    fn cut(corners: &[DVec2], by: DVec2) -> f64 {
        let mut moved: Vec<DVec2> = corners.iter().map(|&p| p + by).collect();
        let edges = corners.iter().zip(corners.iter().cycle().skip(1));
        cut_by_all(&mut moved, edges.map(|(&a, &b)| move |p: DVec2| (b - a).perp_dot(p - a)), &mut vec![]);
        area(&moved)
    }

    #[test]
    fn closed_forms_are_the_areas_of_polygons() {
        let (w, h) = (0.05, 0.018);
        let n = 4000;
        let circle: Vec<DVec2> =
            (0..n).map(|k| 0.5 * w * DVec2::from_angle(2.0 * PI * f64::from(k) / f64::from(n))).collect();
        let (x, y) = (0.5 * w, 0.5 * h);
        let rectangle = [(x, -y), (x, y), (-x, y), (-x, -y)].map(|(x, y)| DVec2::new(x, y));
        let rhombus = [(x, 0.0), (0.0, y), (-x, 0.0), (0.0, -y)].map(|(x, y)| DVec2::new(x, y));
        for (hole, corners) in [
            (Hole::Round { diameter: w }, circle.as_slice()),
            (Hole::Rectangle { width: w, height: h }, &rectangle),
            (Hole::Rhombus { width: w, height: h }, &rhombus),
        ] {
            for (dx, dy) in [(0.0, 0.0), (0.01, 0.0), (0.0, -0.008), (-0.013, 0.004), (0.03, 0.01), (0.049, 0.001)] {
                let (found, exact) = (hole.overlap([dx, dy]), cut(corners, DVec2::new(dx, dy)));
                assert!((found - exact).abs() < 2e-6 * w * w, "{hole:?} {dx} {dy}: {found} {exact}");
            }
        }
        assert!((Hole::Round { diameter: 2.0 }.area() - PI).abs() < 1e-15);
    }

    #[test]
    fn a_rising_hole_is_widest_for_light_that_rises_with_it() {
        let hole = Hole::Rhombus { width: 0.052, height: 0.018 };
        let sheet = Perforated { hole, area: 0.0008, thickness: 0.008, rise: 0.006, reflectance: [0.0; 3] };
        // Light from below along the walls passes whole.
        let along = Dir::from_theta_phi((0.006_f64 / 0.008).atan(), -0.5 * PI);
        assert!((sheet.straight(along) - sheet.open()).abs() < 1e-15);
        assert!(
            sheet.straight(Dir::from_theta_phi(0.3, 0.5 * PI)) < sheet.straight(Dir::from_theta_phi(0.3, -0.5 * PI))
        );
    }
}
