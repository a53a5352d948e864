//! Boxes with vertical sides, rotated about the vertical, and their rectangular faces.

use glam::{DVec2, DVec3};

/// Box with vertical sides, rotated about the vertical: an obstruction or a building.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solid {
    centre: DVec2,
    half: DVec2,
    z: [f64; 2],
    /// Cosine and sine of the rotation, counter-clockwise seen from above.
    turn: [f64; 2],
}

/// Rectangular face of a box, or a rectangle on the ground or of an aperture, with coordinates in its plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// Point of the face's plane with the coordinates 0, 0. \[m\]
    pub origin: DVec3,
    /// Outward unit normal of the face.
    pub normal: DVec3,
    /// Unit vector along the first axis of the coordinates in the plane.
    pub u: DVec3,
    /// Unit vector along the second axis of the coordinates in the plane.
    pub v: DVec3,
    /// Lower and upper limit of the face along both axes of its coordinates. \[m\]
    pub limits: [[f64; 2]; 2],
}

impl Face {
    /// Returns the point with the coordinates `u` and `v` in the plane of the face. \[m\]
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        self.origin + u * self.u + v * self.v
    }

    /// Returns the two coordinates of a point in the plane of the face. \[m\]
    pub fn coordinates(&self, point: DVec3) -> [f64; 2] {
        let from = point - self.origin;
        [from.dot(self.u), from.dot(self.v)]
    }

    /// Returns the four corners of the face in order. \[m\]
    pub fn corners(&self) -> [DVec3; 4] {
        let [[a, b], [c, d]] = self.limits;
        [self.point(a, c), self.point(b, c), self.point(b, d), self.point(a, d)]
    }

    /// Returns the ends of the segment in which two faces intersect; `None` if they do not meet or lie in parallel
    /// planes. \[m\]
    pub fn meets(&self, other: &Self) -> Option<[DVec3; 2]> {
        let height = |p: DVec3| self.normal.dot(p - self.origin);
        let corners = other.corners();
        let mut crossed = (0..4).filter_map(|k| {
            let (a, b) = (corners[k], corners[(k + 1) % 4]);
            let (p, q) = (height(a), height(b));
            ((p > 0.0) != (q > 0.0)).then(|| a + (b - a) * (p / (p - q)))
        });
        let (from, to) = (crossed.next()?, crossed.next()?);
        self.clip([from, to])
    }

    /// Returns the part of a segment in the plane of the face that lies on the face; `None` if there is none.
    fn clip(&self, [from, to]: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        let (p, q) = (self.coordinates(from), self.coordinates(to));
        for axis in 0..2 {
            let [low, high] = self.limits[axis];
            let along = q[axis] - p[axis];
            if along.abs() < 1e-12 {
                if p[axis] < low || p[axis] > high {
                    return None;
                }
                continue;
            }
            let (s, t) = ((low - p[axis]) / along, (high - p[axis]) / along);
            first = first.max(s.min(t));
            last = last.min(s.max(t));
        }
        (last - first > 1e-9).then(|| [first, last].map(|t| from + t * (to - from)))
    }
}

/// Length within a box below which a ray only touches it. \[m\] Rounding of coordinates of 10⁶ m, the largest allowed,
/// is 1e-10 m.
const TOUCH: f64 = 1e-9;
/// Distance to the exit from a box below which the box lies behind the ray's start. \[m\] A ray that starts on a face
/// may start inside by rounding, 1e-10 m at 10⁶ m, and leave at a grazing angle.
const BEHIND: f64 = 1e-7;

impl Solid {
    /// Creates a box from two opposite corners \[m\], then rotated by `turn` \[rad\] about the vertical through its
    /// centre, counter-clockwise seen from above.
    pub fn new(from: DVec3, to: DVec3, turn: f64) -> Self {
        let (low, high) = (from.min(to), from.max(to));
        let (sin, cos) = turn.sin_cos();
        Self {
            centre: 0.5 * (low + high).truncate(),
            half: 0.5 * (high - low).truncate(),
            z: [low.z, high.z],
            turn: [cos, sin],
        }
    }

