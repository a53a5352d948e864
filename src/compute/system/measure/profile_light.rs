//! Scattered light that depends on the profile angle only, e.g. that of matt faces which are endless along one axis.

use crate::compute::basis::{RingBasis, sub_directions};
use crate::compute::direction::{Dir, Facade};
use std::f64::consts::{FRAC_PI_2, PI};

/// Luminance coefficient q of scattered transmitted light as a function of the profile angle ψ of its direction of
/// undeviated light.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfileLight {
    /// Whether the profile angle is measured to the right (faces endless along y) instead of upwards (along x).
    pub upright: bool,
    /// Values of q in bands of equal width over ψ from −90° to 90°, the first and the last band half as wide. \[1/sr\]
    pub q: Vec<f64>,
    /// Estimated absolute error of the share of the incident light that is transmitted scattered.
    pub error: f64,
}

/// Number of points along either side of a cell from which its mean is taken. Chosen; held to 1e-3 of the light by the
/// test `shares_are_those_of_the_cells`.
const POINTS: usize = 6;

impl ProfileLight {
    /// Returns the borders of the bands in the profile angle, rising; one more than there are bands. \[rad\]
    pub fn borders(bands: usize) -> impl Iterator<Item = f64> {
        let step = PI / (bands.max(2) - 1) as f64;
        (0..=bands).map(move |k| ((k as f64 - 0.5) * step - FRAC_PI_2).clamp(-FRAC_PI_2, FRAC_PI_2))
    }

    /// Returns the profile angle of a direction, measured as for these bands. \[rad\]
    pub fn angle(&self, direction: Dir<Facade>) -> f64 {
        Self::angle_of(self.upright, direction)
    }

    /// Returns the profile angle of a direction, to the right if `upright`, else upwards. \[rad\]
    pub fn angle_of(upright: bool, direction: Dir<Facade>) -> f64 {
        let v = direction.vector();
        if upright { v.x } else { v.y }.atan2(v.z)
    }

    /// Returns the index of the band, out of `bands`, that contains a profile angle. \[rad\]
    pub fn band(angle: f64, bands: usize) -> usize {
        ((angle + FRAC_PI_2) / PI * (bands - 1) as f64).round().max(0.0) as usize
    }

    /// Returns the index of the band that contains a direction.
    pub fn band_of(&self, direction: Dir<Facade>) -> usize {
        Self::band(self.angle(direction), self.q.len()).min(self.q.len().saturating_sub(1))
    }

    /// Returns q in the direction of undeviated light `direction`. \[1/sr\]
    pub fn at(&self, direction: Dir<Facade>) -> f64 {
        self.q.get(Self::band(self.angle(direction), self.q.len())).copied().unwrap_or(0.0)
    }

    /// Returns the bands that each cell overlaps, with their shares: the mean [`Self::on`] of a cell is their weighted
    /// sum for any q in `bands` bands.
    pub fn shares_on(upright: bool, bands: usize, cells: &RingBasis) -> Vec<Vec<(usize, f64)>> {
        let of = |cell| {
            let mut shares: Vec<(usize, f64)> = Vec::new();
            for direction in sub_directions(&cell, POINTS) {
                let band = Self::band(Self::angle_of(upright, direction), bands);
                let each = 1.0 / (POINTS * POINTS) as f64;
                match shares.iter_mut().find(|(known, _)| *known == band) {
                    Some((_, sum)) => *sum += each,
                    None => shares.push((band, each)),
                }
            }
            shares.retain(|(band, _)| *band < bands);
            shares
        };
        cells.cells().map(of).collect()
    }

    /// Returns the share of the incident light that is transmitted scattered, 0 … 1.
    pub fn share(&self) -> f64 {
        Self::weights(self.q.len()).zip(&self.q).map(|(weight, q)| weight * q).sum()
    }

    /// Returns the difference from `other` as a share of the incident light: Σ |q − q′| over the bands, weighted.
    pub fn difference(&self, other: &Self) -> f64 {
        let differences = self.q.iter().zip(&other.q).map(|(a, b)| (a - b).abs());
        Self::weights(self.q.len()).zip(differences).map(|(weight, difference)| weight * difference).sum()
    }

    /// Returns the projected solid angles of the bands: on a line of constant ψ, ∫ √(1 − x²) dx = π/2, and projected
    /// solid angle is that times cosψ dψ. \[sr\]
    fn weights(bands: usize) -> impl Iterator<Item = f64> {
        let sines: Vec<f64> = Self::borders(bands).map(f64::sin).collect();
        (0..bands).map(move |k| FRAC_PI_2 * (sines[k + 1] - sines[k]))
    }

    /// Returns the mean of q over each of `cells`, accurate to about 0.1 % of the largest. \[1/sr\]
    pub fn on(&self, cells: &RingBasis) -> Vec<f64> {
        let mean = |cell| {
            let sum: f64 = sub_directions(&cell, POINTS).map(|d| self.at(d)).sum();
            sum / (POINTS * POINTS) as f64
        };
        cells.cells().map(mean).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_those_of_the_cells() {
        let even = ProfileLight { upright: false, q: vec![0.5 / PI; 181], error: 0.0 };
        assert!((even.share() - 0.5).abs() < 1e-12);
        let upwards: Vec<f64> = (0..721).map(|k| if k > 360 { f64::from(k - 360) / 1000.0 } else { 0.0 }).collect();
        let cells = RingBasis::even(3_f64.to_radians());
        for upright in [false, true] {
            let light = ProfileLight { upright, q: upwards.clone(), error: 0.0 };
            let on = light.on(&cells);
            let sum: f64 = on.iter().zip(cells.projected_solid_angles()).map(|(q, w)| q * w).sum();
            assert!((sum / light.share() - 1.0).abs() < 1e-3, "{sum} {}", light.share());
            let shares = ProfileLight::shares_on(upright, upwards.len(), &cells);
            for (mean, shares) in on.iter().zip(&shares) {
                let by_shares: f64 = shares.iter().map(|(band, share)| share * upwards[*band]).sum();
                assert!((by_shares - mean).abs() < 1e-12);
            }
            let up = Dir::from_theta_phi(0.7, if upright { 0.0 } else { FRAC_PI_2 });
            let down = Dir::from_theta_phi(0.7, if upright { PI } else { -FRAC_PI_2 });
            assert!((light.at(up) - 0.7_f64.to_degrees() / 0.25 / 1000.0).abs() < 1e-3 && light.at(down) == 0.0);
        }
    }
}
