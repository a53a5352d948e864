//! Convex polygons: cutting at straight borders, areas, and Lambert's closed form for the light of polygons seen from a
//! point.

use glam::{DVec2, DVec3};
use std::ops::{Add, Mul, Sub};

/// Keeps the part of a convex polygon with `inside` ≥ 0, a linear function (Sutherland–Hodgman). `kept` is emptied
/// first.
pub fn cut<P>(polygon: &[P], inside: impl Fn(P) -> f64, kept: &mut Vec<P>)
where
    P: Copy + Add<Output = P> + Sub<Output = P> + Mul<f64, Output = P>,
{
    kept.clear();
    let mut fp = polygon.first().map_or(0.0, |&p| inside(p));
    for (&p, &q) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let fq = inside(q);
        if fp >= 0.0 {
            kept.push(p);
        }
        if (fp > 0.0 && fq < 0.0) || (fp < 0.0 && fq > 0.0) {
            kept.push(p + (q - p) * (fp / (fp - fq)));
        }
        fp = fq;
    }
}

/// Reduces a convex polygon to the part that all of the functions keep, see [`cut`]; empties it where that part has no
/// area. `kept` is a buffer.
pub fn cut_by_all<F: Fn(DVec2) -> f64>(
    polygon: &mut Vec<DVec2>,
    borders: impl IntoIterator<Item = F>,
    kept: &mut Vec<DVec2>,
) {
    for inside in borders {
        if polygon.iter().all(|&p| inside(p) >= 0.0) {
            continue;
        }
        cut(polygon, inside, kept);
        std::mem::swap(polygon, kept);
        if polygon.len() < 3 {
            polygon.clear();
            return;
        }
    }
}

/// Span of a polygon relative to its distance below which it is too small for products of its corners: these are nearly
/// parallel, and the rounding of their product, over the square of the span, would be visible. Chosen: 2⁻⁵² over its
/// square is 2e-6, and both formulas are exact but for rounding.
const TINY: f64 = 1e-5;

/// Returns the area of a plane polygon, > 0 when it turns counter-clockwise. A polygon that is tiny beside its distance
/// from the origin is summed about its first corner, so that products of large coordinates do not round it away.
pub fn area(polygon: &[DVec2]) -> f64 {
    let Some(&first) = polygon.first() else { return 0.0 };
    let span = TINY * TINY * first.length_squared();
    let origin = if polygon.iter().all(|p| p.distance_squared(first) < span) { first } else { DVec2::ZERO };
    let corner = |k: usize| polygon[k % polygon.len()] - origin;
    (0..polygon.len()).map(|k| 0.5 * corner(k).perp_dot(corner(k + 1))).sum()
}

/// Whether a polygon, its corners given as vectors from the point, looks so small from there that only the differences
/// of its corners hold its shape.
pub fn is_tiny(polygon: &[DVec3]) -> bool {
    polygon.first().is_some_and(|first| {
        let span = TINY * TINY * first.length_squared();
        polygon.iter().all(|p| p.distance_squared(*first) < span)
    })
}

/// Keeps the part of a convex polygon with `normal · p ≥ 0`, see [`cut`].
pub fn clip(polygon: &[DVec3], normal: DVec3, kept: &mut Vec<DVec3>) {
    cut(polygon, |p| normal.dot(p), kept);
}

/// Returns ∫ ω dω over the solid angle of a polygon whose corners are given as vectors from the point; positive when
/// the corners run counter-clockwise seen against the light. Lambert's edge sum ½ Σ Γᵢ n̂ᵢ, Γ by `atan2` (stable for
/// slivers).
pub fn vector_solid_angle(polygon: &[DVec3]) -> DVec3 {
    let tiny = is_tiny(polygon);
    let mut sum = DVec3::ZERO;
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        sum += if tiny { arc(p.cross(q - p), p, q) } else { edge(p, q) };
    }
    0.5 * sum
}

/// Returns Γ n̂ of the arc from p to q.
pub fn edge(p: DVec3, q: DVec3) -> DVec3 {
    arc(p.cross(q), p, q)
}

/// Returns Γ n̂ of the arc from p to q, given their cross product.
fn arc(cross: DVec3, p: DVec3, q: DVec3) -> DVec3 {
    let length = cross.length();
    if length < 1e-300 {
        return DVec3::ZERO;
    }
    cross * (length.atan2(p.dot(q)) / length)
}

/// Returns ∫ max(0, n·ω) dω over a polygon of corners given as vectors from the point: illuminance per luminance.
/// \[sr\]
pub fn projected_solid_angle(polygon: &[DVec3], normal: DVec3) -> f64 {
    if polygon.len() >= 3 && polygon.iter().all(|p| normal.dot(*p) >= 0.0) {
        return vector_solid_angle(polygon).dot(normal).abs();
    }
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
    fn an_opening_of_a_micrometre_sends_what_its_area_does() {
        for (x, y, z) in [(0.0, 0.0, 1.0), (3.0, -2.0, 6.0), (-40.0, 70.0, 100.0)] {
            for size in [1e-6, 1e-5, 1e-4] {
                let corner = |u: f64, v: f64| DVec3::new(x + u * size, y + v * size, z);
                let rectangle = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
                // What the sides of the rectangle are once its corners are rounded.
                let area = (rectangle[1].x - x) * (rectangle[3].y - y);
                let centre = corner(0.5, 0.5);
                for normal in [DVec3::Z, DVec3::new(0.3, 0.1, 0.9).normalize()] {
                    let far = area * z * normal.dot(centre) / centre.length_squared().powi(2);
                    let e = projected_solid_angle(&rectangle, normal);
                    assert!((e / far - 1.0).abs() < 3e-8, "{size} at {centre}: {e} {far}");
                }
            }
        }
        let shifted =
            [[3.0, 5.0], [3.0 + 1e-6, 5.0], [3.0 + 1e-6, 5.0 + 1e-6], [3.0, 5.0 + 1e-6]].map(DVec2::from_array);
        assert!((area(&shifted) / 1e-12 - 1.0).abs() < 1e-8);
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
