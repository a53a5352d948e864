//! Arcs of a section for rays: the whole circle, and shares of the length along the arc.

/// Point or vector (outward, upward).
pub(super) type Point = [f64; 2];

/// Circle that an arc of the section lies on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Circle {
    /// Centre of the circle.
    pub(super) centre: Point,
    /// Radius, < 0 where the left of the arc is the hollow side.
    pub(super) radius: f64,
    /// Left normal at the start of the arc.
    normal: Point,
    /// Angle by which the normal turns along the arc. \[rad\]
    pub(super) turn: f64,
}

impl Circle {
    /// Creates the circle of an arc from a to b with the left normals at both; `None` where the normals do not turn.
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

    /// Returns the left normal at a point of the circle.
    pub(super) fn normal(&self, point: Point) -> Point {
        let w = [point[0] - self.centre[0], point[1] - self.centre[1]];
        let size = (w[0] * w[0] + w[1] * w[1]).sqrt().max(f64::MIN_POSITIVE).copysign(self.radius);
        w.map(|x| x / size)
    }

    /// Returns the share of the arc at which the left normal is `n`.
    pub(super) fn share(&self, n: Point) -> f64 {
        let m = self.normal;
        (m[0] * n[1] - m[1] * n[0]).atan2(m[0] * n[0] + m[1] * n[1]) / self.turn
    }

    /// Returns the point at a share of the arc.
    pub(super) fn at(&self, share: f64) -> Point {
        let (sin, cos) = (share * self.turn).sin_cos();
        let m = self.normal;
        let n = [m[0] * cos - m[1] * sin, m[0] * sin + m[1] * cos];
        [self.centre[0] + self.radius * n[0], self.centre[1] + self.radius * n[1]]
    }

    /// Returns the distances along a ray at which it meets the whole circle, rising.
    pub(super) fn meets(&self, p: Point, d: Point) -> Option<[f64; 2]> {
        let w = [p[0] - self.centre[0], p[1] - self.centre[1]];
        let (ahead, beside) = (-(w[0] * d[0] + w[1] * d[1]), w[0] * d[1] - w[1] * d[0]);
        let half = self.radius * self.radius - beside * beside;
        (half > 0.0).then(|| [ahead - half.sqrt(), ahead + half.sqrt()])
    }
}
