//! Estimate of a function of direction from its means over cells, with the standard error of the estimate.
//! Gaussian-process regression with integrals as observations (Rasmussen & Williams 2006, ch. 2, 4 and 5).
//!
//! Unscattered transmission mostly depends on few angles: of slats on the profile angle alone, of panes on the angle of
//! incidence, of holes on both. The covariance is a product over the two profile angles and θ, each with its
//! correlation length. The lengths are those of the largest likelihood: with an infinite length the function does not
//! depend on that angle, and then 145 cells that overlap in the other angles resolve the one that matters far below
//! their width.

use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Facade};
use crate::compute::quadrature::gauss_legendre;
use rayon::prelude::*;

/// Correlation lengths that are tried \[rad\]; 0 stands for an infinite one. About halved from the range of the angles,
/// π, down to the width of Klems cells, 10° to 15°, below which means show nothing.
const LENGTHS: [f64; 6] = [0.0, 3.0, 1.5, 0.75, 0.4, 0.2];
/// Starting points of the search for correlation lengths, as indices of [`LENGTHS`] for the profile angle about x, the
/// profile angle about y, and θ. Chosen: cost; the search continues to neighbours as long as these are more likely.
/// Held with [`VARIANCES`] by `tests/scenes/beams_in_cells::the_truth_of_strange_files_lies_within_what_is_stated`.
const STARTS: [[usize; 3]; 7] = [[3, 0, 0], [0, 3, 0], [0, 0, 2], [3, 3, 0], [3, 0, 2], [0, 3, 2], [2, 1, 2]];
/// Prior variances of the function that are tried: half decades up to 3, since strengths and transmittances are shares
/// of 1.
const VARIANCES: [f64; 7] = [3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0, 3.0];
/// Numbers of points across and along a cell for its mean, and minimum width of the cell in φ \[rad\] for them. Chosen:
/// cost; the error by few points is stated in the second of the `NOISE`.
const POINTS: [([usize; 2], f64); 3] = [([4, 8], 0.45), ([3, 5], 0.3), ([2, 3], 0.0)];

/// Direction in a cell with its weight in the cell's mean, and the angles that the covariance depends on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub(super) direction: Dir<Facade>,
    at: [f64; 3],
    weight: f64,
}

impl Point {
    /// Returns the weight of the point in the mean over its cell.
    pub(super) fn weight(&self) -> f64 {
        self.weight
    }

    /// Returns the point with weight 1.
    pub(super) fn whole(self) -> Self {
        Self { weight: 1.0, ..self }
    }
}

/// Returns the angles that the covariance depends on: profile angles about x and about y, and θ. \[rad\]
fn angles(direction: Dir<Facade>) -> [f64; 3] {
    let v = direction.vector();
    [v.y.atan2(v.z), v.x.atan2(v.z), direction.theta()]
}

/// Returns points of a cell with weights by projected solid angle; the weights add up to 1.
pub(super) fn points(basis: &RingBasis, cell: usize) -> Vec<Point> {
    let own = basis.cell(cell);
    let width = own.width * own.theta().sin();
    let fit = POINTS.iter().find(|(_, from)| width >= *from).map_or([2, 3], |(points, _)| *points);
    let [across, along] = if own.is_cap() { [1, 6] } else { fit };
    let [low, high] = [own.theta_min, own.theta_max].map(|theta| theta.sin().powi(2));
    let round = gauss_legendre(along);
    let mut list = Vec::with_capacity(across * along);
    for (s, ws) in gauss_legendre(across) {
        let theta = (low + (high - low) * s).sqrt().asin();
        for (k, &(t, wt)) in round.iter().enumerate() {
            let (t, wt) = if own.is_cap() { (k as f64 / along as f64, 1.0 / along as f64) } else { (t, wt) };
            let direction = Dir::from_theta_phi(theta, own.phi + (t - 0.5) * own.width);
            list.push(Point { direction, at: angles(direction), weight: ws * wt });
        }
    }
    list
}

/// Observation of two functions: the sum of their weighted means over points, with its standard error.
#[derive(Debug, Clone, Default)]
pub(super) struct Observation {
    /// Points at which each of the two functions contributes to the observation.
    pub(super) points: [Vec<Point>; 2],
    pub(super) value: f64,
    /// Standard error of `value`.
    pub(super) noise: f64,
}

