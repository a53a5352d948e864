//! Shadows of boxes on rectangles, and the sunlit part of a rectangle as convex pieces with the edges of shadows as
//! borders.
//!
//! Shadows are those for the centre of the sun's disc.

use super::solid::{Face, Solid};
use crate::compute::polygon::{area, cut, cut_by_all};
use glam::{DVec2, DVec3};

/// Share of a rectangle's area below which pieces are negligible.
const NOTHING: f64 = 1e-12;
/// Distance below which a point counts as in a plane. \[m\] Rounding of coordinates of 10⁶ m, the largest allowed, is
/// 1e-10 m.
const TOUCHING: f64 = 1e-9;

/// Returns the outline of the shadow of a box on the plane of a face, in the coordinates of the face \[m\]: convex,
/// counter-clockwise; fewer than three corners if there is no shadow. `sun`: direction towards the sun, in front of the
/// plane.
pub fn shadow(solid: &Solid, face: &Face, sun: DVec3) -> Vec<DVec2> {
    let towards = face.normal.dot(sun);
    let height = |p: DVec3| face.normal.dot(p - face.origin);
    let corners = solid.corners();
    // A box behind the plane casts no shadow on it.
    if corners.iter().all(|p| height(*p) < TOUCHING) {
        return Vec::new();
    }
    // Only the part in front of the plane casts a shadow: its corners, and the points at which edges cross the plane.
    let mut points: Vec<DVec3> = corners.iter().copied().filter(|p| height(*p) >= 0.0).collect();
    if points.len() < corners.len() {
        for i in 0..8_usize {
            for axis in [1, 2, 4].into_iter().filter(|axis| i & axis == 0) {
                let (a, b) = (corners[i], corners[i | axis]);
                let (p, q) = (height(a), height(b));
                if (p > 0.0 && q < 0.0) || (p < 0.0 && q > 0.0) {
                    points.push(a + (b - a) * (p / (p - q)));
                }
            }
        }
    }
    let projected = points.into_iter().map(|p| DVec2::from_array(face.coordinates(p - sun * (height(p) / towards))));
    hull(projected.collect())
}

/// Returns the convex hull of points, counter-clockwise (Andrew's algorithm).
fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup_by(|a, b| a.distance(*b) < 1e-12);
    if points.len() < 3 {
        return Vec::new();
    }
    let chain = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(p - b) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = chain(&mut points.iter().copied());
    lower.extend(chain(&mut points.iter().rev().copied()));
    lower
}

/// Returns convex pieces without the area of the convex, counter-clockwise polygon `hole`, again as convex pieces;
/// those with an area below `least` are dropped.
pub fn without(pieces: Vec<Vec<DVec2>>, hole: &[DVec2], least: f64) -> Vec<Vec<DVec2>> {
    let mut left = Vec::with_capacity(pieces.len());
    let is_something = |piece: &Vec<DVec2>| piece.len() >= 3 && area(piece).abs() > least;
    for mut piece in pieces {
        for (k, &from) in hole.iter().enumerate() {
            let along = hole[(k + 1) % hole.len()] - from;
            let inside = |p: DVec2| along.perp_dot(p - from);
            if piece.iter().all(|p| inside(*p) >= 0.0) {
                continue;
            }
            if piece.iter().all(|p| inside(*p) <= 0.0) {
                left.push(piece);
                break;
            }
            let [mut outer, mut inner] = [const { Vec::new() }; 2];
            cut(&piece, |p| -inside(p), &mut outer);
            left.extend(Some(outer).filter(is_something));
            cut(&piece, inside, &mut inner);
            piece = inner;
            if !is_something(&piece) {
                break;
            }
        }
    }
    left
}

/// Returns the area of convex pieces outside the convex, counter-clockwise polygon `hole`.
pub fn area_without(pieces: Vec<Vec<DVec2>>, hole: &[DVec2]) -> f64 {
    let mut kept = Vec::new();
    let outside = |mut piece: Vec<DVec2>| {
        let whole = area(&piece).abs();
        let borders = hole.iter().zip(hole.iter().cycle().skip(1));
        cut_by_all(&mut piece, borders.map(|(from, to)| |p: DVec2| (*to - *from).perp_dot(p - *from)), &mut kept);
        (whole - area(&piece).abs()).max(0.0)
    };
    pieces.into_iter().map(outside).sum()
}

/// Returns the sunlit part of a face behind boxes as convex pieces, in the coordinates of the face \[m\]; empty if the
/// face is turned away from the sun. `sun`: direction towards the sun.
pub fn lit_pieces<'a>(face: &Face, solids: impl Iterator<Item = &'a Solid>, sun: DVec3) -> Vec<Vec<DVec2>> {
    if face.normal.dot(sun) <= 1e-9 {
        return Vec::new();
    }
    let [[a, b], [c, d]] = face.limits;
    let whole = vec![DVec2::new(a, c), DVec2::new(b, c), DVec2::new(b, d), DVec2::new(a, d)];
    let least = NOTHING * (b - a) * (d - c);
    solids.fold(vec![whole], |pieces, solid| {
        let hole = shadow(solid, face, sun);
        if hole.len() < 3 { pieces } else { without(pieces, &hole, least) }
    })
}

