//! Flux matrices of systems that are symmetric left to right, as two matrices of half the size.
//!
//! Light is divided into an even part (equal in mirror-image cells) and an odd one (opposite in them). A symmetric
//! system does not mix the two, so that products and inverses of matrices cost a quarter.

use crate::compute::system::measure::OneSide;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::PermRef;
use faer::{Mat, Par};
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

    /// Whether the data of a layer, for light from outside and from inside, are symmetric for the mirror images `image`
    /// of the cells. `weight`: projected solid angles of the cells. \[sr\]
    pub fn fits(image: &[usize], weight: &[f64], [front, back]: &[OneSide; 2]) -> bool {
        let n = image.len();
        [&front.transmitted, &front.reflected, &back.transmitted, &back.reflected].into_iter().all(|q| {
            (0..n).filter(|&i| i <= image[i]).all(|i| {
                let unlike = |o: usize| (q[i * n + o] - q[image[i] * n + image[o]]).abs() * weight[o];
                (0..n).map(unlike).sum::<f64>() <= UNLIKE
            })
        })
    }

    /// Returns the even and the odd part of a matrix given by its entries `at(row, column)`.
    pub fn matrix(&self, at: impl Fn(usize, usize) -> f64) -> [Part; 2] {
        let (n, m) = (self.members.len(), self.pairs);
        [Part::new(n, |r, c| self.sum(&at, r, c, 1.0)), Part::new(m, |r, c| self.sum(&at, r, c, -1.0))]
    }

    /// Returns the even and the odd part of a matrix given by its diagonal `at(row)`.
    pub fn diagonal(&self, at: impl Fn(usize) -> f64) -> [Part; 2] {
        let whole = |row: usize, column: usize| if row == column { at(row) } else { 0.0 };
        let part = |n: usize, sign: f64| Part::Diagonal((0..n).map(|k| self.sum(&whole, k, k, sign)).collect());
        [part(self.members.len(), 1.0), part(self.pairs, -1.0)]
    }

    /// Returns the entry of a pair (`row`) for light of another (`column`) in the even (`sign` 1) or odd part (−1) of
    /// the matrix with the entries `at(row, column)`.
    fn sum(&self, at: &impl Fn(usize, usize) -> f64, row: usize, column: usize, sign: f64) -> f64 {
        let ([a, b], [c, d]) = (self.members[row], self.members[column]);
        (at(a, c) + at(b, d) + sign * (at(a, d) + at(b, c))) * 0.5 * self.factor(row) * self.factor(column)
    }

    /// Returns the normalisation of a pair: 1, or 1/√2 for a cell that is its own image, which sums over pairs count
    /// twice.
    fn factor(&self, member: usize) -> f64 {
        if member < self.pairs { 1.0 } else { FRAC_1_SQRT_2 }
    }

    /// Returns the entry (`row`, `column`) of the whole matrix from its even and odd part.
    pub fn entry(&self, [even_part, odd_part]: [&Part; 2], row: usize, column: usize) -> f64 {
        let ((r, sign_r), (c, sign_c)) = (self.of[row], self.of[column]);
        let even = |member: usize| if member < self.pairs { FRAC_1_SQRT_2 } else { 1.0 };
        let odd = if sign_r * sign_c == 0.0 { 0.0 } else { sign_r * sign_c * odd_part.entry(r, c) };
        even_part.entry(r, c) * even(r) * even(c) + odd
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

/// Even or odd part of a flux matrix. Panes keep the directions of light: of a matrix without entries beside its diagonal
/// only the diagonal is stored, which makes products with it as quick as sums.
pub(super) enum Part {
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

    /// Returns the matrix product self · other: the effect of `other`, then of `self`, on light.
    pub fn times(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::Diagonal(a), Self::Diagonal(b)) => Self::Diagonal(a.iter().zip(b).map(|(a, b)| a * b).collect()),
            (Self::Diagonal(a), Self::Full(b)) => Self::Full(Mat::from_fn(a.len(), a.len(), |r, c| a[r] * b[(r, c)])),
            (Self::Full(a), Self::Diagonal(b)) => Self::Full(Mat::from_fn(b.len(), b.len(), |r, c| a[(r, c)] * b[c])),
            (Self::Full(a), Self::Full(b)) => Self::Full(a * b),
        }
    }

    /// Returns the sum of both matrices.
    pub fn plus(self, other: Self) -> Self {
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

    /// Returns (1 − self)⁻¹, the sum of the geometric series of reflections, factorised for its application.
    pub fn series(self) -> Series {
        match self {
            Self::Diagonal(list) => {
                Series::Diagonal(Self::Diagonal(list.into_iter().map(|r| 1.0 / (1.0 - r)).collect()))
            }
            Self::Full(mut factors) => {
                let n = factors.nrows();
                for (c, column) in factors.col_iter_mut().enumerate() {
                    for (r, entry) in column.iter_mut().enumerate() {
                        *entry = if r == c { 1.0 } else { 0.0 } - *entry;
                    }
                }
                let [mut rows, mut rows_back] = [vec![0; n], vec![0; n]];
                let memory = factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Default::default());
                factor::lu_in_place(
                    factors.as_mut(),
                    &mut rows,
                    &mut rows_back,
                    Par::Seq,
                    MemStack::new(&mut MemBuffer::new(memory)),
                    Default::default(),
                );
                Series::Full { factors, rows: [rows, rows_back] }
            }
        }
    }

    /// Returns the sum over the rows of every column, weighted by `weights`, one per pair of cells.
    pub fn weighted(&self, weights: &[f64]) -> Vec<f64> {
        match self {
            Self::Diagonal(list) => list.iter().zip(weights).map(|(entry, weight)| entry * weight).collect(),
            Self::Full(matrix) => {
                let n = weights.len();
                (0..n).map(|i| (0..n).map(|k| matrix[(k, i)] * weights[k]).sum()).collect()
            }
        }
    }
}

