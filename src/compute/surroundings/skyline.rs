//! A skyline that rises and falls with the bearing.

use glam::DVec3;
use std::f64::consts::PI;

/// Altitudes between which the skyline runs straight over the bearing, all round.
#[derive(Debug, Clone, PartialEq)]
pub struct Skyline {
    /// Bearing and altitude, bearings rising within one turn. \[rad\]
    knots: Vec<[f64; 2]>,
    /// Of what stands below it. \[cd/m²\]
    pub luminance: f64,
}

impl Skyline {
    /// From compass bearings and altitudes \[rad\], in any order; `None` without any.
    pub fn new(knots: impl IntoIterator<Item = [f64; 2]>, luminance: f64) -> Option<Self> {
        let turned = knots.into_iter().map(|[bearing, altitude]| [bearing.rem_euclid(2.0 * PI), altitude]);
        let mut knots: Vec<[f64; 2]> = turned.collect();
        knots.sort_by(|a, b| a[0].total_cmp(&b[0]));
        (!knots.is_empty()).then_some(Self { knots, luminance })
    }

    /// Altitude at a compass bearing. \[rad\]
    pub fn altitude(&self, bearing: f64) -> f64 {
        let count = self.knots.len();
        let bearing = bearing.rem_euclid(2.0 * PI);
        let next = self.knots.partition_point(|knot| knot[0] < bearing);
        let (a, b) = (self.knots[(next + count - 1) % count], self.knots[next % count]);
        let width = (b[0] - a[0]).rem_euclid(2.0 * PI);
        let along = (bearing - a[0]).rem_euclid(2.0 * PI);
        if width > 0.0 { a[1] + (b[1] - a[1]) * (along / width).min(1.0) } else { b[1] }
    }

    /// How far a direction lies above the skyline. \[rad\]
    pub fn above(&self, direction: DVec3) -> f64 {
        direction.z.clamp(-1.0, 1.0).asin() - self.altitude(direction.x.atan2(direction.y))
    }

    /// Is a direction between horizon and skyline?
    pub fn covers(&self, direction: DVec3) -> bool {
        direction.z >= 0.0 && self.above(direction) < 0.0
    }

    /// Its highest altitude. \[rad\]
    pub fn highest(&self) -> f64 {
        self.knots.iter().map(|knot| knot[1]).fold(0.0, f64::max)
    }

    /// Directions of its corners.
    pub fn corners(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.knots.iter().map(|&[bearing, altitude]| direction(bearing, altitude))
    }

    /// Normal of the great circle that the skyline follows about a bearing, upwards: on the scale of the sun's disc it is
    /// straight.
    pub fn plane(&self, bearing: f64) -> DVec3 {
        const NEAR: f64 = 0.1 * PI / 180.0;
        let [a, b] = [-NEAR, NEAR].map(|by| direction(bearing + by, self.altitude(bearing + by)));
        let normal = b.cross(a).normalize_or_zero();
        if normal.z >= 0.0 { normal } else { -normal }
    }
}

fn direction(bearing: f64, altitude: f64) -> DVec3 {
    let ((sin, cos), (up, along)) = (bearing.sin_cos(), altitude.sin_cos());
    DVec3::new(along * sin, along * cos, up)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_runs_straight_between_its_knots_and_round_north() {
        let knots = [[300.0, 5.0], [20.0, 8.0], [110.0, 14.0]].map(|knot| knot.map(f64::to_radians));
        let skyline = Skyline::new(knots, 450.0).unwrap();
        for (bearing, altitude) in [(20.0, 8.0), (65.0, 11.0), (110.0, 14.0), (0.0, 7.25), (340.0, 6.5), (300.0, 5.0)] {
            let found = skyline.altitude(f64::to_radians(bearing)).to_degrees();
            assert!((found - altitude).abs() < 1e-9, "{bearing}: {found}");
        }
        assert!(skyline.covers(direction(1.0, 0.1)) && !skyline.covers(direction(1.0, 0.3)));
        let one = Skyline::new([[1.0, 0.2]], 0.0).unwrap();
        assert_eq!(one.altitude(4.0), 0.2);
    }

    #[test]
    fn its_plane_parts_above_from_below() {
        let skyline = Skyline::new([[1.0, 0.2], [2.0, 0.6]], 0.0).unwrap();
        let normal = skyline.plane(1.5);
        assert!(normal.dot(direction(1.5, 0.402)) > 0.0 && normal.dot(direction(1.5, 0.398)) < 0.0);
        assert!(normal.dot(direction(1.503, 0.4)) < 0.0 && normal.dot(direction(1.497, 0.4)) > 0.0);
    }
}