/// Returns the edges of the shadows of boxes on a face, clipped to the face, by their ends in the world's axes. \[m\]
/// `sun`: direction towards the sun.
pub fn shadow_edges<'a>(face: &Face, solids: impl Iterator<Item = &'a Solid>, sun: DVec3) -> Vec<[DVec3; 2]> {
    if face.normal.dot(sun) <= 1e-6 {
        return Vec::new();
    }
    let mut edges = Vec::new();
    for solid in solids {
        let outline = shadow(solid, face, sun);
        for (k, &from) in outline.iter().enumerate() {
            let to = outline[(k + 1) % outline.len()];
            let (mut first, mut last) = (0.0_f64, 1.0_f64);
            for axis in 0..2 {
                let [low, high] = face.limits[axis];
                let (p, q) = (from[axis], to[axis]);
                if (q - p).abs() < 1e-12 {
                    // An edge of the shadow on the face's border is not a discontinuity of the face.
                    if p <= low + 1e-9 || p >= high - 1e-9 {
                        last = -1.0;
                    }
                    continue;
                }
                let (s, t) = ((low - p) / (q - p), (high - p) / (q - p));
                first = first.max(s.min(t));
                last = last.min(s.max(t));
            }
            if last - first > 1e-9 {
                edges.push([first, last].map(|t| {
                    let at = from + t * (to - from);
                    face.point(at.x, at.y)
                }));
            }
        }
    }
    edges
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A window 3 × 2 m in the plane y = 0 that looks to −y.
    fn window() -> Face {
        Face {
            origin: DVec3::new(0.5, 0.0, 0.9),
            normal: DVec3::NEG_Y,
            u: DVec3::X,
            v: DVec3::Z,
            limits: [[0.0, 3.0], [0.0, 2.0]],
        }
    }

    fn share(solids: &[Solid], sun: DVec3) -> f64 {
        lit_pieces(&window(), solids.iter(), sun).iter().map(|piece| area(piece).abs()).sum::<f64>() / 6.0
    }

    #[test]
    fn an_overhang_shades_what_its_depth_and_the_sun_say() {
        // 1.2 m deep, its underside flush with the window's head: the shadow reaches 1.2·tan(profile angle) down.
        let overhang = Solid::new(DVec3::new(-9.0, -1.2, 2.9), DVec3::new(13.0, 0.0, 3.0), 0.0);
        let sun = DVec3::new(0.3, -1.0, 0.8).normalize();
        assert!((share(&[overhang], sun) - (1.0 - 1.2 * 0.8 / 2.0)).abs() < 1e-12);
        // What stands behind the plane shades nothing.
        let behind = Solid::new(DVec3::new(-9.0, 0.0, 0.0), DVec3::new(13.0, 4.0, 9.0), 0.0);
        assert_eq!(share(&[behind], sun), 1.0);
        assert_eq!(share(&[overhang], DVec3::new(0.0, 1.0, 1.0).normalize()), 0.0);
    }

    #[test]
    fn shadows_that_overlap_count_once_and_agree_with_rays() {
        let solids = [
            Solid::new(DVec3::new(0.0, -1.2, 2.4), DVec3::new(4.0, 0.0, 2.5), 0.0),
            Solid::new(DVec3::new(1.0, -0.9, 0.5), DVec3::new(1.1, 0.0, 2.8), 0.0),
            Solid::new(DVec3::new(2.0, -3.0, 1.0), DVec3::new(2.6, -2.0, 3.0), 0.5),
        ];
        let sun = DVec3::new(-0.5, -0.9, 0.45).normalize();
        let n = 400;
        let lit = (0..n * n).filter(|i| {
            let (u, v) = ((f64::from(i % n) + 0.5) / f64::from(n), (f64::from(i / n) + 0.5) / f64::from(n));
            let p = window().point(3.0 * u, 2.0 * v);
            solids.iter().all(|solid| solid.enter(p, sun).is_none())
        });
        let by_rays = lit.count() as f64 / f64::from(n * n);
        assert!((share(&solids, sun) - by_rays).abs() < 2e-3, "{} {by_rays}", share(&solids, sun));
        assert!(by_rays > 0.2 && by_rays < 0.8);
    }

    #[test]
    fn edges_lie_on_the_face_where_light_changes() {
        let fin = Solid::new(DVec3::new(1.0, -0.9, 0.0), DVec3::new(1.1, 0.0, 4.0), 0.0);
        let sun = DVec3::new(-1.0, -1.0, 0.2).normalize();
        let edges = shadow_edges(&window(), [fin].iter(), sun);
        // From the fin's foot to 0.9 m beside it; the other side of the shadow is the fin's own.
        assert!(edges.iter().any(|[a, b]| (a.x - 2.0).abs() < 1e-9 && (b.x - 2.0).abs() < 1e-9), "{edges:?}");
        for edge in edges.iter().flatten() {
            assert!(edge.y.abs() < 1e-12 && edge.z > 0.9 - 1e-9 && edge.z < 2.9 + 1e-9);
        }
    }
}