    /// Returns the box rotated about the vertical through the origin of coordinates. Argument: cosine and sine of the
    /// angle, counter-clockwise seen from above.
    pub fn turned(self, [cos, sin]: [f64; 2]) -> Self {
        let by = DVec2::new(cos, sin);
        let turn = by.rotate(DVec2::from_array(self.turn));
        Self { centre: by.rotate(self.centre), turn: turn.to_array(), ..self }
    }

    /// Converts a vector from the outer axes to the axes of the box.
    fn local(&self, v: DVec3) -> DVec3 {
        let [cos, sin] = self.turn;
        DVec3::new(cos * v.x + sin * v.y, cos * v.y - sin * v.x, v.z)
    }

    /// Converts a vector from the axes of the box to the outer axes.
    fn world(&self, v: DVec3) -> DVec3 {
        let [cos, sin] = self.turn;
        DVec3::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y, v.z)
    }

    /// Returns the centre of the box. \[m\]
    pub fn middle(&self) -> DVec3 {
        self.centre.extend(0.5 * (self.z[0] + self.z[1]))
    }

    /// Returns the distance from the centre of the box to its corners. \[m\]
    pub fn radius(&self) -> f64 {
        self.half.extend(0.5 * (self.z[1] - self.z[0])).length()
    }

    /// Returns the distance at which a ray enters the box \[m\], 0 if it starts inside, and the number of the face
    /// through which it enters ([`Self::face`]). `None` if the ray misses or only touches the box, or if the box lies
    /// behind its start. `direction`: unit vector.
    pub fn enter(&self, from: DVec3, direction: DVec3) -> Option<(f64, usize)> {
        let start = self.local(from - self.centre.extend(0.0));
        let along = self.local(direction);
        let limits = [[-self.half.x, self.half.x], [-self.half.y, self.half.y], self.z];
        let (mut near, mut far, mut face) = (f64::NEG_INFINITY, f64::INFINITY, 0);
        for axis in 0..3 {
            let [low, high] = limits[axis];
            let (o, d) = (start[axis], along[axis]);
            if d.abs() < 1e-14 {
                if o <= low + TOUCH || o >= high - TOUCH {
                    return None;
                }
                continue;
            }
            let (a, b) = ((low - o) / d, (high - o) / d);
            let (a, b, side) = if d > 0.0 { (a, b, 2 * axis) } else { (b, a, 2 * axis + 1) };
            if a > near {
                (near, face) = (a, side);
            }
            far = far.min(b);
        }
        (far > BEHIND && far - near.max(0.0) > TOUCH).then_some((near.max(0.0), face))
    }

    /// Returns the distances at which a horizontal ray enters and leaves the outline of the box in plan \[m\], at any
    /// height, and the number of the face through which it enters; `None` if it misses or only touches the outline.
    /// `along`: unit vector.
    pub fn passage(&self, from: DVec2, along: DVec2) -> Option<([f64; 2], usize)> {
        let start = self.local((from - self.centre).extend(0.0));
        let along = self.local(along.extend(0.0));
        let (mut near, mut far, mut face) = (f64::NEG_INFINITY, f64::INFINITY, 0);
        for axis in 0..2 {
            let (o, d, half) = (start[axis], along[axis], self.half[axis]);
            if d.abs() < 1e-14 {
                if o.abs() >= half - TOUCH {
                    return None;
                }
                continue;
            }
            let (a, b) = ((-half - o) / d, (half - o) / d);
            let (a, b, side) = if d > 0.0 { (a, b, 2 * axis) } else { (b, a, 2 * axis + 1) };
            if a > near {
                (near, face) = (a, side);
            }
            far = far.min(b);
        }
        (far - near > TOUCH).then_some(([near, far], face))
    }

    /// Returns the heights of the box's lower and upper face, z. \[m\]
    pub fn heights(&self) -> [f64; 2] {
        self.z
    }

    /// Returns the horizontal distance from the centre of the box to its corners. \[m\]
    pub fn outline_radius(&self) -> f64 {
        self.half.length()
    }

    /// Returns the part of the box above a height \[m\]; its height is 0 if the box lies below.
    pub fn above(&self, height: f64) -> Self {
        Self { z: self.z.map(|z| z.max(height)), ..*self }
    }

    /// Returns the box extended downwards to a height \[m\] if its lower face is above it.
    pub fn down_to(&self, height: f64) -> Self {
        Self { z: [self.z[0].min(height), self.z[1]], ..*self }
    }

    /// Whether a point lies inside the box.
    pub fn holds(&self, point: DVec3) -> bool {
        let own = self.local(point - self.centre.extend(0.0));
        own.x.abs() < self.half.x && own.y.abs() < self.half.y && own.z > self.z[0] && own.z < self.z[1]
    }

    /// Returns the corner given by three bits, for the sides along x, y and z of the box.
    fn corner(&self, bits: usize) -> DVec3 {
        let side = |bit: usize, half: f64| if bits >> bit & 1 == 1 { half } else { -half };
        self.centre.extend(0.0)
            + self.world(DVec3::new(side(0, self.half.x), side(1, self.half.y), self.z[bits >> 2 & 1]))
    }

    /// Returns all eight corners of the box. \[m\]
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|bits| self.corner(bits))
    }

    /// Returns the face with this number; the outward normals of the faces 0 … 5 are −x, +x, −y, +y, −z, +z of the
    /// box's axes.
    pub fn face(&self, number: usize) -> Face {
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| self.world(axis));
        let sign = if number % 2 == 1 { 1.0 } else { -1.0 };
        let ground = self.centre.extend(0.0);
        let [a, b] = [self.half.x, self.half.y].map(|half| [-half, half]);
        match number / 2 {
            0 => Face { origin: ground + sign * a[1] * x, normal: sign * x, u: y, v: z, limits: [b, self.z] },
            1 => Face { origin: ground + sign * b[1] * y, normal: sign * y, u: x, v: z, limits: [a, self.z] },
            _ => Face { origin: ground + self.z[number % 2] * z, normal: sign * z, u: x, v: y, limits: [a, b] },
        }
    }

    /// Whether a face is turned towards a point.
    fn faces(&self, number: usize, eye: DVec3) -> bool {
        let face = self.face(number);
        face.normal.dot(eye - face.origin) > 0.0
    }

    /// Returns every edge of the box with the numbers of the two faces that meet in it.
    fn edges(&self) -> [([DVec3; 2], [usize; 2]); 12] {
        std::array::from_fn(|index| {
            let (axis, place) = (index / 4, index % 4);
            let [one, two] = [(axis + 1) % 3, (axis + 2) % 3];
            let bits = (place & 1) << one | (place >> 1) << two;
            let ends = [self.corner(bits), self.corner(bits | 1 << axis)];
            (ends, [2 * one + (place & 1), 2 * two + (place >> 1)])
        })
    }

    /// Returns the edges of the faces that are turned towards the point `eye`, by their ends. \[m\]
    pub fn visible_edges(&self, eye: DVec3) -> impl Iterator<Item = [DVec3; 2]> + use<> {
        let turned: [bool; 6] = std::array::from_fn(|number| self.faces(number, eye));
        self.edges().into_iter().filter(move |(_, [a, b])| turned[*a] || turned[*b]).map(|(ends, _)| ends)
    }

    /// Returns the normals n of the planes through the point `eye` that bound the box as seen from there: directions d
    /// with n·d > 0 for all of them meet it. Empty if the point lies inside, or on a face with no part of the box in
    /// front of it.
    pub fn cone(&self, eye: DVec3) -> Vec<DVec3> {
        let turned: [bool; 6] = std::array::from_fn(|number| self.faces(number, eye));
        let middle = self.middle() - eye;
        let outline = self.edges().into_iter().filter(|(_, [a, b])| turned[*a] != turned[*b]);
        outline
            .filter_map(|([a, b], _)| {
                let normal = (a - eye).cross(b - eye);
                // An edge that points at the viewpoint defines no plane with it.
                let least = 1e-9 * (a - eye).length() * (b - eye).length();
                let normal = normal.try_normalize().filter(|_| normal.length() > least)?;
                Some(if normal.dot(middle) >= 0.0 { normal } else { -normal })
            })
            .collect()
    }

    /// Returns the distance between the axis-parallel bounding boxes of this box and of some points; 0 if they overlap.
    /// \[m\]
    pub fn gap_to(&self, points: &[DVec3]) -> f64 {
        let bounds = |points: &[DVec3]| {
            let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
            (low, points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max))
        };
        let ((a, b), (c, d)) = (bounds(&self.corners()), bounds(points));
        (c - b).max(a - d).max(DVec3::ZERO).length()
    }

    /// Whether two boxes overlap by more than `slack` \[m\] along every axis.
    pub fn overlaps(&self, other: &Self, slack: f64) -> bool {
        if self.z[0].max(other.z[0]) >= self.z[1].min(other.z[1]) - slack {
            return false;
        }
        // Two rectangles are disjoint if their projections on one of their four axes are (separating axes).
        let own = |solid: &Self| [0b000, 0b001, 0b011, 0b010].map(|bits| solid.corner(bits).truncate());
        let axes = |solid: &Self| {
            let [cos, sin] = solid.turn;
            [DVec2::new(cos, sin), DVec2::new(-sin, cos)]
        };
        let span = |corners: &[DVec2; 4], axis: DVec2| {
            let along = corners.map(|corner| corner.dot(axis));
            [along.into_iter().fold(f64::INFINITY, f64::min), along.into_iter().fold(f64::NEG_INFINITY, f64::max)]
        };
        let (one, two) = (own(self), own(other));
        axes(self).into_iter().chain(axes(other)).all(|axis| {
            let ([a, b], [c, d]) = (span(&one, axis), span(&two, axis));
            a.max(c) < b.min(d) - slack
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned_box() -> Solid {
        Solid::new(DVec3::new(1.0, -4.0, 0.0), DVec3::new(3.0, -2.0, 5.0), 30_f64.to_radians())
    }

    #[test]
    fn a_ray_enters_through_the_face_that_it_meets() {
        let unturned = Solid::new(DVec3::new(1.0, -4.0, 0.0), DVec3::new(3.0, -2.0, 5.0), 0.0);
        assert_eq!(unturned.enter(DVec3::new(2.0, 0.0, 1.0), DVec3::NEG_Y), Some((2.0, 3)));
        assert_eq!(unturned.enter(DVec3::new(2.0, 0.0, 1.0), DVec3::Y), None);
        assert_eq!(unturned.enter(DVec3::new(2.0, -3.0, 9.0), DVec3::NEG_Z), Some((4.0, 5)));
        // Along a face it only touches.
        assert_eq!(unturned.enter(DVec3::new(3.0, 0.0, 1.0), DVec3::NEG_Y), None);
        // Turned by 30° about its middle (2, −3): the half width along y is cos 30° + ... at x = 2 it is 1 / cos 30°.
        let (distance, face) = turned_box().enter(DVec3::new(2.0, 0.0, 1.0), DVec3::NEG_Y).unwrap();
        assert!((distance - (3.0 - 1.0 / 30_f64.to_radians().cos())).abs() < 1e-12 && face == 3, "{distance} {face}");
    }

    #[test]
    fn faces_hold_their_corners_and_look_outwards() {
        let solid = turned_box();
        for number in 0..6 {
            let face = solid.face(number);
            assert!(face.normal.dot(face.origin - solid.middle()) > 0.0 || number / 2 == 2);
            for corner in face.corners() {
                assert!(solid.corners().iter().any(|c| c.distance(corner) < 1e-12), "{number} {corner}");
                assert!(face.normal.dot(corner - solid.middle()) > 0.0);
            }
        }
    }

    #[test]
    fn the_cone_holds_exactly_the_rays_that_meet_the_box() {
        let solid = turned_box();
        let eye = DVec3::new(0.5, 0.0, 1.5);
        let cone = solid.cone(eye);
        let mut met = 0;
        for i in 0..200 {
            for k in 0..60 {
                let (phi, h) = (f64::from(i) * 0.0314, f64::from(k) * 0.05 - 1.5);
                let d = DVec3::new(h.cos() * phi.cos(), h.cos() * phi.sin(), h.sin());
                let inside = cone.iter().all(|n| n.dot(d) > 0.0);
                assert_eq!(inside, solid.enter(eye, d).is_some(), "{d}");
                met += usize::from(inside);
            }
        }
        assert!(met > 200);
    }

    #[test]
    fn faces_meet_where_both_are() {
        // A slab through a tower: its front cuts the tower's flank over the slab's height.
        let tower = Solid::new(DVec3::new(0.0, -5.0, 0.0), DVec3::new(1.0, -4.0, 9.0), 0.0);
        let slab = Solid::new(DVec3::new(-3.0, -4.6, 2.0), DVec3::new(3.0, -4.2, 3.0), 0.0);
        let [a, b] = tower.face(1).meets(&slab.face(3)).unwrap();
        let (low, high) = if a.z < b.z { (a, b) } else { (b, a) };
        assert!(low.distance(DVec3::new(1.0, -4.2, 2.0)) < 1e-12, "{low}");
        assert!(high.distance(DVec3::new(1.0, -4.2, 3.0)) < 1e-12, "{high}");
        // The slab's front lies inside the tower, before which nothing of it is cut.
        assert!(tower.face(3).meets(&slab.face(3)).is_none() && tower.face(5).meets(&slab.face(3)).is_none());
        // Turned by 45° it crosses the front's plane, too.
        let turned = Solid::new(DVec3::new(-3.0, -4.1, 2.0), DVec3::new(3.0, -3.9, 3.0), 45_f64.to_radians());
        let pairs = (0..6).flat_map(|a| (0..6).map(move |b| (a, b)));
        let met = pairs.filter_map(|(a, b)| tower.face(a).meets(&turned.face(b))).flatten();
        let on = |solid: &Solid, p: DVec3| solid.enter(p + 1e-6 * (p - solid.middle()), solid.middle() - p).is_some();
        assert!(met.filter(|p| on(&tower, *p) && on(&turned, *p)).count() >= 4);
    }

    #[test]
    fn boxes_that_touch_do_not_overlap() {
        let room = Solid::new(DVec3::ZERO, DVec3::new(4.0, 6.0, 3.0), 0.0);
        let solid = |from: [f64; 3], to: [f64; 3], turn: f64| {
            Solid::new(DVec3::from_array(from), DVec3::from_array(to), f64::to_radians(turn))
        };
        assert!(!room.overlaps(&solid([0.0, -1.2, 2.75], [4.0, 0.0, 2.9], 0.0), 1e-9));
        assert!(room.overlaps(&solid([0.0, -1.2, 2.75], [4.0, 0.01, 2.9], 0.0), 1e-9));
        assert!(room.overlaps(&solid([1.0, -1.2, 1.0], [2.0, -0.05, 2.0], 45.0), 1e-9));
        assert!(!room.overlaps(&solid([1.0, -1.2, 1.0], [2.0, -0.25, 2.0], 45.0), 1e-9));
        assert!(!room.overlaps(&solid([1.0, 1.0, 3.0], [2.0, 2.0, 4.0], 10.0), 1e-9));
    }
}
