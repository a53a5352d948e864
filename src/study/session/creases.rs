//! Creases of the light on an aperture: lines at which the illuminance from outside has a kink or a step, where the
//! plane of a nearby box's face meets the aperture.
//!
//! On one side of a crease the face of the box is visible from the aperture, on the other it is not; a box that touches
//! the glass ends there. Points beside a crease do not reveal it, so an aperture is cut along its creases before light
//! is computed at points of its parts.

use super::part::{Part, WHOLE, halves};
use crate::compute::room::aperture::Aperture;
use crate::compute::surroundings::solid::{Face, Solid};
use std::f64::consts::PI;

/// Relative change of slope above which a part is cut along a crease: the jump of the slope times the length of the
/// part. A parabola over the part then has a mean error of 0.02 of that.
const BENDS: f64 = 0.05;
/// Minimum distance of a face from the glass that is assumed in this estimate, relative to the length of the part; the
/// jump would be infinite at 0.
const NEAREST: f64 = 0.02;
/// Distance from the border of an aperture up to which a crease counts as lying on it, relative to the side of the
/// aperture.
const ON_BORDER: f64 = 1e-4;

/// Crease of the light on an aperture: line at which the illuminance from outside has a kink or a step.
pub(super) struct Crease {
    /// Index of the side of the aperture that the line cuts, and its position along that side as a share.
    axis: usize,
    at: f64,
    /// Extent of the box's face along the line, and below its range of distances from the plane of the aperture. \[m\]
    along: [f64; 2],
    away: [f64; 2],
    /// Size of the aperture. \[m\]
    size: [f64; 2],
}

impl Crease {
    /// Creates the crease where the plane of a box's face meets an aperture; `None` where it does not. `own`: the
    /// aperture as a face. Lines that run obliquely over a roof are not found.
    fn of(face: &Face, own: &Face, aperture: &Aperture) -> Option<Self> {
        let slopes = [own.u, own.v].map(|axis| face.normal.dot(axis));
        let axis = match slopes.map(|slope| slope.abs() > 1e-9) {
            [true, false] => 0,
            [false, true] => 1,
            _ => return None,
        };
        let at = face.normal.dot(face.origin - own.origin) / slopes[axis] / aperture.size[axis];
        let corners = face.corners().map(|corner| {
            let place = own.coordinates(corner);
            (place[1 - axis], own.normal.dot(corner - own.origin))
        });
        let range = |of: &dyn Fn(&(f64, f64)) -> f64| {
            let values = corners.iter().map(of);
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
        };
        let [near, far] = range(&|corner| corner.1);
        let inside = at > ON_BORDER && at < 1.0 - ON_BORDER;
        (inside && far > 1e-9).then(|| Self {
            axis,
            at,
            along: range(&|corner| corner.0),
            away: [near.max(0.0), far],
            size: aperture.size,
        })
    }

    /// Returns the maximum relative change of slope across the line over a part: the jump of the slope of the
    /// illuminance when the face becomes visible in front of a uniform outside, ∫ y/(π r⁴) dA, times the length of the
    /// part.
    fn bends(&self, part: Part) -> f64 {
        let [low, high] = part[self.axis];
        if self.at <= low + ON_BORDER || self.at >= high - ON_BORDER {
            return 0.0;
        }
        let length = (high - low) * self.size[self.axis];
        let across = part[1 - self.axis].map(|share| share * self.size[1 - self.axis]);
        let place = (0.5 * (self.along[0] + self.along[1])).clamp(across[0], across[1]);
        let seen = |away: f64| {
            let away = away.hypot(NEAREST * length);
            let [from, to] = self.along.map(|end| ((end - place) / away).atan());
            (to - from) / away
        };
        (seen(self.away[0]) - seen(self.away[1])) / (2.0 * PI) * length
    }
}

/// Returns the creases that the faces of all boxes cause on an aperture. `own`: the aperture as a face.
pub(super) fn creases(aperture: &Aperture, own: &Face, solids: &[Solid]) -> Vec<Crease> {
    let faces = solids.iter().flat_map(|solid| (0..6).map(|number| solid.face(number)));
    faces.filter_map(|face| Crease::of(&face, own, aperture)).collect()
}

