//! Outlines of light-redirecting profiles: arcs as many facets.

use std::f64::consts::PI;

/// Points of a circular arc from `a` to `b`, both ends included, that bulges to the left of a → b by `rise` (to the
/// right where it is negative; at most half the chord), in facets that turn by at most `step`. \[m, rad\]
///
/// The ends of the facets lie on the arc; a facet of 1° sends light up to 0.5° (times the refraction) away from where
/// the arc would.
pub fn arc(a: [f64; 2], b: [f64; 2], rise: f64, step: f64) -> Vec<[f64; 2]> {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let chord = dx.hypot(dy);
    let half = 2.0 * (2.0 * rise.abs() / chord).atan();
    if half == 0.0 || !half.is_finite() {
        return vec![a, b];
    }
    let radius = 0.5 * chord / half.sin();
    let facets = (2.0 * half / step.max(1e-3)).ceil().clamp(1.0, 2.0 * PI / 1e-3) as usize;
    let (along, left) = ([dx / chord, dy / chord], [-dy / chord, dx / chord]);
    let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    let point = |k: usize| {
        let angle = half * (2.0 * k as f64 / facets as f64 - 1.0);
        let (u, v) = (radius * angle.sin(), rise.signum() * radius * (angle.cos() - half.cos()));
        [middle[0] + u * along[0] + v * left[0], middle[1] + u * along[1] + v * left[1]]
    };
    // The ends exactly, so that outlines close.
    (0..=facets)
        .map(|k| {
            if k == 0 {
                a
            } else if k == facets {
                b
            } else {
                point(k)
            }
        })
        .collect()
}

/// A closed bar between two arcs, lying across the window: `width` along z (outward), `thickness` at both ends; the
/// upper and the lower face bulge upwards by their rises (negative: hollow). \[m\] The middle is the origin.
///
/// Bars like these stand one above the other in light-redirecting glass: light enters through the outer end, is
/// totally reflected at the faces and leaves upwards.
pub fn bar(width: f64, thickness: f64, rises: [f64; 2], step: f64) -> Vec<[f64; 2]> {
    let (w, t) = (0.5 * width, 0.5 * thickness);
    let mut points = arc([-w, t], [w, t], rises[0], step);
    let lower = arc([w, -t], [-w, -t], -rises[1], step);
    points.extend(lower);
    points
}

#[test]
fn arcs_lie_on_their_circle() {
    for rise in [0.002, -0.003, 0.005] {
        let points = arc([0.0, 0.0], [0.01, 0.0], rise, 0.02);
        let radius = (0.005_f64.powi(2) + rise * rise) / (2.0 * rise.abs());
        let centre = [0.005, rise - radius * rise.signum()];
        for p in &points {
            assert!(((p[0] - centre[0]).hypot(p[1] - centre[1]) - radius).abs() < 1e-12, "{rise} {p:?}");
        }
        let top = points.iter().map(|p| p[1] * rise.signum()).fold(0.0, f64::max);
        assert!((top - rise.abs()).abs() < 1e-5);
    }
    assert_eq!(arc([0.0, 0.0], [1.0, 0.0], 0.0, 0.1).len(), 2);
}
