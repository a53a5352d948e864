//! A rectangle of the aperture in its room: what its light does on the surfaces that it reaches.

use crate::compute::direction::{Dir, Emergent, Facade, Surface};
use crate::compute::lid::tiling::{landing, parts};
use crate::compute::lid::{Lid, SunBeam};
use glam::DVec3;

/// The sun's disc: no beam lights less. \[rad\]
const DISC: f64 = 9.3e-3;

/// A rectangle of the aperture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Panel {
    /// Its middle, room axes. \[m\]
    pub centre: DVec3,
    /// Along x_F and y_F. \[m\]
    pub size: [f64; 2],
    /// The surface that it lies in.
    pub surface: Surface,
    /// Width, depth and height of the room. \[m\]
    pub room: DVec3,
}

impl Panel {
    /// How far light from its middle goes, and across which axis the surface lies. The direction is in façade axes.
    pub(super) fn reach(&self, direction: DVec3) -> (f64, usize) {
        landing(self.room, self.centre, self.surface.room_from_facade(direction))
    }

    /// How far a beam goes. \[m\]
    pub(super) fn distance(&self, beam: &SunBeam) -> f64 {
        self.reach(beam.direction.0.vector()).0
    }

    /// One of the parts, about the same middle, into which a host cuts it from a distance. \[m\]
    pub(super) fn part(&self, distance: f64) -> Self {
        let count = parts(self.size, distance) as f64;
        Self { size: self.size.map(|side| side / count), ..*self }
    }

    /// The same, but with sides no narrower than the sun's disc makes what a beam through it lights.
    pub(super) fn under(&self, beam: &SunBeam) -> Self {
        let (way, distance) = (beam.direction.0.vector(), self.distance(beam));
        let across = |along: f64| (1.0 - along * along).max(1e-6).sqrt();
        let side = |k: usize, along: f64| self.size[k].max(DISC * distance / across(along));
        Self { size: [side(0, way.x), side(1, way.y)], ..*self }
    }

    /// Luminous intensity that, sent from the middle, lights the room's surfaces as a beam through the rectangle does:
    /// evenly inside its outline. \[cd\] The direction is in façade axes.
    pub(super) fn of_beam(&self, beam: &SunBeam, direction: DVec3) -> f64 {
        if direction.z >= 0.0 {
            return 0.0;
        }
        let (away, axis) = self.reach(direction);
        // Back along the beam to the rectangle's plane.
        let way = beam.direction.0.vector();
        let beside = away * direction - (away * direction.z / way.z) * way;
        let [w, h] = self.size;
        if beside.x.abs() > 0.5 * w || beside.y.abs() > 0.5 * h {
            return 0.0;
        }
        // E = Φ |b·n|/(w h |b_z|) there, and I = E r²/|d·n|.
        let across = |direction: DVec3| self.surface.room_from_facade(direction)[axis].abs();
        beam.flux * away * away * across(way) / (w * h * -way.z * across(direction))
    }

    /// The same for scattered light that leaves one point of the rectangle, `x` and `y` beside its middle \[m\], as if all
    /// of the rectangle did as that point does. \[cd\]
    pub(super) fn of_point(&self, lid: &Lid, [x, y]: [f64; 2], direction: DVec3) -> f64 {
        if direction.z >= 0.0 {
            return 0.0;
        }
        let (away, axis) = self.reach(direction);
        let ray = away * direction - DVec3::new(x, y, 0.0);
        let square = ray.length_squared();
        let Some(own) = Dir::<Facade>::new(ray).filter(|_| square > 0.0) else { return 0.0 };
        // dE = L cosθ_Q cosθ_P dA/r_Q², and I = E r²/|d·n|.
        let across = |direction: DVec3| self.surface.room_from_facade(direction)[axis].abs();
        let nearer = away * away / square * across(own.vector()) / across(direction);
        lid.luminance(Emergent(own)) * -own.vector().z * self.size[0] * self.size[1] * nearer
    }

    /// Where a beam through a point of the rectangle lands, seen from the middle.
    pub(super) fn landing_of(&self, beam: &SunBeam, [x, y]: [f64; 2]) -> Emergent {
        let way = beam.direction.0.vector();
        let from = self.surface.room_from_facade(DVec3::new(x, y, 0.0));
        let (away, _) = landing(self.room, self.centre + from, self.surface.room_from_facade(way));
        Dir::<Facade>::new(DVec3::new(x, y, 0.0) + away * way).map_or(beam.direction, Emergent)
    }
}
