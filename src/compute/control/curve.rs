//! Control curves: demanded values over the profile angle, from tables and from the closed forms of mirror slats.

use std::f64::consts::FRAC_PI_2;

/// Returns the value of a piecewise linear control curve at the profile angle `at`. \[unit of the points' values\]
/// `points` are (profile angle \[rad\], value) with rising profile angles; the curve is constant beyond its ends.
/// `None` without points.
pub fn curve_value(points: &[(f64, f64)], at: f64) -> Option<f64> {
    let (first, last) = (points.first()?, points.last()?);
    if at <= first.0 {
        return Some(first.1);
    }
    if at >= last.0 {
        return Some(last.1);
    }
    let i = points.partition_point(|point| point.0 <= at) - 1;
    let ((x0, y0), (x1, y1)) = (points[i], points[i + 1]);
    Some(if x1 > x0 { y0 + (y1 - y0) * (at - x0) / (x1 - x0) } else { y1 })
}

/// Returns the minimum and maximum value of a piecewise linear control curve between the profile angles `low` and
/// `high`. \[unit of the points' values\] `points` are (profile angle \[rad\], value). `None` without points.
pub fn curve_range(points: &[(f64, f64)], [low, high]: [f64; 2]) -> Option<[f64; 2]> {
    let ends = [curve_value(points, low)?, curve_value(points, high)?];
    let inside = points.iter().filter(|point| (low..=high).contains(&point.0)).map(|point| point.1);
    Some(inside.fold([ends[0].min(ends[1]), ends[0].max(ends[1])], |[a, b], value| [a.min(value), b.max(value)]))
}

/// Returns the tilt of a mirror slat that reflects light of profile angle `psi` \[rad\] back towards its source: the
/// slat is perpendicular to the beam, β = 90° − ψ. \[rad\]
pub fn retro_tilt(psi: f64) -> f64 {
    FRAC_PI_2 - psi
}

/// Returns the tilt of a mirror slat whose upper face redirects light of profile angle `psi` \[rad\] into the room at
/// `elevation` above the horizontal \[rad\]: reflection turns the light's path by twice the slat's angle, elevation =
/// 2β + ψ. \[rad\]
pub fn redirecting_tilt(psi: f64, elevation: f64) -> f64 {
    0.5 * (elevation - psi)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_are_linear_between_points_and_constant_beyond() {
        let curve = [(0.0, 60.0), (30.0, 20.0), (60.0, 0.0)];
        assert_eq!(curve_value(&curve, -10.0), Some(60.0));
        assert_eq!(curve_value(&curve, 15.0), Some(40.0));
        assert_eq!(curve_value(&curve, 80.0), Some(0.0));
        assert_eq!(curve_value(&[], 1.0), None);
        assert_eq!(curve_range(&curve, [15.0, 45.0]), Some([10.0, 40.0]));
        assert_eq!(curve_range(&[(0.0, 5.0), (10.0, -1.0), (20.0, 5.0)], [5.0, 15.0]), Some([-1.0, 2.0]));
    }

    /// Mirrors the path of light of profile angle ψ in a slat of tilt β; (inward, upward).
    fn mirrored(psi: f64, tilt: f64) -> [f64; 2] {
        // Light travels inward and down; seen from the outer edge (lowered by β > 0), the slat rises inward.
        let (d, slat) = ([psi.cos(), -psi.sin()], [tilt.cos(), tilt.sin()]);
        let along = 2.0 * (d[0] * slat[0] + d[1] * slat[1]);
        [along * slat[0] - d[0], along * slat[1] - d[1]]
    }

    #[test]
    fn mirrors_send_light_where_the_forms_say() {
        for k in 0..=80 {
            let psi = f64::from(k).to_radians();
            let back = mirrored(psi, retro_tilt(psi));
            assert!((back[0] + psi.cos()).abs() < 1e-12 && (back[1] - psi.sin()).abs() < 1e-12);
            for elevation in [0.0, 0.3, 0.7_f64] {
                let on = mirrored(psi, redirecting_tilt(psi, elevation));
                assert!((on[0] - elevation.cos()).abs() < 1e-12 && (on[1] - elevation.sin()).abs() < 1e-12);
            }
        }
    }
}
