//! Circular arcs of a slat's section for the tracing of rays: intersection with the whole circle, and position along
//! the arc as a share of its length.

/// Point \[pitches\] or vector (outward, upward) in the section.
pub(super) type Point = [f64; 2];

/// Circle that an arc of the section lies on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Circle {
    /// Centre of the circle.
    pub(super) centre: Point,
    /// Radius of the circle; negative where the left side of the arc is the concave one. \[pitches\]
    pub(super) radius: f64,
    /// Unit normal to the left at the start of the arc.
    normal: Point,
    /// Angle by which the normal turns along the arc. \[rad\]
    pub(super) turn: f64,
}

impl Circle {
    /// Creates the circle of an arc from `a` to `b` with the unit normals to the left at both ends; `None` where the
    /// normals are equal (straight line).
    pub(super) fn of(a: Point, b: Point, [m, n]: [Point; 2]) -> Option<Self> {
        let change = [n[0] - m[0], n[1] - m[1]];
        let square = change[0] * change[0] + change[1] * change[1];
        if square < 1e-12 {
            return None;
        }
        let radius = ((b[0] - a[0]) * change[0] + (b[1] - a[1]) * change[1]) / square;
        let centre = [a[0] - radius * m[0], a[1] - radius * m[1]];
        let turn = (m[0] * n[1] - m[1] * n[0]).atan2(m[0] * n[0] + m[1] * n[1]);
        // Arcs reach to half a turn, where rounding decides the sign; the left of a convex way is outside.
        let turn = if (turn > 0.0) == (radius < 0.0) { turn } else { -turn };
        Some(Self { centre, radius, normal: m, turn })
    }

    /// Returns the unit normal to the left of the arc at a point of the circle.
    pub(super) fn normal(&self, point: Point) -> Point {
        let w = [point[0] - self.centre[0], point[1] - self.centre[1]];
        let size = (w[0] * w[0] + w[1] * w[1]).sqrt().max(f64::MIN_POSITIVE).copysign(self.radius);
        w.map(|x| x / size)
    }

    /// Returns the position along the arc, as a share of its length, at which the normal to the left is `n`.
    pub(super) fn share(&self, n: Point) -> f64 {
        let m = self.normal;
        (m[0] * n[1] - m[1] * n[0]).atan2(m[0] * n[0] + m[1] * n[1]) / self.turn
    }

    /// Returns the point at a position along the arc, given as a share of its length.
    pub(super) fn at(&self, share: f64) -> Point {
        let (sin, cos) = (share * self.turn).sin_cos();
        let m = self.normal;
        let n = [m[0] * cos - m[1] * sin, m[0] * sin + m[1] * cos];
        [self.centre[0] + self.radius * n[0], self.centre[1] + self.radius * n[1]]
    }

    /// Returns the two distances along the ray from `p` in direction `d` at which it meets the whole circle, in rising
    /// order; `None` if it misses the circle.
    pub(super) fn meets(&self, p: Point, d: Point) -> Option<[f64; 2]> {
        let w = [p[0] - self.centre[0], p[1] - self.centre[1]];
        let (ahead, beside) = (-(w[0] * d[0] + w[1] * d[1]), w[0] * d[1] - w[1] * d[0]);
        let half = self.radius * self.radius - beside * beside;
        (half > 0.0).then(|| [ahead - half.sqrt(), ahead + half.sqrt()])
    }
}
