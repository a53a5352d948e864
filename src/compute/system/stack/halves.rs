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
        Flux { even: Part::new(n, |r, c| sums(r, c, 1.0)), odd: Part::new(m, |r, c| sums(r, c, -1.0)) }
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
        let odd = if sign_r * sign_c == 0.0 { 0.0 } else { sign_r * sign_c * flux.odd.entry(r, c) };
        flux.even.entry(r, c) * even(r) * even(c) + odd
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
    even: Part,
    odd: Part,
}

impl Flux {
    /// Returns the matrix product self · other: the effect of `other`, then of `self`, on light.
    pub fn times(&self, other: &Self) -> Self {
        Self { even: self.even.times(&other.even), odd: self.odd.times(&other.odd) }
    }

    /// Returns the sum of both matrices.
    pub fn plus(self, other: Self) -> Self {
        Self { even: self.even.plus(other.even), odd: self.odd.plus(other.odd) }
    }

    /// Returns (1 − self)⁻¹, the sum of the geometric series of reflections, factorised for its application.
    pub fn series(self) -> Series {
        Series { even: self.even.series(), odd: self.odd.series() }
    }

    /// Returns the sum over the rows of every column, weighted by `weights`, one per pair of cells.
    pub fn weighted(&self, weights: &[f64]) -> Vec<f64> {
        self.even.weighted(weights)
    }
}

/// Sum of all reflections between two layers, (1 − R)⁻¹.
pub(super) struct Series {
    even: PartSeries,
    odd: PartSeries,
}

impl Series {
    /// Returns (1 − R)⁻¹ · `light`: the light itself plus all light that it becomes by reflections between the layers.
    pub fn of(&self, light: Flux) -> Flux {
        Flux { even: self.even.of(light.even), odd: self.odd.of(light.odd) }
    }
}

/// Square matrix. Panes keep the directions of light: of a matrix without entries beside its diagonal only the diagonal
/// is stored, which makes products with it as quick as sums.
enum Part {
    Diagonal(Vec<f64>),
    Full(Mat<f64>),
}

impl Part {
    /// Creates a matrix of `n` rows and columns from its entries `at(row, column)`.
    fn new(n: usize, at: impl Fn(usize, usize) -> f64) -> Self {
        if (0..n).all(|c| (0..n).all(|r| r == c || at(r, c) == 0.0)) {
            Self::Diagonal((0..n).map(|k| at(k, k)).collect())
        } else {
            Self::Full(Mat::from_fn(n, n, at))
        }
    }

    fn entry(&self, row: usize, column: usize) -> f64 {
        match self {
            Self::Full(matrix) => matrix[(row, column)],
            Self::Diagonal(list) if row == column => list[row],
            Self::Diagonal(_) => 0.0,
        }
    }

    fn times(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::Diagonal(a), Self::Diagonal(b)) => Self::Diagonal(a.iter().zip(b).map(|(a, b)| a * b).collect()),
            (Self::Diagonal(a), Self::Full(b)) => Self::Full(Mat::from_fn(a.len(), a.len(), |r, c| a[r] * b[(r, c)])),
            (Self::Full(a), Self::Diagonal(b)) => Self::Full(Mat::from_fn(b.len(), b.len(), |r, c| a[(r, c)] * b[c])),
            (Self::Full(a), Self::Full(b)) => Self::Full(a * b),
        }
    }

    fn plus(self, other: Self) -> Self {
        match (self, other) {
            (Self::Diagonal(a), Self::Diagonal(b)) => Self::Diagonal(a.iter().zip(&b).map(|(a, b)| a + b).collect()),
            (Self::Diagonal(list), Self::Full(mut matrix)) | (Self::Full(mut matrix), Self::Diagonal(list)) => {
                for (k, entry) in list.into_iter().enumerate() {
                    matrix[(k, k)] += entry;
                }
                Self::Full(matrix)
            }
            (Self::Full(mut a), Self::Full(b)) => {
                a += &b;
                Self::Full(a)
            }
        }
    }

    fn series(self) -> PartSeries {
        match self {
            Self::Diagonal(list) => {
                PartSeries::Diagonal(Self::Diagonal(list.into_iter().map(|r| 1.0 / (1.0 - r)).collect()))
            }
            Self::Full(matrix) => {
                let n = matrix.nrows();
                PartSeries::Full((Mat::<f64>::identity(n, n) - matrix).partial_piv_lu())
            }
        }
    }

    fn weighted(&self, weights: &[f64]) -> Vec<f64> {
        match self {
            Self::Diagonal(list) => list.iter().zip(weights).map(|(entry, weight)| entry * weight).collect(),
            Self::Full(matrix) => {
                let n = weights.len();
                (0..n).map(|i| (0..n).map(|k| matrix[(k, i)] * weights[k]).sum()).collect()
            }
        }
    }
}

