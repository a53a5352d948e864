//! Profile angles of directions and of the sun's disc, in the section across the slats.
//!
//! A disc covers an interval of profile angles that is wider than the disc itself where the sun is far to the side:
//! half of it is asin(sin ρ / √(y² + z²)). Parts of the disc that horizon, skyline or the façade's own plane hide do
//! not count.

use crate::compute::direction::{Dir, Facade};
use glam::DVec3;

/// Returns the profile angle of a direction: the altitude of its projection on the vertical plane through the normal,
/// atan2(y, z) in the façade frame. \[rad\] `None` for directions from behind.
pub fn profile_angle(d: Dir<Facade>) -> Option<f64> {
    let v = d.vector();
    (v.z > 0.0).then(|| v.y.atan2(v.z))
}

/// Border that hides light: directions p are visible where p · `normal` ≥ `offset`. The normal lies in the plane x = 0,
/// as zenith and outward normal do in the façade frame; or along x, as the zenith does for vertical slats.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Screen {
    /// Unit vector towards the visible side.
    pub normal: DVec3,
    /// Sine of the altitude above the border's plane up to which light is hidden.
    pub offset: f64,
}

/// Returns the minimum and maximum profile angle of the visible part of a disc of angular radius `radius` about
/// `centre`, in front of the aperture's plane and past `screen` (horizon or skyline). \[rad\] `None` where nothing is
/// visible.
pub fn disc_span(centre: Dir<Facade>, radius: f64, screen: Screen) -> Option<[f64; 2]> {
    let v = centre.vector();
    let edges = [screen, Screen { normal: DVec3::Z, offset: 0.0 }];
    // A spherically convex region: its profile angles are an interval that ends at one of these points.
    let mut points = Vec::with_capacity(12);
    if radius == 0.0 {
        points.push(v);
    }
    // Where planes through the x axis touch the disc.
    let reach = v.y.hypot(v.z);
    if radius.sin() < reach {
        let half = (radius.sin() / reach).asin();
        for side in [-half, half] {
            let psi = v.y.atan2(v.z) + side;
            // The point of the half plane ψ that is nearest to the centre.
            let near = DVec3::new(v.x, 0.0, 0.0) + DVec3::new(0.0, psi.sin(), psi.cos()) * (reach * half.cos());
            points.extend(near.try_normalize());
        }
    }
    for edge in edges {
        points.extend(on_both_circles(v, radius.cos(), edge.normal, edge.offset).into_iter().flatten());
        let across = DVec3::new(0.0, edge.normal.z, -edge.normal.y);
        let rest = (1.0 - edge.offset * edge.offset).max(0.0).sqrt();
        points.extend([-1.0, 1.0].map(|sign| edge.normal * edge.offset + across * (sign * rest)));
    }
    // Rounding of scalar products of unit vectors (a few 2⁻⁵² ≈ 2.2e-16), with a margin that moves the sun's rim by
    // 1e-12 / sin 0.27° ≈ 2e-10 rad at most.
    const SLACK: f64 = 1e-12;
    let seen = |p: &DVec3| {
        p.dot(v) >= radius.cos() - SLACK && edges.iter().all(|edge| p.dot(edge.normal) >= edge.offset - SLACK)
    };
    let angles = points.into_iter().filter(seen).map(|p| p.y.atan2(p.z.max(0.0)));
    angles.fold(None, |span: Option<[f64; 2]>, psi| {
        Some(span.map_or([psi, psi], |[low, high]| [low.min(psi), high.max(psi)]))
    })
}

