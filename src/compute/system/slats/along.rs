//! Change of the direction cosine x along the slats when rough mirrors spread light: a diffusion that is reciprocal and
//! conserves energy.
//!
//! On a line of constant profile angle projected solid angle is √(1 − x²) dx (see `profile_weights`), which is also the
//! distribution of one coordinate of a point that is uniform on the unit sphere of four dimensions. A random step on
//! that sphere hence changes x into x′ with a density that is symmetric for that measure, and steps add up: the
//! variances of all mirrors that a ray meets add up to that of one step. The heat kernel is used, K(x, x′) = (2/π) Σ
//! e^(−n(n+2)σ²/2) Uₙ(x) Uₙ(x′) with the Chebyshev polynomials of the second kind (R. Askey, "Orthogonal Polynomials
//! and Special Functions", SIAM 1975); near x = 0 it is a normal distribution of standard deviation σ. It is computed
//! here as a Markov chain between bins, so that the bins' sums are exact.

use super::profile_weights::primitive;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use std::f64::consts::PI;

/// Number of bins of the direction cosine x along the slats, of equal width in its angle: 1.5°. Chosen; held to 2e-3 by
/// the test `kernels_keep_energy_and_are_those_of_the_sphere`.
pub(super) const BINS: usize = 120;
/// Maximum number of kernels (levels of variance). Chosen: memory and cost; between kernels the variance is
/// interpolated. Held to 0.03 of the mean direction by the test `a_rough_sheet_scatters_by_steps_on_spheres` of
/// `rough`.
const LEVELS: i32 = 8;
/// Variance from which the result no longer depends on the original direction. \[rad²\] The term that decays most
/// slowly, U₁, is then e^(−3·8/2) ≈ 6e-6.
const ALL: f64 = 8.0;
/// Variance below which the spread along the slats is finer than the bins. \[rad²\] A standard deviation of 0.3°, a
/// fifth of a bin.
const NONE: f64 = 3e-5;

/// Kernels by which light spreads between bins of the direction cosine x along the slats, in the order of rising
/// variance.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Along {
    /// Limits of the bins of x, −1 … 1, one more than there are bins.
    pub(super) edges: Vec<f64>,
    /// Measure ∫ √(1 − x²) dx of each bin.
    pub(super) measure: Vec<f64>,
    /// Pairs of variance \[rad²\] and kernel, a matrix row by row: ∫∫ K over two bins, divided by the measures of both.
    pub(super) levels: Vec<(f64, Vec<f64>)>,
}

impl Along {
    /// Creates the kernels for mirrors whose smallest squared spread is `smallest`. \[rad²\]
    pub(super) fn new(smallest: f64) -> Self {
        let edges: Vec<f64> = (0..=BINS).map(|k| -(PI * k as f64 / BINS as f64).cos()).collect();
        let measure: Vec<f64> = edges.windows(2).map(|pair| primitive(pair[1]) - primitive(pair[0])).collect();
        let first = smallest.max(NONE);
        // Times that the variance doubles from one level to the next.
        let octaves = (ALL / first).log2().max(1.0).ceil() as i32;
        let stride = (octaves + LEVELS - 2) / (LEVELS - 1);
        // So many halvings make the first step small enough for all its probabilities to be positive.
        let halvings = (first / 5e-5).log2().ceil().max(0.0) as i32;
        let mut chain = step(&measure, 0.5 * first / 2_f64.powi(halvings));
        (0..halvings).for_each(|_| chain = twice(&chain));
        let mut levels = vec![(first, density(&chain, &measure))];
        let mut variance = first;
        while variance < ALL {
            for _ in 0..stride {
                chain = twice(&chain);
                variance *= 2.0;
            }
            levels.push((variance, density(&chain, &measure)));
        }
        Self { edges, measure, levels }
    }

    /// Returns the index of the level below a variance \[rad²\] and the weight, 0 … 1, of the level above, so that the
    /// weighted mean of both levels is the variance.
    pub(super) fn place(&self, variance: f64) -> (usize, f64) {
        let above = self.levels.partition_point(|(level, _)| *level <= variance).clamp(1, self.levels.len() - 1);
        let (low, high) = (self.levels[above - 1].0, self.levels[above].0);
        (above - 1, ((variance - low) / (high - low)).clamp(0.0, 1.0))
    }
}

/// Returns the matrix I + t L of a diffusion step of duration `time`, made symmetric by the square roots of the bins'
/// measures, where L is the Laplacian (sin²χ p′)′/sin²χ of x = −cosχ.
fn step(measure: &[f64], time: f64) -> Mat<f64> {
    let width = PI / BINS as f64;
    let mut matrix = Mat::from_fn(BINS, BINS, |i, j| f64::from(u8::from(i == j)));
    for k in 1..BINS {
        let flow = time * (width * k as f64).sin().powi(2) / width;
        let (a, b) = (measure[k - 1], measure[k]);
        matrix[(k - 1, k - 1)] -= flow / a;
        matrix[(k, k)] -= flow / b;
        matrix[(k - 1, k)] += flow / (a * b).sqrt();
        matrix[(k, k - 1)] += flow / (a * b).sqrt();
    }
    matrix
}

fn twice(chain: &Mat<f64>) -> Mat<f64> {
    let mut product = Mat::zeros(BINS, BINS);
    matmul(&mut product, Accum::Replace, chain, chain, 1.0, Par::Seq);
    // Symmetric to the last bit.
    Mat::from_fn(BINS, BINS, |i, j| 0.5 * (product[(i, j)] + product[(j, i)]))
}

fn density(chain: &Mat<f64>, measure: &[f64]) -> Vec<f64> {
    let of = |i: usize, j: usize| chain[(i, j)].max(0.0) / (measure[i] * measure[j]).sqrt();
    (0..BINS).flat_map(|i| (0..BINS).map(move |j| of(i, j))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_keep_energy_and_are_those_of_the_sphere() {
        for sigma in [0.3_f64, 2.0, 15.0, 45.0] {
            let along = Along::new(sigma.to_radians().powi(2));
            for (variance, kernel) in &along.levels {
                for (i, row) in kernel.chunks(BINS).enumerate() {
                    let sum: f64 = row.iter().zip(&along.measure).map(|(k, m)| k * m).sum();
                    assert!((sum - 1.0).abs() < 1e-9, "{sigma} {variance} {i}: {sum}");
                    assert!(row.iter().enumerate().all(|(j, k)| *k == kernel[j * BINS + i] && *k >= 0.0));
                }
                // U₁(x) = 2x is an eigenfunction, of e^(−3σ²/2).
                let middle = |k: usize| {
                    let cube = |x: f64| -(1.0 - x * x).max(0.0).powf(1.5) / 3.0;
                    (cube(along.edges[k + 1]) - cube(along.edges[k])) / along.measure[k]
                };
                let mean =
                    |i: usize| -> f64 { (0..BINS).map(|j| kernel[i * BINS + j] * along.measure[j] * middle(j)).sum() };
                for i in [BINS / 8, BINS / 3, BINS - 20] {
                    let exact = (-1.5 * variance).exp() * middle(i);
                    assert!((mean(i) - exact).abs() < 2e-3, "{sigma} {variance} {i}: {} {exact}", mean(i));
                }
            }
            assert!(along.levels.len() <= LEVELS as usize + 1, "{}", along.levels.len());
        }
    }
}
