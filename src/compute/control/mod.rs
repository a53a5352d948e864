//! Which state a moving system takes: rules over the sun's place before the façade.

use crate::compute::direction::{Dir, Facade};

/// Profile angle of a direction: the altitude of its projection on the vertical plane through the normal, atan2(y, z)
/// in the façade frame. [rad] `None` for directions from behind.
pub fn profile_angle(d: Dir<Facade>) -> Option<f64> {
    let v = d.vector();
    (v.z > 0.0).then(|| v.y.atan2(v.z))
}

/// Value of a piecewise linear curve of (profile angle, value) points, profile angles rising; constant beyond the
/// ends. `None` without points.
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

/// Index of the state for a demanded value: the least closed one that reaches it, so that rounding never lets the sun
/// in; the most closed when none does. A larger value is more closed. `None` without states.
pub fn towards_closed(values: &[f64], demanded: f64) -> Option<usize> {
    const SLACK: f64 = 1e-9;
    let most_closed = (0..values.len()).max_by(|&a, &b| values[a].total_cmp(&values[b]))?;
    (0..values.len())
        .filter(|&i| values[i] >= demanded - SLACK)
        .min_by(|&a, &b| values[a].total_cmp(&values[b]))
        .or(Some(most_closed))
}

/// Index of the most open state: the value nearest to 0. `None` without states.
pub fn most_open(values: &[f64]) -> Option<usize> {
    (0..values.len()).min_by(|&a, &b| values[a].abs().total_cmp(&values[b].abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn profile_angle_of_a_sun_straight_ahead_is_its_altitude() {
        let d = Dir::from_theta_phi(0.6, std::f64::consts::FRAC_PI_2);
        assert!((profile_angle(d).unwrap() - 0.6).abs() < 1e-12);
        assert_eq!(profile_angle(d.reversed()), None);
    }

    #[test]
    fn curves_are_linear_between_points_and_constant_beyond() {
        let curve = [(0.0, 60.0), (30.0, 20.0), (60.0, 0.0)];
        assert_eq!(curve_value(&curve, -10.0), Some(60.0));
        assert_eq!(curve_value(&curve, 15.0), Some(40.0));
        assert_eq!(curve_value(&curve, 80.0), Some(0.0));
        assert_eq!(curve_value(&[], 1.0), None);
    }

    #[test]
    fn rounding_goes_towards_closed() {
        let states = [0.0, 15.0, 30.0, 75.0];
        assert_eq!(towards_closed(&states, 15.1), Some(2));
        assert_eq!(towards_closed(&states, 15.0), Some(1));
        assert_eq!(towards_closed(&states, 80.0), Some(3));
        assert_eq!(most_open(&[-30.0, 10.0, 60.0]), Some(1));
    }
}
