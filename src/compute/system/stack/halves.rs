//! Flux matrices of systems that are symmetric left to right, as two matrices of half the size.
//!
//! Light is divided into an even part (equal in mirror-image cells) and an odd one (opposite in them). A symmetric
//! system does not mix the two, so that products and inverses of matrices cost a quarter.

use crate::compute::system::measure::Measured;
use faer::Mat;
use faer::linalg::solvers::{PartialPivLu, Solve};
use std::f64::consts::FRAC_1_SQRT_2;

/// Maximum difference of flux between mirror-image cells up to which a layer counts as symmetric, as a share of the
/// light of an incident cell. Chosen: the smallest error that `cfs goniophotometer` allows, above the rounding of the
/// sums (145 · 2⁻⁵² ≈ 3e-14).
const UNLIKE: f64 = 1e-6;

/// Cells of a basis grouped in pairs of mirror images.
pub(super) struct Halves {
    /// Pairs of a cell and its mirror image, followed by the cells that are their own images.
    members: Vec<[usize; 2]>,
    pairs: usize,
    /// Index of the pair of each cell, and the cell's sign in the odd part.
    of: Vec<(usize, f64)>,
}

impl Halves {
    /// Creates the pairs from the index of each cell's mirror image; if all cells are their own images, there is only
    /// the even part.
    pub fn new(image: &[usize]) -> Self {
        let pairs: Vec<[usize; 2]> = (0..image.len()).filter(|&k| k < image[k]).map(|k| [k, image[k]]).collect();
        let alone = (0..image.len()).filter(|&k| k == image[k]).map(|k| [k, k]);
        let count = pairs.len();
        let members: Vec<[usize; 2]> = pairs.into_iter().chain(alone).collect();
        let mut of = vec![(0, 0.0); image.len()];
        for (e, &[k, other]) in members.iter().enumerate() {
            let sign = if k == other { 0.0 } else { FRAC_1_SQRT_2 };
            of[k] = (e, sign);
            of[other] = (e, -sign);
        }
        Self { members, pairs: count, of }
    }

    /// Creates the division for `n` cells without symmetry: each is its own image.
    pub fn none(n: usize) -> Self {
        Self::new(&(0..n).collect::<Vec<_>>())
    }

    /// Whether the data of a layer are symmetric for the mirror images `image` of the cells.
    pub fn fits(image: &[usize], measured: &Measured) -> bool {
        let n = image.len();
        let weight = measured.emergent.projected_solid_angles();
        let [front, back] = [&measured.front, &measured.back];
        [&front.transmitted, &front.reflected, &back.transmitted, &back.reflected].into_iter().all(|q| {
            (0..n).filter(|&i| i <= image[i]).all(|i| {
                let unlike = |o: usize| (q[i * n + o] - q[image[i] * n + image[o]]).abs() * weight[o];
                (0..n).map(unlike).sum::<f64>() <= UNLIKE
            })
        })
    }

    /// Returns the even and the odd part of a matrix given by its entries `at(row, column)`.
    pub fn matrix(&self, at: impl Fn(usize, usize) -> f64) -> Flux {
        let sums = |row: usize, column: usize, sign: f64| {
            let ([a, b], [c, d]) = (self.members[row], self.members[column]);
            (at(a, c) + at(b, d) + sign * (at(a, d) + at(b, c))) * 0.5 * self.factor(row) * self.factor(column)
        };
        let (n, m) = (self.members.len(), self.pairs);
        Flux { even: Mat::from_fn(n, n, |r, c| sums(r, c, 1.0)), odd: Mat::from_fn(m, m, |r, c| sums(r, c, -1.0)) }
    }

    /// Returns the normalisation of a pair: 1, or 1/√2 for a cell that is its own image, which sums over pairs count
    /// twice.
    fn factor(&self, member: usize) -> f64 {
        if member < self.pairs { 1.0 } else { FRAC_1_SQRT_2 }
    }

    /// Returns the entry (`row`, `column`) of the whole matrix from its two parts.
    pub fn entry(&self, flux: &Flux, row: usize, column: usize) -> f64 {
        let ((r, sign_r), (c, sign_c)) = (self.of[row], self.of[column]);
        let even = |member: usize| if member < self.pairs { FRAC_1_SQRT_2 } else { 1.0 };
        let odd = if sign_r * sign_c == 0.0 { 0.0 } else { sign_r * sign_c * flux.odd[(r, c)] };
        flux.even[(r, c)] * even(r) * even(c) + odd
    }

