//! Rectangle of an aperture in its room, and the intensities that, sent from its centre, light the room's surfaces in
//! the same way.

use crate::compute::direction::{Dir, Emergent, Facade, Surface};
use crate::compute::lid::tiling::{landing, parts};
use crate::compute::lid::{Lid, SunBeam};
use glam::DVec3;

/// Angular diameter of the sun's disc: minimum angular width of the area that a beam lights. \[rad\] Twice the mean
/// radius of 0.2665°, `SUN_HALF_ANGLE`.
const DISC: f64 = 9.3e-3;

/// Distance over which a beam fades on both sides of an edge where another tile or part continues, as a share of the
/// side's length. Readers interpolate between nodes and cannot follow a sharp edge: two of them side by side leave gaps
/// and ridges that a host program's grid of points may meet again and again; two slopes that add up to one leave none.
/// Slopes of this length meet three nodes or more. Held by the test
/// `beams_of_tiles_side_by_side_leave_no_ridge_between_them`.
const FADE: f64 = 1.0 / 6.0;

/// Rectangle of an aperture (the whole, a tile or a part of it) with the room that it lights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Panel {
    /// Centre of the rectangle in the room's frame. \[m\]
    pub centre: DVec3,
    /// Size of the rectangle along x_F and y_F of the façade frame. \[m\]
    pub size: [f64; 2],
    /// Surface that the rectangle lies in.
    pub surface: Surface,
    /// Width, depth and height of the room. \[m\]
    pub room: DVec3,
    /// Whether the aperture ends at each side of the rectangle: `[[left, right], [lower, upper]]`, that is at the
    /// smaller and larger x_F, at the smaller and larger y_F.
    pub rim: [[bool; 2]; 2],
}

impl Panel {
    /// Returns the distance \[m\] from the centre to the room surface that light meets in a direction of the façade
    /// frame, and the index of the room axis perpendicular to that surface.
    pub(super) fn reach(&self, direction: DVec3) -> (f64, usize) {
        landing(self.room, self.centre, self.surface.room_from_facade(direction))
    }

    /// Returns the distance from the centre to the room surface that a beam lights. \[m\]
    pub(super) fn distance(&self, beam: &SunBeam) -> f64 {
        self.reach(beam.direction.0.vector()).0
    }

    /// Returns one of the parts into which a host program divides the rectangle for points at `distance` \[m\], moved
    /// to the rectangle's centre.
    pub(super) fn part(&self, distance: f64) -> Self {
        let count = parts(self.size, distance);
        // All parts share one intensity distribution, so that no side counts as a border of the aperture.
        let rim = if count > 1 { [[false; 2]; 2] } else { self.rim };
        Self { size: self.size.map(|side| side / count as f64), rim, ..*self }
    }

    /// Returns the distance by which beams fade beyond each side of the rectangle; 0 where the aperture ends. \[m\]
    pub(super) fn beyond(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|axis| self.rim[axis].map(|ends| if ends { 0.0 } else { FADE * self.size[axis] }))
    }

    /// Returns the rectangle with its sides enlarged, if they are shorter, to the size of the spot that a beam through
    /// one point lights because of the sun's diameter.
    pub(super) fn under(&self, beam: &SunBeam) -> Self {
        let (way, distance) = (beam.direction.0.vector(), self.distance(beam));
        let across = |along: f64| (1.0 - along * along).max(1e-6).sqrt();
        let side = |k: usize, along: f64| self.size[k].max(DISC * distance / across(along));
        Self { size: [side(0, way.x), side(1, way.y)], ..*self }
    }

    /// Returns the luminous intensity that, sent from the centre, lights the room's surfaces like a beam through the
    /// rectangle: constant illuminance within its outline, fading across sides beyond which the aperture continues, so
    /// that the illuminances by neighbouring tiles add up to a constant. \[cd\] `direction`: of propagation, façade
    /// frame.
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

    /// Returns the luminous intensity that, sent from the centre, causes the illuminance of the room's surfaces by
    /// scattered light of the whole rectangle sent from the point (`x`, `y`) \[m\] beside the centre. \[cd\]
    /// `direction`: of propagation, façade frame.
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

    /// Returns the direction from the centre to the point of the room's surfaces that a beam through the point (`x`,
    /// `y`) \[m\] beside the centre lights.
    pub(super) fn landing_of(&self, beam: &SunBeam, [x, y]: [f64; 2]) -> Emergent {
        let way = beam.direction.0.vector();
        let from = self.surface.room_from_facade(DVec3::new(x, y, 0.0));
        let (away, _) = landing(self.room, self.centre + from, self.surface.room_from_facade(way));
        Dir::<Facade>::new(DVec3::new(x, y, 0.0) + away * way).map_or(beam.direction, Emergent)
    }
}
