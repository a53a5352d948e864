//! Visible part of the sun, a uniform disc of 0.533°, for a receiver behind straight edges.
//!
//! At the size of the disc every edge (of an aperture, the receiver's plane, the horizon) is a straight line in the
//! plane that touches the unit sphere at the sun's centre.

use super::sun::SUN_HALF_ANGLE;
use crate::compute::polygon::{cut, cut_by_all, is_tiny};
use glam::{DVec2, DVec3};

/// Edge that hides a part of the sphere: directions ω with `normal · ω ≥ offset` are visible.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Normal of the edge, towards the visible side, not necessarily of unit length.
    pub normal: DVec3,
    /// Offset of the edge along the normal: 0 for a great circle; sin(altitude) for a uniform skyline with the zenith
    /// as normal.
    pub offset: f64,
}

impl Edge {
    /// Creates the edge that leaves the hemisphere on the normal's side visible.
    pub const fn great_circle(normal: DVec3) -> Self {
        Self { normal, offset: 0.0 }
    }

    /// Creates the edge with this unit normal that leaves the share `share` of the sun's disc visible, 0 … 1; `height`:
    /// normal · direction towards the sun.
    pub fn leaving(normal: DVec3, height: f64, share: f64) -> Self {
        // The segment's chord at distance t of the radius below the centre, by halving.
        let (mut low, mut high) = (-1.0_f64, 1.0_f64);
        for _ in 0..50 {
            let t = 0.5 * (low + high);
            let free = 0.5 + (t.asin() + t * (1.0 - t * t).sqrt()) / std::f64::consts::PI;
            if free < share { low = t } else { high = t }
        }
        // A fully visible or hidden disc lies at a distance from the edge.
        let t = match share {
            1.0.. => 1.1,
            ..=0.0 => -1.1,
            _ => 0.5 * (low + high),
        };
        let slope = (1.0 - height * height).max(0.0).sqrt();
        Self { normal, offset: height - t * slope * SUN_HALF_ANGLE.tan() }
    }
}

/// Extent of a visible part, relative to the disc's radius, below which its area is computed relative to one of its
/// corners. Its area is 1e-10 of the disc's, in which the rounding of 2.2e-16 leaves six digits.
const SPECK: f64 = 1e-5;

/// Number of vertices of the polygon that represents a partly hidden disc. A polygon of the disc's area lies within
/// (2π/180)²/12 = 1e-4 of the radius from its rim: the error of [`share`].
const CORNERS: usize = 180;

/// Returns the illuminance of a receiver by the sun relative to the unobstructed normal illuminance: visible share of
/// the disc times the mean cosine to the receiver's normal. Exactly `receiver · sun` for a fully visible disc, 0 for a
/// hidden one; otherwise with an error of at most 1e-4. `sun`: direction towards the sun; `receiver`: normal of the
/// receiver, whose plane must be among the edges; all in the same frame.
pub fn share(sun: DVec3, receiver: DVec3, edges: impl IntoIterator<Item = Edge>) -> f64 {
    share_past(sun, receiver, edges, &[])
}

/// Returns the illuminance of a receiver by the sun relative to the unobstructed normal illuminance, like [`share`], if
/// convex bodies hide further parts of the disc. Each body is given by the normals n of the planes through the receiver
/// that bound it: it covers the directions ω with n·ω > 0 for all of them.
pub fn share_past(sun: DVec3, receiver: DVec3, edges: impl IntoIterator<Item = Edge>, bodies: &[Vec<DVec3>]) -> f64 {
    match free(sun, edges, bodies) {
        Free::None => 0.0,
        Free::All => receiver.dot(sun).max(0.0),
        Free::Part { share, middle } => share * receiver.dot(middle).max(0.0),
    }
}

/// Returns the vector towards the middle of the visible part of the sun's disc: the sun itself for a fully visible
/// disc, `None` for a hidden one.
pub fn middle(sun: DVec3, edges: impl IntoIterator<Item = Edge>) -> Option<DVec3> {
    match free(sun, edges, &[]) {
        Free::None => None,
        Free::All => Some(sun),
        Free::Part { middle, .. } => middle.try_normalize(),
    }
}

/// Visible part of the sun's disc.
enum Free {
    None,
    All,
    /// Visible share of the disc, and the middle of the visible part on the plane that touches the unit sphere at the
    /// sun.
    Part {
        share: f64,
        middle: DVec3,
    },
}

