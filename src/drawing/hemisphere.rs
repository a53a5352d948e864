//! A hemisphere of directions as a disk, seen from inside the room: up in the picture is up in the room, right is the
//! viewer's right.
//!
//! The façade frame counts x to the right seen from **outside**; a viewer inside has −x on the right. Both disks use
//! the same axes: an incident direction is drawn where its source is seen, an emergent one where its light **arrives**,
//! so light that leaves upwards is drawn up, and a clear pane sends a sun from the top to the bottom.
//! Disk coordinates: (right, up), the rim at radius 1.

use super::colours::Inks;
use super::font::width;
use super::{Align, Frame, Point, Rgb, Shape, TEXT};
use crate::compute::basis::{Cell, RingBasis};
use crate::compute::btdf::{Btdf, Indicatrices, Scattered};
use crate::compute::direction::{Dir, Emergent, Facade, Incident};
use crate::texts::tiles as say;
use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};

/// Projection of a hemisphere of directions to a disk: the polar angle θ from the element's normal becomes a radius.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Projection {
    /// r = sin θ: equal areas are equal **projected** solid angles, so area × value is flux.
    #[default]
    ProjectedSolidAngle,
    /// r = √2 sin(θ/2) (Lambert): equal areas are equal solid angles.
    SolidAngle,
}

impl Projection {
    /// Returns the radius at which directions of polar angle `theta` \[rad\] from the normal are drawn, as a fraction
    /// of the disk's radius.
    pub fn radius(self, theta: f64) -> f64 {
        match self {
            Self::ProjectedSolidAngle => theta.sin(),
            Self::SolidAngle => SQRT_2 * (0.5 * theta).sin(),
        }
    }

    /// Returns the polar angle from the normal \[rad\] of the directions that are drawn at `radius`, a fraction 0 … 1
    /// of the disk's radius.
    pub fn theta(self, radius: f64) -> f64 {
        match self {
            Self::ProjectedSolidAngle => radius.clamp(0.0, 1.0).asin(),
            Self::SolidAngle => 2.0 * (radius / SQRT_2).clamp(0.0, 1.0).asin().min(0.25 * PI),
        }
    }
}

/// Hemisphere that a disk shows, which determines how azimuths of the façade frame are drawn. Emergent directions are
/// given by the incident direction whose undeviated light leaves in them (ω′ = −ω, the *through direction*), because
/// transmitted data are stored by it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Hemisphere of the incident directions, each drawn where its source is seen.
    Incident,
    /// Hemisphere of the emergent directions, each drawn where its light arrives.
    Emergent,
}

impl Side {
    /// Returns the disk point (right, up; rim at radius 1) of a direction: for [`Side::Incident`] of the incident
    /// direction `through`, for [`Side::Emergent`] of the emergent direction in which light from `through` leaves
    /// undeviated.
    pub fn disk(self, projection: Projection, through: Dir<Facade>) -> [f64; 2] {
        self.polar(projection.radius(through.theta().min(FRAC_PI_2)), through.phi())
    }

    /// Returns the disk point (right, up; rim at radius 1) at a radius and an azimuth. `phi`: azimuth of the façade
    /// frame \[rad\] of the incident direction itself, or of the one whose undeviated light leaves in the emergent
    /// direction.
    pub fn polar(self, radius: f64, phi: f64) -> [f64; 2] {
        let (sin, cos) = phi.sin_cos();
        match self {
            Self::Incident => [-radius * cos, radius * sin],
            Self::Emergent => [radius * cos, -radius * sin],
        }
    }

    /// Returns the direction that is drawn at a disk point (right, up; rim at radius 1), `None` outside the rim: for
    /// [`Side::Incident`] the incident direction itself, for [`Side::Emergent`] the incident direction whose undeviated
    /// light leaves in the emergent direction of that point.
    pub fn direction_at(self, projection: Projection, [right, up]: [f64; 2]) -> Option<Dir<Facade>> {
        let radius = right.hypot(up);
        if radius > 1.0 {
            return None;
        }
        let phi = match self {
            Self::Incident => up.atan2(-right),
            Self::Emergent => (-up).atan2(right),
        };
        Some(Dir::from_theta_phi(projection.theta(radius), phi))
    }
}

