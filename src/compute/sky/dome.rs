//! Grid of directions of the sky with linear interpolation of the luminance between them. An illuminance by the sky is
//! a sum over the grid with weights that do not depend on the sky's luminances.

use super::outside::Outside;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Grid of directions of the sky in rows of equal altitude, from the horizon to the zenith, world frame.
#[derive(Debug, Clone)]
pub(super) struct Dome {
    /// Difference of altitude between rows. \[rad\]
    step: f64,
    /// Index of the first direction of every row; last the number of all directions.
    first: Vec<usize>,
    directions: Vec<DVec3>,
}

impl Dome {
    /// Creates a grid whose neighbouring directions are about `spacing` apart. \[rad\]
    pub fn new(spacing: f64) -> Self {
        let rows = (FRAC_PI_2 / spacing).ceil();
        let step = FRAC_PI_2 / rows;
        let (mut first, mut directions) = (vec![0], Vec::new());
        for row in 0..=rows as usize {
            let (sin, cos) = (row as f64 * step).sin_cos();
            let count = if row == rows as usize { 1.0 } else { (TAU * cos / spacing).ceil().max(1.0) };
            directions.extend((0..count as usize).map(|k| {
                let (east, north) = (TAU * k as f64 / count).sin_cos();
                DVec3::new(cos * east, cos * north, sin.min(1.0))
            }));
            first.push(directions.len());
        }
        Self { step, first, directions }
    }

    /// Returns the number of directions of the grid.
    pub const fn len(&self) -> usize {
        self.directions.len()
    }

    /// Returns the luminance of the sky, without obstructions, in every direction of the grid. \[cd/m²\]
    pub fn luminances(&self, outside: &Outside) -> Vec<f64> {
        self.directions.iter().map(|d| outside.sky_luminance(*d)).collect()
    }

    /// Calls `add` with the indices of the grid directions around the direction `towards` (z ≥ 0) and their
    /// interpolation weights.
    pub fn spread(&self, towards: DVec3, mut add: impl FnMut(usize, f64)) {
        let rows = self.first.len() - 2;
        let at = towards.z.clamp(0.0, 1.0).asin() / self.step;
        let row = (at as usize).min(rows - 1);
        let above = at - row as f64;
        let bearing = towards.x.atan2(towards.y).rem_euclid(TAU) / TAU;
        for (row, share) in [(row, 1.0 - above), (row + 1, above)] {
            let (first, count) = (self.first[row], self.first[row + 1] - self.first[row]);
            let at = bearing * count as f64;
            let left = at as usize;
            let right = at - left as f64;
            add(first + left % count, share * (1.0 - right));
            add(first + (left + 1) % count, share * right);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::direction::Dir;
    use crate::compute::sky::Distribution;

    #[test]
    fn luminances_between_its_directions_are_nearly_those_of_the_sky() {
        let dome = Dome::new(0.05);
        let sun = Dir::from_altitude_bearing(0.6, Bearing::from_degrees(190.0));
        let sky = Outside::new(Distribution::cie(12, sun).unwrap(), 1e4).unwrap();
        let luminances = dome.luminances(&sky);
        for k in 0..500 {
            let altitude = FRAC_PI_2 * (0.754_877 * f64::from(k)).fract();
            let bearing = TAU * (0.569_840 * f64::from(k)).fract();
            let towards = Dir::from_altitude_bearing(altitude, Bearing::from_radians(bearing)).vector();
            let (mut found, mut all) = (0.0, 0.0);
            dome.spread(towards, |node, share| {
                found += share * luminances[node];
                all += share;
            });
            let exact = sky.sky_luminance(towards);
            // Beside the sun the luminance has a cusp.
            let near = towards.angle_between(sun.vector()) < 0.15;
            assert!(
                (all - 1.0_f64).abs() < 1e-12 && (found / exact - 1.0).abs() < if near { 0.06 } else { 1.5e-2 },
                "{k}: {found} {exact}"
            );
        }
    }
}