/// Computes the visible part of the sun's disc in front of all `edges` and outside all `bodies`, each given by the
/// inward normals of the planes through the viewpoint.
fn free(sun: DVec3, edges: impl IntoIterator<Item = Edge>, bodies: &[Vec<DVec3>]) -> Free {
    let radius = SUN_HALF_ANGLE.tan();
    let (u, v) = sun.any_orthonormal_pair();
    let mut crossing: Vec<(DVec2, f64)> = Vec::new();
    for edge in edges {
        let height = edge.normal.dot(sun) - edge.offset;
        let slope = DVec2::new(edge.normal.dot(u), edge.normal.dot(v));
        let reach = slope.length() * radius;
        if height <= -reach {
            return Free::None;
        }
        if height < reach {
            crossing.push((slope, height));
        }
    }
    // The planes of every body that cross the disc; planes with the whole disc on their inner side do not matter.
    let mut holes: Vec<Vec<(DVec2, f64)>> = Vec::new();
    for body in bodies.iter().filter(|body| !body.is_empty()) {
        let mut borders = Vec::new();
        let mut beside = false;
        for normal in body {
            let height = normal.dot(sun);
            let slope = DVec2::new(normal.dot(u), normal.dot(v));
            let reach = slope.length() * radius;
            beside |= height <= -reach;
            if height < reach {
                borders.push((slope, height));
            }
        }
        if beside {
            continue;
        }
        if borders.is_empty() {
            return Free::None;
        }
        holes.push(borders);
    }
    if crossing.is_empty() && holes.is_empty() {
        return Free::All;
    }
    // A regular polygon of the disc's area.
    let step = 2.0 * std::f64::consts::PI / CORNERS as f64;
    let outer = radius * (step / step.sin()).sqrt();
    let mut polygon: Vec<DVec2> = (0..CORNERS).map(|i| outer * DVec2::from_angle(i as f64 * step)).collect();
    let borders = crossing.into_iter().map(|(slope, height)| move |p: DVec2| slope.dot(p) + height);
    cut_by_all(&mut polygon, borders, &mut Vec::with_capacity(CORNERS + 8));
    let mut pieces = vec![polygon];
    for hole in &holes {
        pieces = outside_of(pieces, hole);
    }
    let (mut area, mut moment) = (0.0, DVec2::ZERO);
    for polygon in &pieces {
        // A tiny piece of the disc is integrated relative to its own corner, because rounding of coordinates on the
        // disc exceeds its area.
        let origin = polygon.first().copied().unwrap_or_default();
        let speck = polygon.iter().all(|p| p.distance(origin) < SPECK * radius);
        let origin = if speck { origin } else { DVec2::ZERO };
        let others = area;
        for (i, &p) in polygon.iter().enumerate() {
            let (p, q) = (p - origin, polygon[(i + 1) % polygon.len()] - origin);
            let cross = p.perp_dot(q);
            area += 0.5 * cross;
            moment += (p + q) * (cross / 6.0);
        }
        moment += (area - others) * origin;
    }
    if area <= 0.0 {
        return Free::None;
    }
    let centroid = moment / area;
    let share = (area / (std::f64::consts::PI * radius * radius)).min(1.0);
    Free::Part { share, middle: sun + u * centroid.x + v * centroid.y }
}

/// Returns the parts of convex pieces outside a body: outside its first border, or inside that and outside the second,
/// and so on.
fn outside_of(pieces: Vec<Vec<DVec2>>, borders: &[(DVec2, f64)]) -> Vec<Vec<DVec2>> {
    let mut left = Vec::with_capacity(pieces.len());
    for mut piece in pieces {
        for &(slope, height) in borders {
            let inside = |p: DVec2| slope.dot(p) + height;
            let (mut outer, mut inner) = (Vec::new(), Vec::new());
            cut(&piece, |p| -inside(p), &mut outer);
            cut(&piece, inside, &mut inner);
            if outer.len() >= 3 {
                left.push(outer);
            }
            piece = inner;
            if piece.len() < 3 {
                break;
            }
        }
    }
    left
}