/// Sum of all reflections between two layers, (1 − R)⁻¹.
pub(super) enum Series {
    /// The diagonal of (1 − R)⁻¹.
    Diagonal(Part),
    /// Triangular factors L and U of 1 − R in the place of one matrix, and the order of its rows with its inverse.
    Full { factors: Mat<f64>, rows: [Vec<usize>; 2] },
}

impl Series {
    /// Returns (1 − R)⁻¹ · `light`: the light itself plus all light that it becomes by reflections between the layers.
    pub fn of(&self, light: Part) -> Part {
        let (factors, [rows, rows_back]) = match self {
            Self::Diagonal(series) => return series.times(&light),
            Self::Full { factors, rows } => (factors.as_ref(), rows),
        };
        let n = factors.nrows();
        let mut light = match light {
            Part::Full(light) => light,
            Part::Diagonal(light) => Mat::from_fn(n, n, |r, c| if r == c { light[r] } else { 0.0 }),
        };
        let rows = PermRef::new_checked(rows, rows_back, n);
        let memory = solve::solve_in_place_scratch::<usize, f64>(n, n, Par::Seq);
        let mut memory = MemBuffer::new(memory);
        solve::solve_in_place(factors, factors, rows, light.as_mut(), Par::Seq, MemStack::new(&mut memory));
        Part::Full(light)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::linalg::solvers::Solve as _;

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
                let product_part = [0, 1].map(|k| fa[k].times(&fb[k]));
                let shares = [0.5, 0.5, 0.2, 0.7, 0.2];
                let sums = halves.unfolded(&product_part[0].weighted(&halves.list(|k| shares[k])));
                let both = |of: fn(Part, Part) -> Part| {
                    let ([even_a, odd_a], [even_b, odd_b]) = (part(a), part(b));
                    [of(even_a, even_b), of(odd_a, odd_b)]
                };
                let [sum, series_part] = [both(Part::plus), both(|a, b| a.series().of(b))];
                let entry = |[even, odd]: &[Part; 2], r, c| halves.entry([even, odd], r, c);
                for c in 0..5 {
                    for r in 0..5 {
                        let at = format!("{name_a}, {name_b}, {r}, {c}");
                        assert!((entry(&fa, r, c) - a[(r, c)]).abs() < 1e-15, "{at}");
                        assert!((entry(&sum, r, c) - a[(r, c)] - b[(r, c)]).abs() < 1e-15, "{at}");
                        assert!((entry(&product_part, r, c) - product[(r, c)]).abs() < 1e-15, "{at}");
                        assert!((entry(&series_part, r, c) - series[(r, c)]).abs() < 1e-14, "{at}");
                    }
                    let whole: f64 = (0..5).map(|k| product[(k, c)] * shares[k]).sum();
                    assert!((sums[c] - whole).abs() < 1e-15, "{name_a}, {name_b}, {c}");
                }
                let is_straight = |part: &Part| matches!(part, Part::Diagonal(_));
                assert_eq!(is_straight(&fa[0]), name_a.starts_with("straight"));
            }
        }
        assert_eq!(Halves::new(&IMAGE).pairs, 2);
    }
}