/// Cuts the aperture along its creases, that with the largest change of slope first, into at most `most` parts.
pub(super) fn cut_along(creases: &[Crease], most: usize) -> Vec<Part> {
    let deepest = |part: Part| {
        let bends = creases.iter().map(|crease| (crease.bends(part), crease));
        bends.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(bends, _)| *bends > BENDS)
    };
    let mut parts = vec![(WHOLE, deepest(WHOLE))];
    while parts.len() < most {
        let depth = |k: usize| parts[k].1.map_or(0.0, |(bends, _)| bends);
        let next = (0..parts.len()).max_by(|a, b| depth(*a).total_cmp(&depth(*b)));
        let Some((next, (_, crease))) = next.and_then(|k| Some((k, parts[k].1?))) else { break };
        let (part, _) = parts.swap_remove(next);
        parts.extend(halves(part, crease.axis, crease.at).map(|half| (half, deepest(half))));
    }
    parts.into_iter().map(|(part, _)| part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Surface;
    use glam::DVec3;

    fn window() -> (Aperture, Face) {
        let aperture = Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 0.9), size: [3.0, 1.8] };
        let own = Face {
            origin: aperture.corner,
            normal: DVec3::NEG_Y,
            u: DVec3::X,
            v: DVec3::Z,
            limits: [[0.0, 3.0], [0.0, 1.8]],
        };
        (aperture, own)
    }

    fn parts(solids: &[Solid], most: usize) -> Vec<Part> {
        let (aperture, own) = window();
        let mut parts = cut_along(&creases(&aperture, &own, solids), most);
        parts.sort_by(|a, b| a[0][0].total_cmp(&b[0][0]).then(a[1][0].total_cmp(&b[1][0])));
        parts
    }

    #[test]
    fn a_window_is_cut_where_planes_of_near_faces_meet_it() {
        let solid = |from: [f64; 3], to: [f64; 3]| Solid::new(DVec3::from_array(from), DVec3::from_array(to), 0.0);
        // A fin from floor to ceiling on the glass.
        let fin = solid([1.4, -0.3, 0.0], [1.55, 0.0, 3.0]);
        let cut = parts(&[fin], 50);
        assert_eq!(cut.len(), 3);
        for (part, [from, to]) in cut.iter().zip([[0.0, 0.3], [0.3, 0.35], [0.35, 1.0]]) {
            assert!((part[0][0] - from).abs() < 1e-12 && (part[0][1] - to).abs() < 1e-12, "{part:?}");
            assert_eq!(part[1], [0.0, 1.0]);
        }
        assert_eq!(parts(&[fin], 2).len(), 2);
        // A balcony below its top's height: one line along the other side.
        let balcony = parts(&[solid([0.0, -2.0, 0.0], [4.0, -1.0, 1.35])], 50);
        assert_eq!(balcony.len(), 2);
        assert!((balcony[0][1][1] - 0.25).abs() < 1e-12);
        // An overhang above, the same fin far away, and what stands behind the façade cut nothing.
        let overhang = solid([0.0, -1.2, 2.75], [4.0, 0.0, 2.9]);
        let far = solid([1.4, -300.3, 0.0], [1.55, -300.0, 3.0]);
        let behind = solid([1.4, 7.0, 0.0], [1.55, 9.0, 3.0]);
        assert_eq!(parts(&[overhang, far, behind], 50), [WHOLE]);
    }

    #[test]
    fn light_bends_as_seen_between_both_sides_of_a_line() {
        // A black face from 0.5 to 2 m in front of the glass, 0 to 3 m high, at x = 2: what it blocks of uniform light
        // on a point `aside` of its plane, by a sum over its points.
        let (aperture, own) = window();
        let face = Face {
            origin: DVec3::new(2.0, 0.0, 0.0),
            normal: DVec3::X,
            u: DVec3::NEG_Y,
            v: DVec3::Z,
            limits: [[0.5, 2.0], [0.0, 3.0]],
        };
        let crease = Crease::of(&face, &own, &aperture).unwrap();
        assert!((crease.at - 0.5).abs() < 1e-12);
        let aside = 1e-3;
        let n = 600;
        let takes: f64 = (0..n * n)
            .map(|k| {
                let (s, t) = ((f64::from(k % n) + 0.5) / f64::from(n), (f64::from(k / n) + 0.5) / f64::from(n));
                let (y, z) = (0.5 + 1.5 * s, 3.0 * t - 1.5);
                let square = aside * aside + y * y + z * z;
                aside * y / (PI * square * square)
            })
            .sum::<f64>()
            * (1.5 * 3.0)
            / f64::from(n * n);
        // Over a short part, to which the face does not begin nearer than it does.
        let part = [[0.49, 0.51], [0.0, 1.0]];
        let bends = crease.bends(part);
        assert!((bends / (takes / aside * 0.02 * 3.0) - 1.0).abs() < 0.01, "{bends} {takes}");
    }
}