/// Returns the edges of a convex aperture through which the sun is seen; `corners`: vectors from the receiver to its
/// corners. \[m\]
pub fn opening(corners: &[DVec3]) -> Vec<Edge> {
    let centre = corners.iter().sum::<DVec3>();
    let tiny = is_tiny(corners);
    (0..corners.len())
        .map(|i| {
            let (p, q) = (corners[i], corners[(i + 1) % corners.len()]);
            let plane = p.cross(if tiny { q - p } else { q }).normalize_or_zero();
            Edge::great_circle(if plane.dot(centre) >= 0.0 { plane } else { -plane })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn free_hidden_and_half() {
        let sun = DVec3::new(0.0, 0.6, 0.8);
        let above = Edge::great_circle(DVec3::Z);
        assert_eq!(share(sun, DVec3::Z, [above]), 0.8);
        assert_eq!(share(sun, DVec3::Z, [Edge::great_circle(DVec3::NEG_Z)]), 0.0);
        let half = Edge::great_circle(DVec3::X);
        assert!((share(sun, DVec3::Z, [half]) - 0.4).abs() < 1e-5);
    }

    #[test]
    fn an_edge_leaves_the_share_that_is_asked() {
        let sun = DVec3::new(0.0, 0.6, 0.8);
        let normal = DVec3::new(0.3, -0.2, 0.9).normalize();
        for asked in [0.0, 0.01, 0.25, 0.5, 0.9, 1.0] {
            let found = share(sun, DVec3::Z, [Edge::leaving(normal, normal.dot(sun), asked)]) / 0.8;
            assert!((found - asked).abs() < 5e-3, "{asked}: {found}");
        }
    }

    #[test]
    fn bodies_hide_what_lies_behind_them() {
        let sun = DVec3::new(0.0, 0.6, 0.8);
        let above = || [Edge::great_circle(DVec3::Z)];
        let half = vec![DVec3::X, DVec3::Z];
        assert!((share_past(sun, DVec3::Z, above(), std::slice::from_ref(&half)) - 0.4).abs() < 1e-5);
        // The same body twice hides no more, and its other half the rest.
        assert!((share_past(sun, DVec3::Z, above(), &[half.clone(), half.clone()]) - 0.4).abs() < 1e-5);
        let rest = vec![DVec3::NEG_X, DVec3::Z];
        assert!(share_past(sun, DVec3::Z, above(), &[half, rest]).abs() < 1e-12);
        assert_eq!(share_past(sun, DVec3::Z, above(), &[vec![DVec3::Y, DVec3::Z]]), 0.0);
        assert_eq!(share_past(sun, DVec3::Z, above(), &[vec![DVec3::NEG_Z]]), 0.8);
    }

    #[test]
    fn through_a_pinhole_the_disc_shines_by_the_pinholes_area() {
        // The middle of the disc, its luminance, and a pinhole that shows a speck of it.
        let sun = DVec3::new(0.1, 0.2, 0.95).normalize();
        let luminance = 1.0 / (std::f64::consts::PI * SUN_HALF_ANGLE.tan().powi(2));
        for distance in [1.0, 10.0, 100.0] {
            let centre = sun * (distance / sun.z);
            let corner = |x: f64, y: f64| centre + 1e-6 * DVec3::new(x, y, 0.0);
            let corners = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
            let area = (corners[1].x - corners[0].x) * (corners[3].y - corners[0].y);
            let e = share(sun, DVec3::Z, opening(&corners).into_iter().chain([Edge::great_circle(DVec3::Z)]));
            let exact = luminance * area * sun.z * sun.z / centre.length_squared();
            assert!((e / exact - 1.0).abs() < 1e-4, "{distance}: {e} {exact}");
        }
    }

    #[test]
    fn the_middle_of_a_rising_sun_is_above_the_horizon() {
        let horizon = || [Edge::great_circle(DVec3::Z)];
        let at = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            DVec3::new(0.0, cos, sin)
        };
        assert_eq!(middle(at(0.3), horizon()), Some(at(0.3)));
        assert_eq!(middle(at(-0.3), horizon()), None);
        // Of half a disc the middle lies at 4/3π of its radius.
        let half = middle(DVec3::Y, horizon()).unwrap();
        assert!((half.z / (4.0 / (3.0 * std::f64::consts::PI) * SUN_HALF_ANGLE.tan()) - 1.0).abs() < 1e-3);
        assert!(middle(at(-0.2), horizon()).unwrap().z > 0.0);
    }

    #[test]
    fn rising_sun_grows_smoothly() {
        // ∫ max(0, z) over a disc centred on the horizon is (2/3)·r³ of π r²: mean cosine (4/3π)·r of half the disc.
        let r = SUN_HALF_ANGLE.tan();
        let e = share(DVec3::Y, DVec3::Z, [Edge::great_circle(DVec3::Z)]);
        assert!((e / (2.0 * r / (3.0 * std::f64::consts::PI)) - 1.0).abs() < 1e-3);
        let mut last = 0.0;
        for i in 0..60 {
            let h = (i as f64 - 30.0) * SUN_HALF_ANGLE / 25.0;
            let e = share(DVec3::new(0.0, h.cos(), h.sin()), DVec3::Z, [Edge::great_circle(DVec3::Z)]);
            assert!(e >= last);
            last = e;
        }
    }
}
