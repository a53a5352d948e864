//! Difference of two indicatrices as the share of flux in wrong directions, on cells of 7.5°, both slightly smoothed,
//! so that a lobe displaced by a fraction of its width counts in part.

use super::grid::Grid;
use super::superpose::sub_patches;

/// Angular size of the cells on which the fluxes of two indicatrices are compared. \[°\] Chosen: defines the figure,
/// which other sizes would change; `tests/compute/incidence_schemes` compares with the exact indicatrix on cells of
/// this size.
const CELLS: f64 = 7.5;

/// Comparison of indicatrices on the same emergent cells by the share of flux in wrong directions.
#[derive(Debug, Clone)]
pub struct Judge {
    compare: Grid,
    /// Projected solid angle of every cell \[sr\], and its shares in four cells of the comparison.
    shares: Vec<(f64, [(usize, f64); 4])>,
}

impl Judge {
    /// Creates the comparison for indicatrices on the emergent cells `cells`.
    pub fn new(cells: &Grid) -> Self {
        let compare = Grid::new(&sub_patches(CELLS.to_radians()));
        let first = |ring| compare.basis().first_cell(ring);
        let around = |d| compare.around_rings(d).map(|(ring, sector, _, w)| (first(ring) + sector, w));
        let shares = cells.centre.iter().zip(&cells.projected).map(|(&d, &w)| (w, around(d))).collect();
        Self { compare, shares }
    }

    /// Returns q as means over the cells of the comparison, blurred. \[1/sr\]
    fn picture(&self, q: &[f64]) -> Vec<f64> {
        let mut mean = vec![0.0; self.compare.projected.len()];
        for (q, (projected, around)) in q.iter().zip(&self.shares) {
            around.iter().for_each(|&(cell, w)| mean[cell] += w * q * projected);
        }
        mean.iter_mut().zip(&self.compare.projected).for_each(|(flux, w)| *flux /= w);
        self.compare.blurred(&mean)
    }

    /// Returns the share of flux that the indicatrix `q` has in wrong directions: ½∫|q − q₀|cosθ dω / τ₀ with the true
    /// indicatrix q₀ = `truth`, both \[1/sr\] on the cells of the comparison, smoothed; `None` if τ₀ = 0.
    pub fn misplaced(&self, q: &[f64], truth: &[f64]) -> Option<f64> {
        let (q, truth) = (self.picture(q), self.picture(truth));
        let weights = &self.compare.projected;
        let tau: f64 = truth.iter().zip(weights).map(|(q, w)| q * w).sum();
        let difference: f64 = q.iter().zip(&truth).zip(weights).map(|((a, b), w)| (a - b).abs() * w).sum();
        (tau > 0.0).then(|| 0.5 * difference / tau)
    }
}
