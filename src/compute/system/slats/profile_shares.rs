//! Transmittance, reflectance and absorptance of slats at single profile angles, without cells.

use super::array::SlatArray;
use super::balance::Balance;
use super::direct::Direct;
use super::flows::{Transport, index};
use super::outline::SlatSection;
use super::profile_weights::ProfileGrid;
use super::transport::beam;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::system::measure::Side;

/// Shares of the incident light of one profile angle that slats transmit, reflect and absorb.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileShares {
    /// Share that passes without touching a slat.
    pub direct: f64,
    /// Direct-hemispherical transmittance, including the direct share.
    pub transmitted: f64,
    /// Direct-hemispherical reflectance.
    pub reflected: f64,
    /// Absorptance, computed independently of transmittance and reflectance.
    pub absorbed: f64,
}

/// Number of coarse strips per slat. Chosen; held by
/// `tests/compute/goniophotometer_slats.rs::single_directions_are_those_of_the_references` (0.0015).
const PARTS: usize = 48;
/// Step of the profile angle: 0.25°. \[rad\] Chosen: cost; linear between steps, to (0.25°)²/8 ≈ 2e-6 of the second
/// derivative. Held by the same test as [`PARTS`].
const STEP: f64 = std::f64::consts::PI / 720.0;

impl SlatArray {
    /// Computes the shares for light from `side` at the profile angles `psi` (inside −π/2 … π/2) \[rad\], to about
    /// 1e-4.
    ///
    /// # Errors
    /// Returns [`Cancelled`] if `progress` is cancelled.
    pub fn profile_shares(
        &self,
        side: Side,
        psi: &[f64],
        seed: u64,
        progress: &dyn Progress,
    ) -> Result<Vec<ProfileShares>, Cancelled> {
        let grid = ProfileGrid::new(STEP);
        let hat: Vec<f64> = (0..grid.len()).map(|node| grid.hat(node)).collect();
        let section = SlatSection::new(self, PARTS);
        let transport = Transport::new(&section, grid, seed, progress)?;
        let balance = Balance::new(&section, &transport, &hat);
        let direct = Direct::without_knots(self);
        let one = |&psi: &f64| {
            let node = beam(&section, psi, side, seed);
            let (incident, mirrored_light) = (&node.incident[index(side)], &node.mirrored[index(side)]);
            let cosine = psi.cos();
            let sum = |weights: &[f64]| weights.iter().zip(incident).map(|(a, b)| a * b).sum::<f64>() / cosine;
            // Faces leave to the inside first, then to the outside.
            let [inside, outside] = [sum(&balance.leaves[0]), sum(&balance.leaves[1])];
            let (on, back) = if side == Side::Front { (inside, outside) } else { (outside, inside) };
            let mirrored = |lobes: &[super::flows::Lobe]| lobes.iter().map(|l| l.width).sum::<f64>() / cosine;
            let share = direct.share(psi);
            ProfileShares {
                direct: share,
                transmitted: share + on + mirrored(&mirrored_light.through),
                reflected: back + mirrored(&mirrored_light.back),
                absorbed: sum(&balance.absorbed),
            }
        };
        Ok(psi.iter().map(one).collect())
    }
}