/// Correlation lengths \[rad\] and prior variance of one function.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Covariance {
    lengths: [f64; 3],
    variance: f64,
}

impl Covariance {
    /// Returns the covariance of the function at two points, each given by its angles \[rad\]: a product of Matérn 3/2
    /// functions, which allow nearly abrupt changes of the slope, like those at a cut-off.
    fn between(&self, a: &[f64; 3], b: &[f64; 3]) -> f64 {
        let (mut product, mut sum) = (self.variance, 0.0);
        for k in 0..3 {
            if self.lengths[k] > 0.0 {
                let r = 3.0_f64.sqrt() * (a[k] - b[k]).abs() / self.lengths[k];
                product *= 1.0 + r;
                sum += r;
            }
        }
        product * (-sum).exp()
    }

    fn integral(&self, a: &[Point], b: &[Point]) -> f64 {
        a.iter().map(|p| p.weight * b.iter().map(|q| q.weight * self.between(&p.at, &q.at)).sum::<f64>()).sum()
    }

    /// Returns the covariance of the largest likelihood for observations of the function with index `of` alone.
    pub(super) fn most_likely(observations: &[Observation], of: usize) -> Self {
        let judge = |pick: [usize; 3]| -> (f64, Self) {
            let own = Self { lengths: pick.map(|k| LENGTHS[k]), variance: 1.0 };
            let unit = gram(observations, |a, b| own.integral(&a.points[of], &b.points[of]));
            let by_variance = VARIANCES.iter().filter_map(|&variance| {
                let matrix: Vec<f64> = unit.iter().map(|c| variance * c).collect();
                Some((likelihood(observations, matrix)?, Self { variance, ..own }))
            });
            by_variance.fold((f64::NEG_INFINITY, own), |best, one| if one.0 > best.0 { one } else { best })
        };
        let mut tried: Vec<([usize; 3], (f64, Self))> = STARTS.iter().map(|&pick| (pick, judge(pick))).collect();
        let best = |tried: &[([usize; 3], (f64, Self))]| {
            tried.iter().fold(tried[0], |best, one| if one.1.0 > best.1.0 { *one } else { best })
        };
        loop {
            let (at, (value, own)) = best(&tried);
            for k in 0..3 {
                for next in [at[k].wrapping_sub(1), at[k] + 1].into_iter().filter(|n| *n < LENGTHS.len()) {
                    let mut pick = at;
                    pick[k] = next;
                    if tried.iter().all(|one| one.0 != pick) {
                        tried.push((pick, judge(pick)));
                    }
                }
            }
            if best(&tried).1.0 <= value {
                return own;
            }
        }
    }
}

/// Returns the symmetric matrix with an entry for each pair of observations, row by row.
fn gram(observations: &[Observation], entry: impl Fn(&Observation, &Observation) -> f64 + Sync) -> Vec<f64> {
    let n = observations.len();
    let rows: Vec<Vec<f64>> =
        (0..n).into_par_iter().map(|i| (0..=i).map(|j| entry(&observations[i], &observations[j])).collect()).collect();
    let mut all = vec![0.0; n * n];
    for (i, row) in rows.iter().enumerate() {
        for (j, &value) in row.iter().enumerate() {
            (all[i * n + j], all[j * n + i]) = (value, value);
        }
    }
    all
}

/// Returns the lower triangular matrix L of the Cholesky decomposition LLᵀ of the matrix plus the squared errors of the
/// observations on its diagonal; `None` if rounding makes it indefinite.
fn factor(observations: &[Observation], mut matrix: Vec<f64>) -> Option<Vec<f64>> {
    let n = observations.len();
    for (i, one) in observations.iter().enumerate() {
        matrix[i * n + i] += one.noise * one.noise;
    }
    for i in 0..n {
        for j in 0..=i {
            let (upper, lower) = matrix.split_at_mut(i * n);
            let own = &mut lower[..n];
            let dot: f64 = if j < i {
                own[..j].iter().zip(&upper[j * n..j * n + j]).map(|(a, b)| a * b).sum()
            } else {
                own[..j].iter().map(|a| a * a).sum()
            };
            let rest = own[j] - dot;
            if j < i {
                own[j] = rest / upper[j * n + j];
            } else if rest > 0.0 {
                own[j] = rest.sqrt();
            } else {
                return None;
            }
        }
    }
    Some(matrix)
}