/// Factorised (1 − R)⁻¹ of one part.
enum PartSeries {
    /// The diagonal of (1 − R)⁻¹.
    Diagonal(Part),
    Full(PartialPivLu<f64>),
}

impl PartSeries {
    fn of(&self, light: Part) -> Part {
        match (self, light) {
            (Self::Diagonal(series), light) => series.times(&light),
            (Self::Full(lu), Part::Full(mut light)) => {
                lu.solve_in_place(&mut light);
                Part::Full(light)
            }
            (Self::Full(lu), Part::Diagonal(light)) => {
                let n = light.len();
                let mut light = Mat::from_fn(n, n, |r, c| if r == c { light[r] } else { 0.0 });
                lu.solve_in_place(&mut light);
                Part::Full(light)
            }
        }
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

    /// Light that keeps its direction, in cells that are images of each other alike.
    fn straight(seed: f64) -> impl Fn(usize, usize) -> f64 {
        move |r, c| if r == c { 0.1 * seed + 0.05 * r.min(IMAGE[r]) as f64 } else { 0.0 }
    }

    #[test]
    fn products_sums_and_series_are_those_of_whole_matrices() {
        let list = [
            ("scattered 1", Mat::from_fn(5, 5, mirrored(1.3))),
            ("scattered 2", Mat::from_fn(5, 5, mirrored(2.1))),
            ("straight 1", Mat::from_fn(5, 5, straight(1.3))),
            ("straight 2", Mat::from_fn(5, 5, straight(2.1))),
        ];
        for ((name_a, a), (name_b, b)) in list.iter().flat_map(|a| list.iter().map(move |b| (a, b))) {
            let product = a * b;
            let series = (Mat::<f64>::identity(5, 5) - a).partial_piv_lu().solve(b);
            for halves in [Halves::new(&IMAGE), Halves::none(5)] {
                let part = |whole: &Mat<f64>| halves.matrix(|r, c| whole[(r, c)]);
                let (fa, fb) = (part(a), part(b));
                let product_part = fa.times(&fb);
                let shares = [0.5, 0.5, 0.2, 0.7, 0.2];
                let sums = halves.unfolded(&product_part.weighted(&halves.list(|k| shares[k])));
                let sum = part(a).plus(part(b));
                let series_part = part(a).series().of(part(b));
                for c in 0..5 {
                    for r in 0..5 {
                        let at = format!("{name_a}, {name_b}, {r}, {c}");
                        assert!((halves.entry(&fa, r, c) - a[(r, c)]).abs() < 1e-15, "{at}");
                        assert!((halves.entry(&sum, r, c) - a[(r, c)] - b[(r, c)]).abs() < 1e-15, "{at}");
                        assert!((halves.entry(&product_part, r, c) - product[(r, c)]).abs() < 1e-15, "{at}");
                        assert!((halves.entry(&series_part, r, c) - series[(r, c)]).abs() < 1e-14, "{at}");
                    }
                    let whole: f64 = (0..5).map(|k| product[(k, c)] * shares[k]).sum();
                    assert!((sums[c] - whole).abs() < 1e-15, "{name_a}, {name_b}, {c}");
                }
                let is_straight = |part: &Part| matches!(part, Part::Diagonal(_));
                assert_eq!(is_straight(&fa.even), name_a.starts_with("straight"));
            }
        }
        assert_eq!(Halves::new(&IMAGE).pairs, 2);
    }
}
