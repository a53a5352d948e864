//! Polygons seen from a point: clipping by planes through the point, and Lambert's closed form for their light.

use glam::DVec3;

/// Keeps the part of a convex polygon with `normal · p ≥ 0` (Sutherland–Hodgman). Appends to an empty `kept`.
pub fn clip(polygon: &[DVec3], normal: DVec3, kept: &mut Vec<DVec3>) {
    kept.clear();
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (fp, fq) = (normal.dot(p), normal.dot(q));
        if fp >= 0.0 {
            kept.push(p);
        }
        if (fp > 0.0 && fq < 0.0) || (fp < 0.0 && fq > 0.0) {
            kept.push(p + (q - p) * (fp / (fp - fq)));
        }
    }
}

/// ∫ ω dω over the solid angle of a polygon whose corners are given as vectors from the point; positive when the
/// corners run counter-clockwise seen against the light. Lambert's edge sum ½ Σ Γᵢ n̂ᵢ, Γ by `atan2` (stable for slivers).
pub fn vector_solid_angle(polygon: &[DVec3]) -> DVec3 {
    let mut sum = DVec3::ZERO;
    for (i, &p) in polygon.iter().enumerate() {
        sum += edge(p, polygon[(i + 1) % polygon.len()]);
    }
    0.5 * sum
}

/// Γ n̂ of the arc from p to q.
pub fn edge(p: DVec3, q: DVec3) -> DVec3 {
    let cross = p.cross(q);
    let length = cross.length();
    if length < 1e-300 {
        return DVec3::ZERO;
    }
    cross * (length.atan2(p.dot(q)) / length)
}

/// ∫ max(0, n·ω) dω over a polygon of corners given as vectors from the point: illuminance per luminance. \[sr\]
pub fn projected_solid_angle(polygon: &[DVec3], normal: DVec3) -> f64 {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    clip(polygon, normal, &mut kept);
    if kept.len() < 3 {
        return 0.0;
    }
    vector_solid_angle(&kept).dot(normal).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Facing rectangle on axis, closed form of the method's corner function.
    fn facing(w: f64, h: f64, d: f64) -> f64 {
        let (x, y) = (0.5 * w / d, 0.5 * h / d);
        let (a, b) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
        2.0 * (x / a * (y / a).atan() + y / b * (x / b).atan())
    }

    #[test]
    fn facing_rectangle() {
        for (d, lx) in [(1.0, 857.324), (10.0, 11.9514), (0.2, 2827.90)] {
            let rectangle = [
                DVec3::new(-0.6, -0.5, d),
                DVec3::new(0.6, -0.5, d),
                DVec3::new(0.6, 0.5, d),
                DVec3::new(-0.6, 0.5, d),
            ];
            let e = 1000.0 * projected_solid_angle(&rectangle, DVec3::Z);
            assert!((e / lx - 1.0).abs() < 1e-5, "{e} {lx}");
            assert!((e / 1000.0 / facing(1.2, 1.0, d) - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn a_plane_that_fills_everything_gives_pi() {
        let far = 1e9;
        let plane = [
            DVec3::new(-far, -far, 1.0),
            DVec3::new(far, -far, 1.0),
            DVec3::new(far, far, 1.0),
            DVec3::new(-far, far, 1.0),
        ];
        assert!((projected_solid_angle(&plane, DVec3::Z) - std::f64::consts::PI).abs() < 1e-8);
        assert!((projected_solid_angle(&plane, DVec3::X) - 0.5 * std::f64::consts::PI).abs() < 1e-8);
        assert_eq!(projected_solid_angle(&plane, DVec3::NEG_Z), 0.0);
    }
}