/// Solves L x = b in place.
fn forward(factor: &[f64], x: &mut [f64]) {
    let n = x.len();
    for i in 0..n {
        let dot: f64 = factor[i * n..i * n + i].iter().zip(&x[..i]).map(|(a, b)| a * b).sum();
        x[i] = (x[i] - dot) / factor[i * n + i];
    }
}

/// Solves Lᵀ x = b in place.
fn backward(factor: &[f64], x: &mut [f64]) {
    let n = x.len();
    for i in (0..n).rev() {
        x[i] /= factor[i * n + i];
        let own = x[i];
        x[..i].iter_mut().zip(&factor[i * n..i * n + i]).for_each(|(x, l)| *x -= l * own);
    }
}

/// Returns the logarithm of the likelihood of the observations, except for a constant; `None` if `matrix`, their
/// covariance, is indefinite.
fn likelihood(observations: &[Observation], matrix: Vec<f64>) -> Option<f64> {
    let n = observations.len();
    let factor = factor(observations, matrix)?;
    let mut x: Vec<f64> = observations.iter().map(|one| one.value).collect();
    forward(&factor, &mut x);
    let log: f64 = (0..n).map(|i| factor[i * n + i].ln()).sum();
    Some(-0.5 * x.iter().map(|x| x * x).sum::<f64>() - log)
}

/// Two functions of direction, estimated from observations of their means (Gaussian-process regression).
pub(super) struct MeanField {
    observations: Vec<Observation>,
    covariances: [Covariance; 2],
    factor: Vec<f64>,
    /// Squared deviation of each observation from its prediction by all others, relative to the expected one.
    surprise: Vec<f64>,
}

/// Estimated value of a function in a direction.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct At {
    pub(super) value: f64,
    /// Standard error of `value`.
    pub(super) error: f64,
    /// Weights of the observations in `value`.
    pub(super) weights: Vec<f64>,
}

impl MeanField {
    /// Fits the functions to observations; `None` if the covariance matrix of the observations is numerically
    /// indefinite.
    pub(super) fn new(observations: Vec<Observation>, covariances: [Covariance; 2]) -> Option<Self> {
        let n = observations.len();
        let entry = |a: &Observation, b: &Observation| {
            covariances.iter().enumerate().map(|(k, c)| c.integral(&a.points[k], &b.points[k])).sum()
        };
        let factor = factor(&observations, gram(&observations, entry))?;
        let mut solved: Vec<f64> = observations.iter().map(|one| one.value).collect();
        forward(&factor, &mut solved);
        backward(&factor, &mut solved);
        // Leaving one out: its residual is [C⁻¹y]ᵢ/[C⁻¹]ᵢᵢ, its variance 1/[C⁻¹]ᵢᵢ.
        let surprise = (0..n)
            .into_par_iter()
            .map(|i| {
                let mut unit = vec![0.0; n];
                unit[i] = 1.0;
                forward(&factor, &mut unit);
                solved[i] * solved[i] / unit.iter().map(|u| u * u).sum::<f64>()
            })
            .collect();
        Some(Self { observations, covariances, factor, surprise })
    }

    /// Computes the function with index `of` in a direction, with its standard error.
    pub(super) fn at(&self, of: usize, direction: Dir<Facade>) -> At {
        let (here, covariance) = (angles(direction), &self.covariances[of]);
        let covered = |one: &Observation| -> f64 {
            one.points[of].iter().map(|p| p.weight * covariance.between(&p.at, &here)).sum()
        };
        let known: Vec<f64> = self.observations.iter().map(covered).collect();
        let mut weights = known.clone();
        forward(&self.factor, &mut weights);
        let variance = covariance.variance - weights.iter().map(|w| w * w).sum::<f64>();
        backward(&self.factor, &mut weights);
        let value = weights.iter().zip(&self.observations).map(|(w, one)| w * one.value).sum();
        // Near kinks the function is less certain than the correlation length fitted to all data implies. Dark cells
        // carry no information about that and are left out.
        let light =
            || weights.iter().zip(&self.observations).zip(&self.surprise).filter(|((_, one), _)| one.value > 0.0);
        let near: f64 = light().map(|((w, _), _)| w * w).sum();
        let surprise = light().map(|((w, _), s)| w * w * s).sum::<f64>() / near.max(1e-300);
        At { value, error: (variance.max(0.0) * surprise.max(1.0)).sqrt(), weights }
    }
}