    /// Returns the even part, one value per pair, of a list over all cells in which mirror images have the same value.
    pub fn list(&self, at: impl Fn(usize) -> f64) -> Vec<f64> {
        let one = |(e, &[a, b]): (usize, &[usize; 2])| (at(a) + at(b)) * FRAC_1_SQRT_2 * self.factor(e);
        self.members.iter().enumerate().map(one).collect()
    }

    /// Returns the list over all cells from its even part, one value per pair.
    pub fn unfolded(&self, even: &[f64]) -> Vec<f64> {
        let value = |&(e, _): &(usize, f64)| even[e] * if e < self.pairs { FRAC_1_SQRT_2 } else { 1.0 };
        self.of.iter().map(value).collect()
    }
}

/// Flux matrix of a system that is symmetric left to right, as an even and an odd part.
pub(super) struct Flux {
    even: Mat<f64>,
    odd: Mat<f64>,
}

impl Flux {
    /// Returns the matrix product self · other: the effect of `other`, then of `self`, on light.
    pub fn times(&self, other: &Self) -> Self {
        Self { even: &self.even * &other.even, odd: &self.odd * &other.odd }
    }

    /// Returns the sum of both matrices.
    pub fn plus(&self, other: &Self) -> Self {
        Self { even: &self.even + &other.even, odd: &self.odd + &other.odd }
    }

    /// Returns (1 − self)⁻¹, the sum of the geometric series of reflections, factorised for its application.
    pub fn series(&self) -> Series {
        let one = |part: &Mat<f64>| (Mat::<f64>::identity(part.nrows(), part.nrows()) - part).partial_piv_lu();
        Series { even: one(&self.even), odd: one(&self.odd) }
    }

    /// Returns the sum over the rows of every column, weighted by `weights`, one per pair of cells.
    pub fn weighted(&self, weights: &[f64]) -> Vec<f64> {
        let n = weights.len();
        (0..n).map(|i| (0..n).map(|k| self.even[(k, i)] * weights[k]).sum()).collect()
    }
}

/// Sum of all reflections between two layers, (1 − R)⁻¹.
pub(super) struct Series {
    even: PartialPivLu<f64>,
    odd: PartialPivLu<f64>,
}

impl Series {
    /// Returns (1 − R)⁻¹ · `light`: the light itself plus all light that it becomes by reflections between the layers.
    pub fn of(&self, light: &Flux) -> Flux {
        Flux { even: self.even.solve(&light.even), odd: self.odd.solve(&light.odd) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells 0–1 and 2–4 are images of each other, cell 3 its own.
    const IMAGE: [usize; 5] = [1, 0, 4, 3, 2];

    fn mirrored(seed: f64) -> impl Fn(usize, usize) -> f64 {
        let raw = move |r: usize, c: usize| 0.1 * (seed * (r * 5 + c) as f64 + seed).sin().abs();
        move |r, c| 0.5 * (raw(r, c) + raw(IMAGE[r], IMAGE[c]))
    }

    #[test]
    fn products_and_series_are_those_of_the_whole_matrix() {
        let (a, b) = (mirrored(1.3), mirrored(2.1));
        let [wa, wb] = [Mat::from_fn(5, 5, &a), Mat::from_fn(5, 5, &b)];
        let product = &wa * &wb;
        let series = (Mat::<f64>::identity(5, 5) - &product).partial_piv_lu().solve(&wa);
        for halves in [Halves::new(&IMAGE), Halves::none(5)] {
            let (fa, fb) = (halves.matrix(&a), halves.matrix(&b));
            let (p, s) = (fa.times(&fb), fa.times(&fb).series().of(&fa).plus(&fa));
            let list = [0.5, 0.5, 0.2, 0.7, 0.2];
            let sums = halves.unfolded(&p.weighted(&halves.list(|k| list[k])));
            for r in 0..5 {
                for c in 0..5 {
                    assert!((halves.entry(&fa, r, c) - a(r, c)).abs() < 1e-15);
                    assert!((halves.entry(&p, r, c) - product[(r, c)]).abs() < 1e-15);
                    assert!((halves.entry(&s, r, c) - series[(r, c)] - wa[(r, c)]).abs() < 1e-14);
                }
                let whole: f64 = (0..5).map(|k| product[(k, r)] * list[k]).sum();
                assert!((sums[r] - whole).abs() < 1e-15);
            }
        }
        assert_eq!(Halves::new(&IMAGE).pairs, 2);
    }
}