/// Returns the unit vectors p with p · a = `on_a` and p · b = `on_b`.
fn on_both_circles(a: DVec3, on_a: f64, b: DVec3, on_b: f64) -> [Option<DVec3>; 2] {
    let cosine = a.dot(b);
    let sine2 = 1.0 - cosine * cosine;
    if sine2 < 1e-24 {
        return [None; 2];
    }
    let along_a = (on_a - cosine * on_b) / sine2;
    let along_b = (on_b - cosine * on_a) / sine2;
    let rest = (1.0 - along_a * on_a - along_b * on_b) / sine2;
    if rest < 0.0 {
        return [None; 2];
    }
    let middle = a * along_a + b * along_b;
    [-1.0, 1.0].map(|sign| Some(middle + a.cross(b) * (sign * rest.sqrt())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    /// Horizon in front of a façade, without a skyline.
    const HORIZON: Screen = Screen { normal: DVec3::Y, offset: 0.0 };

    #[test]
    fn profile_angle_of_a_sun_straight_ahead_is_its_altitude() {
        let d = Dir::from_theta_phi(0.6, FRAC_PI_2);
        assert!((profile_angle(d).unwrap() - 0.6).abs() < 1e-12);
        assert_eq!(profile_angle(d.reversed()), None);
    }

    #[test]
    fn a_disc_straight_ahead_spans_its_own_width() {
        let span = disc_span(Dir::from_theta_phi(0.6, FRAC_PI_2), 0.01, HORIZON).unwrap();
        assert!((span[0] - 0.59).abs() < 1e-12 && (span[1] - 0.61).abs() < 1e-12, "{span:?}");
        // To the side, the same disc covers more of the section: 1/cos of the lateral angle.
        let v = DVec3::new(0.8, 0.36, 0.48);
        let span = disc_span(Dir::from_unit(v), 0.01, HORIZON).unwrap();
        assert!((0.5 * (span[1] - span[0]) - (0.01_f64.sin() / 0.6).asin()).abs() < 1e-12, "{span:?}");
    }

    /// Points of a disc, from the middle out, by turning about its centre.
    fn points(centre: Dir<Facade>, radius: f64) -> Vec<DVec3> {
        let v = centre.vector();
        let a = v.any_orthonormal_vector();
        let b = v.cross(a);
        let mut list = vec![v];
        for ring in 1..=60 {
            let r = radius * f64::from(ring) / 60.0;
            list.extend((0..720).map(|k| {
                let turn = 2.0 * PI * f64::from(k) / 720.0;
                v * r.cos() + (a * turn.cos() + b * turn.sin()) * r.sin()
            }));
        }
        list
    }

    #[test]
    fn spans_are_those_of_many_points_whatever_hides_a_part() {
        let radius = 0.03;
        let screens = [
            HORIZON,
            Screen { normal: DVec3::Y, offset: 0.2 },
            Screen { normal: DVec3::Z, offset: 0.0 },
            Screen { normal: DVec3::Z, offset: 0.1 },
        ];
        let mut seen = 0;
        for screen in screens {
            for i in 0..40 {
                for j in 0..20 {
                    let (turn, height) = (PI * f64::from(i) / 39.0, FRAC_PI_2 * f64::from(j) / 19.0 - 0.02);
                    // Around the horizon from the left to the right edge of the façade, and a little beyond.
                    let side = 1.03 * (turn - FRAC_PI_2);
                    let v = DVec3::new(side.sin() * height.cos(), height.sin(), side.cos() * height.cos());
                    let centre = Dir::from_unit(v);
                    let visible = |p: &DVec3| p.z > 0.0 && p.dot(screen.normal) > screen.offset;
                    let angles: Vec<f64> =
                        points(centre, radius).into_iter().filter(visible).map(|p| p.y.atan2(p.z)).collect();
                    let span = disc_span(centre, radius, screen);
                    if angles.is_empty() {
                        continue;
                    }
                    let [low, high] = span.expect("points of it are seen");
                    let [least, most] = angles
                        .iter()
                        .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], psi| [a.min(*psi), b.max(*psi)]);
                    // Never less than the points show, and no more than their spacing explains.
                    assert!(low <= least + 1e-9 && high >= most - 1e-9, "{v} {screen:?}: {low} {least} {high} {most}");
                    let reach = v.y.hypot(v.z);
                    if reach > 0.1 {
                        let slack = 0.002 / reach;
                        assert!(
                            least - low < slack && high - most < slack,
                            "{v} {screen:?}: {low} {least} {high} {most}"
                        );
                    }
                    seen += 1;
                }
            }
        }
        assert!(seen > 2000, "{seen}");
    }

    #[test]
    fn nothing_is_seen_of_a_sun_behind_or_below() {
        assert_eq!(disc_span(Dir::from_theta_phi(2.0, FRAC_PI_2), 0.005, HORIZON), None);
        assert_eq!(disc_span(Dir::from_theta_phi(0.1, -FRAC_PI_2), 0.005, HORIZON), None);
    }
}