/// Returns the disk point (right, up; rim at radius 1) of an incident direction: where its source is seen from inside
/// the room.
pub fn incident_disk(projection: Projection, incident: Incident) -> [f64; 2] {
    Side::Incident.disk(projection, incident.0)
}

/// Returns the disk point (right, up; rim at radius 1) of an emergent direction: where its light arrives, seen from
/// inside the room.
pub fn emergent_disk(projection: Projection, emergent: Emergent) -> [f64; 2] {
    Side::Emergent.disk(projection, emergent.undeviated_incident())
}

/// Returns the number of straight pieces by which each arc of a cell of a basis is drawn; each spans 3° of azimuth or
/// less.
pub fn arc_steps(cell: &Cell) -> usize {
    ((cell.width / 3_f64.to_radians()).ceil() as usize).max(1)
}

/// Returns the outline of a cell of a basis as a closed polygon in disk coordinates (right, up; rim at radius 1).
pub fn cell_outline(projection: Projection, side: Side, cell: &Cell) -> Vec<[f64; 2]> {
    let n = arc_steps(cell);
    let (inner, outer) = (projection.radius(cell.theta_min), projection.radius(cell.theta_max));
    let phi = |k: usize| cell.phi - 0.5 * cell.width + cell.width * k as f64 / n as f64;
    let whole = cell.width > 1.99 * PI;
    let mut points: Vec<[f64; 2]> = (0..=n).map(|k| side.polar(outer, phi(k))).collect();
    if whole && inner == 0.0 {
        points.pop();
    } else if inner == 0.0 {
        points.push([0.0, 0.0]);
    } else {
        points.extend((0..=n).rev().map(|k| side.polar(inner, phi(k))));
    }
    points
}

/// Returns the scattering data of a system if they consist of single incident directions that do not form a lattice;
/// these have no cells of a basis by which they could be drawn. `None` for all other data.
pub fn listed(btdf: &Btdf) -> Option<&Indicatrices> {
    match &btdf.scattered {
        Some(Scattered::Directions(data)) if data.lattice().is_none() => Some(data),
        _ => None,
    }
}

/// Returns the cells in which quantities are drawn on the disk of incident directions: those of the data, or fine ones
/// for data at single directions, where each cell shows the direction nearest to it.
pub fn incident_cells(btdf: &Btdf) -> RingBasis {
    if listed(btdf).is_some() { RingBasis::equal_area(20) } else { btdf.incident_basis() }
}

/// Returns the disk point (right, up; rim at radius 1) of a position in the sky, as seen when lying on one's back:
/// north is up, so east is left; the zenith is in the middle, and the radius falls linearly with altitude. `altitude`,
/// `bearing` (clockwise from north): \[rad\].
pub fn dome_point(altitude: f64, bearing: f64) -> [f64; 2] {
    let r = 1.0 - altitude / FRAC_PI_2;
    [-r * bearing.sin(), r * bearing.cos()]
}

/// Returns the side of the disk of the sky, 1 for the right one and −1 for the left one, on which the sun covers no
/// label. `sun`: altitude and bearing. \[rad\]
pub fn side_without(sun: Option<(f64, f64)>) -> f64 {
    let is_right = sun.is_some_and(|(altitude, bearing)| altitude >= 0.0 && dome_point(altitude, bearing)[0] > 0.0);
    if is_right { -1.0 } else { 1.0 }
}

/// Disk of a hemisphere on paper: position and size of its rim.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Round {
    /// Centre of the disk. \[drawing units from the upper left corner of the paper\]
    pub centre: Point,
    /// Radius of the rim. \[drawing units\]
    pub radius: f64,
}

