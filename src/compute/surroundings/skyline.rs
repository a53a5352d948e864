//! Skyline of distant obstructions whose altitude changes with the compass bearing.

use crate::compute::sweep::rule;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Skyline by bearing: altitude of distant obstructions over the full circle, linear in the bearing between its
/// corners, with a uniform luminance.
#[derive(Debug, Clone, PartialEq)]
pub struct Skyline {
    /// Compass bearing and altitude of every corner, bearings rising within one turn. \[rad\]
    knots: Vec<[f64; 2]>,
    /// Luminance of the area below the skyline. \[cd/m²\]
    pub luminance: f64,
}

impl Skyline {
    /// Creates a skyline from the compass bearings and altitudes \[rad\] of its corners, in any order, and a luminance
    /// \[cd/m²\]; `None` without corners.
    pub fn new(knots: impl IntoIterator<Item = [f64; 2]>, luminance: f64) -> Option<Self> {
        let turned = knots.into_iter().map(|[bearing, altitude]| [bearing.rem_euclid(2.0 * PI), altitude]);
        let mut knots: Vec<[f64; 2]> = turned.collect();
        knots.sort_by(|a, b| a[0].total_cmp(&b[0]));
        (!knots.is_empty()).then_some(Self { knots, luminance })
    }

    /// Returns the skyline with another luminance. \[cd/m²\]
    pub fn with_luminance(self, luminance: f64) -> Self {
        Self { luminance, ..self }
    }

    /// Whether another skyline has the same corners, independent of its luminance.
    pub fn same_shape(&self, other: &Self) -> bool {
        self.knots == other.knots
    }

    /// Returns the altitude of the skyline at a compass bearing. \[rad\]
    pub fn altitude(&self, bearing: f64) -> f64 {
        let count = self.knots.len();
        let bearing = bearing.rem_euclid(2.0 * PI);
        let next = self.knots.partition_point(|knot| knot[0] < bearing);
        let (a, b) = (self.knots[(next + count - 1) % count], self.knots[next % count]);
        let width = (b[0] - a[0]).rem_euclid(2.0 * PI);
        let along = (bearing - a[0]).rem_euclid(2.0 * PI);
        if width > 0.0 { a[1] + (b[1] - a[1]) * (along / width).min(1.0) } else { b[1] }
    }

    /// Returns the altitude of a direction (unit vector, world's axes) relative to the skyline, negative below it.
    /// \[rad\]
    pub fn above(&self, direction: DVec3) -> f64 {
        direction.z.clamp(-1.0, 1.0).asin() - self.altitude(direction.x.atan2(direction.y))
    }

    /// Whether a direction (world's axes) lies between the horizon and the skyline.
    pub fn covers(&self, direction: DVec3) -> bool {
        direction.z >= 0.0 && self.above(direction) < 0.0
    }

    /// Returns the maximum altitude of the skyline. \[rad\]
    pub fn highest(&self) -> f64 {
        self.knots.iter().map(|knot| knot[1]).fold(0.0, f64::max)
    }

    /// Returns the directions of the skyline's corners as unit vectors in the world's axes.
    pub fn corners(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.knots.iter().map(|&[bearing, altitude]| direction(bearing, altitude))
    }

