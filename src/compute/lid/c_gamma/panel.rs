//! A rectangle of the aperture in its room: what its light does on the surfaces that it reaches.

use crate::compute::direction::{Dir, Emergent, Facade, Surface};
use crate::compute::lid::tiling::{landing, parts};
use crate::compute::lid::{Lid, SunBeam};
use glam::DVec3;

/// The sun's disc: no beam lights less. \[rad\]
const DISC: f64 = 9.3e-3;

/// Of a side's length, how far on both sides of it a beam fades where another tile or part goes on. Readers interpolate
/// between nodes and cannot follow a sharp edge: two of them side by side leave gaps and ridges that a host's grid of
/// points may meet again and again; two slopes that add up to one leave none. Slopes so long meet three nodes or more.
const FADE: f64 = 1.0 / 6.0;

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
    /// Its sides, from and to along x_F and y_F: where does the aperture end?
    pub rim: [[bool; 2]; 2],
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
        let count = parts(self.size, distance);
        // All parts share a distribution: none of its sides ends the aperture for all of them.
        let rim = if count > 1 { [[false; 2]; 2] } else { self.rim };
        Self { size: self.size.map(|side| side / count as f64), rim, ..*self }
    }

    /// How far beyond each of its sides its beams reach. \[m\]
    pub(super) fn beyond(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|axis| self.rim[axis].map(|ends| if ends { 0.0 } else { FADE * self.size[axis] }))
    }

    /// The same, but with sides no narrower than the sun's disc makes what a beam through it lights.
    pub(super) fn under(&self, beam: &SunBeam) -> Self {
        let (way, distance) = (beam.direction.0.vector(), self.distance(beam));
        let across = |along: f64| (1.0 - along * along).max(1e-6).sqrt();
        let side = |k: usize, along: f64| self.size[k].max(DISC * distance / across(along));
        Self { size: [side(0, way.x), side(1, way.y)], ..*self }
    }

    /// Luminous intensity that, sent from the middle, lights the room's surfaces as a beam through the rectangle does:
    /// alike all over its outline, and fading across sides beyond which the aperture goes on, so that what neighbours do
    /// there adds up. \[cd\] The direction is in façade axes.
    pub(super) fn of_beam(&self, beam: &SunBeam, direction: DVec3) -> f64 {
        if direction.z >= 0.0 {
            return 0.0;
        }
        let (away, axis) = self.reach(direction);
        // Back along the beam to the rectangle's plane.
        let way = beam.direction.0.vector();
        let beside = away * direction - (away * direction.z / way.z) * way;
        let [w, h] = self.size;
        let beyond = self.beyond();
        let share = |axis: usize| {
            let half = 0.5 * self.size[axis];
            let of = |inside: f64, fade: f64| {
                if fade > 0.0 { (0.5 + 0.5 * inside / fade).clamp(0.0, 1.0) } else { f64::from(inside >= 0.0) }
            };
            of(half + beside[axis], beyond[axis][0]) * of(half - beside[axis], beyond[axis][1])
        };
        let share = share(0) * share(1);
        if share <= 0.0 {
            return 0.0;
        }
        // E = Φ |b·n|/(w h |b_z|) there, and I = E r²/|d·n|.
        let across = |direction: DVec3| self.surface.room_from_facade(direction)[axis].abs();
        share * beam.flux * away * away * across(way) / (w * h * -way.z * across(direction))
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