impl Round {
    /// Creates the largest disk that fits into a frame and leaves a margin to the frame's edges. \[drawing units\]
    pub fn within(frame: Frame, margin: f64) -> Self {
        Self { centre: frame.centre(), radius: (0.5 * frame.width.min(frame.height) - margin).max(8.0) }
    }

    /// Returns the position on paper \[drawing units\] of a disk point (right, up; rim at radius 1).
    pub fn place(&self, [right, up]: [f64; 2]) -> Point {
        [self.centre[0] + right * self.radius, self.centre[1] - up * self.radius]
    }

    /// Returns the shapes of all cells of a basis, each in the one colour that `colour` gives for its index.
    pub fn cells(
        &self,
        (projection, side): (Projection, Side),
        basis: &RingBasis,
        colour: impl Fn(usize) -> Rgb,
    ) -> Vec<Shape> {
        let cell = |(index, cell): (usize, Cell)| {
            let outline = cell_outline(projection, side, &cell);
            Shape::cell(outline.into_iter().map(|point| self.place(point)).collect::<Vec<_>>(), colour(index))
        };
        basis.cells().enumerate().map(cell).collect()
    }

    /// Returns the shapes of a continuous quantity over the disk, as small cells of one colour each. `colour`: colour
    /// at a disk point (right, up; rim at radius 1).
    pub fn field(&self, colour: impl Fn([f64; 2]) -> Rgb) -> Vec<Shape> {
        const RINGS: usize = 30;
        const SECTORS: usize = 72;
        let at = |ring: f64, sector: f64| {
            let (sin, cos) = (sector / SECTORS as f64 * 2.0 * PI).sin_cos();
            let radius = ring / RINGS as f64;
            [radius * cos, radius * sin]
        };
        let mut shapes = Vec::with_capacity(RINGS * SECTORS);
        for ring in 0..RINGS {
            for sector in 0..SECTORS {
                let (r, s) = (ring as f64, sector as f64);
                let corners = [at(r, s), at(r + 1.0, s), at(r + 1.0, s + 1.0), at(r, s + 1.0)];
                shapes.push(Shape::cell(corners.map(|point| self.place(point)), colour(at(r + 0.5, s + 0.5))));
            }
        }
        shapes
    }

    /// Returns the shapes of the disk's frame: labelled rings at 30° and 60° from the normal, the rim, and the words
    /// for up, left and right around it.
    pub fn rim(&self, projection: Projection, inks: &Inks) -> Vec<Shape> {
        let mut shapes = Vec::new();
        for degrees in [30.0_f64, 60.0] {
            let radius = projection.radius(degrees.to_radians()) * self.radius;
            shapes.push(Shape::ring(self.centre, radius, inks.outline, 0.6));
            let aside = radius * std::f64::consts::FRAC_1_SQRT_2;
            let at = [self.centre[0] + aside, self.centre[1] + aside];
            shapes.extend(on_halo(at, &format!("{degrees:.0}°"), inks));
        }
        shapes.push(Shape::ring(self.centre, self.radius, inks.outline, 1.5));
        let [x, y] = self.centre;
        shapes.push(Shape::text([x, y - self.radius - 9.0], say::UP, inks.weak));
        for (word, side, turn) in [(say::LEFT, -1.0, -90.0), (say::RIGHT, 1.0, 90.0)] {
            shapes.push(Shape::Text {
                at: [x + side * (self.radius + 10.0), y],
                text: word.into(),
                colour: inks.weak,
                size: TEXT,
                align: Align::Middle,
                turn,
            });
        }
        shapes
    }
}