    /// Returns the share of a small disc (of the sun) that lies above the skyline and the horizon, 0 … 1, with corners
    /// and steps of the skyline within the disc. `direction`: of the disc's centre, world's axes; `radius`: angular
    /// radius \[rad\]. Heights are counted vertically in the disc's plane; the error is of the order of the square of
    /// the radius.
    pub fn free_share(&self, direction: DVec3, radius: f64) -> f64 {
        /// Number of Gauss points between corners of the skyline. Chosen; held by the test
        /// `a_disc_is_cut_by_every_corner_and_step`, which compares with segments of the disc to 2e-3.
        const POINTS: usize = 12;
        let sideways = DVec3::new(direction.y, -direction.x, 0.0).try_normalize().unwrap_or(DVec3::X);
        let middle = direction.x.atan2(direction.y);
        let cos = direction.truncate().length();
        // Columns of the disc at radius · sin t, with additional knots at the skyline's corners.
        let mut knots = vec![-FRAC_PI_2, 0.0, FRAC_PI_2];
        for [bearing, _] in &self.knots {
            let from = bearing - middle;
            let aside = cos * (from - 2.0 * PI * (from / (2.0 * PI)).round()).sin() / radius;
            if aside.abs() < 1.0 {
                knots.push(aside.asin());
            }
        }
        knots.sort_unstable_by(f64::total_cmp);
        let mut share = 0.0;
        for pair in knots.windows(2) {
            for &(x, weight) in rule(POINTS) {
                let t = pair[0] + (pair[1] - pair[0]) * x;
                let at = direction + sideways * (radius * t.sin());
                let height = at.z.atan2(at.truncate().length());
                let hidden = self.altitude(at.x.atan2(at.y)).max(0.0) - height;
                let half = radius * t.cos();
                let free = (0.5 * (1.0 - hidden / half)).clamp(0.0, 1.0);
                share += weight * (pair[1] - pair[0]) * free * t.cos() * t.cos();
            }
        }
        // Exactly 1 for a fully visible and 0 for a hidden disc, without the rounding of the quadrature.
        let share = share * 2.0 / PI;
        if share > 1.0 - 1e-9 {
            1.0
        } else if share < 1e-9 {
            0.0
        } else {
            share
        }
    }

    /// Returns the upward normal (world's axes) of the great circle that approximates the skyline about a bearing
    /// \[rad\]: at the size of the sun's disc the skyline is straight except at corners.
    pub fn plane(&self, bearing: f64) -> DVec3 {
        /// Angle to both sides of the bearing over which the skyline counts as straight. \[rad\] Chosen: less than half
        /// of the sun's radius of 0.2665°; held by the test `its_plane_parts_above_from_below`.
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
    fn a_disc_is_cut_by_every_corner_and_step() {
        let radius = 0.2665_f64;
        let share = |knots: &[[f64; 2]], altitude: f64| {
            let skyline = Skyline::new(knots.iter().map(|knot| knot.map(f64::to_radians)), 0.0).unwrap();
            skyline.free_share(direction(PI, altitude.to_radians()), radius.to_radians())
        };
        assert_eq!(share(&[[0.0, 20.0]], 21.0), 1.0);
        assert_eq!(share(&[[0.0, 20.0]], 19.0), 0.0);
        assert!((share(&[[0.0, 20.0]], 20.0) - 0.5).abs() < 1e-3);
        // An upright step beside the middle: a segment of the disc.
        for aside in [0.0, 0.1, 0.2, 0.26, 0.4] {
            let step = [[150.0, 0.0], [180.0 + aside, 0.0], [180.0001 + aside, 40.0], [220.0, 40.0], [230.0, 0.0]];
            let x = (aside / radius * 30_f64.to_radians().cos()).min(1.0);
            let free = 1.0 - (x.acos() - x * (1.0 - x * x).sqrt()) / PI;
            assert!((share(&step, 30.0) - free).abs() < 2e-3, "{aside}: {} {free}", share(&step, 30.0));
        }
        // A ridge at the middle whose slopes fall at 45° on the sky: three quarters are free.
        let fall = 30.0 - 10.0 * 30_f64.to_radians().cos();
        let ridge = share(&[[170.0, fall], [180.0, 30.0], [190.0, fall]], 30.0);
        assert!((ridge - 0.75).abs() < 2e-3, "{ridge}");
    }

    #[test]
    fn its_plane_parts_above_from_below() {
        let skyline = Skyline::new([[1.0, 0.2], [2.0, 0.6]], 0.0).unwrap();
        let normal = skyline.plane(1.5);
        assert!(normal.dot(direction(1.5, 0.402)) > 0.0 && normal.dot(direction(1.5, 0.398)) < 0.0);
        assert!(normal.dot(direction(1.503, 0.4)) < 0.0 && normal.dot(direction(1.497, 0.4)) > 0.0);
    }
}