/// Returns a text centred at a position on paper, with a translucent white background that makes it legible on every
/// colour of data.
pub fn on_halo(at: Point, text: &str, inks: &Inks) -> [Shape; 2] {
    let half = 0.5 * width(text, TEXT) + 2.0;
    let ground = Frame::new(at[0] - half, at[1] - 7.5, 2.0 * half, 15.0).corners().to_vec();
    let ground = Shape::Area { points: ground, colour: [255; 3], opacity: 0.75, edge: 0.0 };
    [ground, Shape::text(at, text, inks.ink)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::AzimuthMap;
    use proptest::prelude::*;

    #[test]
    fn labels_stand_opposite_the_sun() {
        let at = |altitude: f64, bearing: f64| Some((altitude.to_radians(), bearing.to_radians()));
        let sides = [None, at(40.0, 135.0), at(40.0, 225.0), at(-5.0, 225.0)].map(side_without);
        // West is right; below the horizon no sun is drawn.
        assert_eq!(sides, [1.0, 1.0, -1.0, 1.0]);
    }

    fn area(points: &[[f64; 2]]) -> f64 {
        let n = points.len();
        0.5 * (0..n)
            .map(|i| points[i][0] * points[(i + 1) % n][1] - points[(i + 1) % n][0] * points[i][1])
            .sum::<f64>()
            .abs()
    }

    #[test]
    fn up_is_up_and_sides_are_seen_from_inside() {
        let p = Projection::default();
        // Façade x is right seen from outside: left for us.
        let sun = Incident(Dir::from_theta_phi(0.8, 0.0));
        assert!(incident_disk(p, sun)[0] < -0.7);
        let high = Incident(Dir::from_theta_phi(0.8, FRAC_PI_2));
        assert!(incident_disk(p, high)[1] > 0.7);
        // Through a clear pane it leaves downwards.
        assert!(emergent_disk(p, Emergent::from_undeviated(high.0))[1] < -0.7);
        // Light that goes up and to façade −x (our right).
        let up_right = Emergent(Dir::new(glam::DVec3::new(-0.4, 0.5, -0.6)).unwrap());
        let [right, up] = emergent_disk(p, up_right);
        assert!(right > 0.1 && up > 0.1);
    }

    #[test]
    fn areas_of_cells_are_their_projected_solid_angles() {
        for side in [Side::Incident, Side::Emergent] {
            for basis in [RingBasis::klems_full(AzimuthMap::KLEMS_FRONT), RingBasis::tregenza()] {
                for cell in basis.cells() {
                    // r = sin θ: the disk's area is the projected solid angle itself; chords of 3° lose 5e-4.
                    let a = area(&cell_outline(Projection::ProjectedSolidAngle, side, &cell));
                    assert!((a / cell.projected_solid_angle() - 1.0).abs() < 2e-2, "{cell:?}");
                    let b = area(&cell_outline(Projection::SolidAngle, side, &cell));
                    assert!((2.0 * b / cell.solid_angle() - 1.0).abs() < 2e-2, "{cell:?}");
                }
            }
        }
    }

    #[test]
    fn flat_cells_cover_the_disk() {
        let round = Round { centre: [60.0, 60.0], radius: 50.0 };
        let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let sets = [round.cells((Projection::SolidAngle, Side::Emergent), &basis, |_| [0; 3]), round.field(|_| [0; 3])];
        for shapes in sets {
            let (width, _, pixels) = super::super::Drawing { width: 120.0, height: 120.0, shapes }.to_pixels(1.0);
            for (k, pixel) in pixels.chunks(3).enumerate() {
                let r = ((k % width) as f64 + 0.5 - 60.0).hypot((k / width) as f64 + 0.5 - 60.0);
                assert!(r > 49.0 && (r < 52.5 || pixel[0] == 255) || pixel[0] < 40, "{r} {pixel:?}");
            }
        }
    }

    proptest! {
        #[test]
        fn disk_and_direction_are_inverse(theta in 0.01..1.55_f64, phi in 0.0..6.2_f64) {
            for projection in [Projection::ProjectedSolidAngle, Projection::SolidAngle] {
                for side in [Side::Incident, Side::Emergent] {
                    let d = Dir::from_theta_phi(theta, phi);
                    let back = side.direction_at(projection, side.disk(projection, d)).unwrap();
                    prop_assert!((back.vector() - d.vector()).length() < 1e-6);
                }
            }
        }
    }
}
