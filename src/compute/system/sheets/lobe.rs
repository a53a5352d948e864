//! Lobe about the undeviated direction: the balanced Gaussian kernel in direction cosines, see [`super::sheet`].

use crate::compute::basis::{Cell, sub_directions};
use crate::compute::btdf::AngularTransmittance;
use crate::compute::direction::{Dir, Facade};
use crate::compute::quadrature::gauss_legendre;
use crate::compute::scaling::by_rounds;
use std::f64::consts::PI;
use std::sync::OnceLock;

/// Lobe of light about the undeviated or mirrored direction: a reciprocal Gaussian kernel in direction cosines.
#[derive(Debug, Clone)]
pub struct Lobe {
    share: AngularTransmittance,
    spread: f64,
    /// Factor d(θ) of the kernel (see [`super::sheet`]) at the middles of equal steps of sinθ; computed when it is
    /// first needed.
    factor: OnceLock<Vec<f64>>,
}

/// Direction for the lobe's kernel: direction cosines (x, y), and the factor d there.
type Point = ([f64; 2], f64);

/// Distance of points in a cell where the kernel is averaged over incident and emergent directions, in standard
/// deviations of the lobe. Chosen; held to 0.015 of the light by the test
/// `single_directions_have_their_shares_and_the_measured_mean` of `sheet`.
const STEP: f64 = 0.8;
/// Maximum number of points along either side of a cell, and of Gauss' nodes. Chosen: cost; on Klems cells, 0.52 wide
/// at most, the first limits lobes narrower than 0.52/(24 · 0.8) = 0.027, and the second no lobe that is allowed (above
/// 0.01).
const MOST: [usize; 2] = [24, 100];
/// Number of Gauss' nodes along the side of a cell: a minimum, and a number per standard deviation of its length. In
/// the middle of long sides they are 1.3 standard deviations apart. Chosen; held to 2e-4 of the light by the test
/// `a_lobe_of_one_direction_is_cut_by_cells_where_the_gaussian_is` of `sheet`.
const NODES: (f64, f64) = (2.0, 1.2);

/// Exponent x from which exp(−x) counts as 0: e⁻³⁰ ≈ 9e-14.
const MOST_EXPONENT: f64 = 30.0;

impl Lobe {
    /// Creates a lobe from its share of the incident light as a function of the polar angle, and its standard deviation
    /// along either direction cosine.
    pub const fn new(share: AngularTransmittance, spread: f64) -> Self {
        Self { share, spread, factor: OnceLock::new() }
    }

    /// Returns the lobe's share of the incident light as a function of the polar angle of incidence.
    pub const fn share(&self) -> &AngularTransmittance {
        &self.share
    }

    fn factors(&self) -> &[f64] {
        self.factor.get_or_init(|| self.balanced())
    }

    /// Computes the factor d(θ) such that the lobe carries the given share for every incidence (Sinkhorn's iteration).
    fn balanced(&self) -> Vec<f64> {
        let spread = self.spread;
        // One thread only: the threads that need it run side by side and would wait for each other.
        // Half a spread a step keeps the sums over the smooth kernel exact to 1e-8.
        let n = ((2.0 / spread).ceil() as usize).clamp(100, 1000);
        let sine = |i: usize| (i as f64 + 0.5) / n as f64;
        let kernel: Vec<f64> = (0..n * n)
            .map(|k| {
                let (a, b) = (sine(k / n), sine(k % n));
                let exponent = 0.5 * ((a - b) / spread).powi(2);
                let around = 2.0 * PI * (-exponent).exp() * scaled_bessel(a * b / (spread * spread));
                around * b / n as f64
            })
            .collect();
        let sums = |factor: &[f64]| -> Vec<f64> {
            kernel.chunks_exact(n).map(|row| row.iter().zip(factor).map(|(k, d)| k * d).sum()).collect()
        };
        let wanted: Vec<_> = (0..n).map(|i| Some(self.share.at(sine(i).asin()))).collect();
        by_rounds(sums, &wanted, 400, 1e-9, f64::INFINITY)
    }

    fn factor(&self, sine: f64) -> f64 {
        let factor = self.factors();
        let x = (sine * factor.len() as f64 - 0.5).max(0.0);
        let k = (x as usize).min(factor.len() - 2);
        let t = x - k as f64;
        (factor[k] * (1.0 - t) + factor[k + 1] * t).max(0.0)
    }

    /// Returns the direction cosines of a direction, and the kernel's factor d there.
    pub fn point(&self, d: Dir<Facade>) -> Point {
        let k = d.vector().truncate();
        ([k.x, k.y], self.factor(k.length()))
    }

    /// Returns directions distributed uniformly over a cell, dense enough for the width of the lobe.
    pub fn points(&self, cell: &Cell) -> Vec<Point> {
        let [high, wide] = sides(cell);
        let n = ((high.max(wide) / (STEP * self.spread)).ceil() as usize).clamp(1, MOST[0]);
        sub_directions(cell, n).map(|d| self.point(d)).collect()
    }

    /// Returns the mean q of the lobe over the emergent cell `to` for light with the direction of undeviated light
    /// `direction`. \[1/sr\] By Gauss' nodes in sin²θ and φ, because the cell's edge may cut the lobe where it is
    /// steepest.
    pub fn mean_about(&self, direction: Dir<Facade>, to: &Cell) -> f64 {
        let ([x, y], d) = self.point(direction);
        let [high, wide] = sides(to);
        let centre = to.centre().vector().truncate();
        let precision = 0.5 / (self.spread * self.spread);
        let distance = ((centre.x - x).hypot(centre.y - y) - high.hypot(wide)).max(0.0);
        if precision * distance * distance > MOST_EXPONENT {
            return 0.0;
        }
        let [rows, columns] = [high, wide].map(|side| {
            let nodes = (NODES.0 + NODES.1 * side / self.spread).ceil() as usize;
            gauss_nodes(nodes.clamp(1, MOST[1]))
        });
        let around: Vec<([f64; 2], f64)> = columns
            .iter()
            .map(|(t, weight)| {
                let (sin, cos) = (to.phi + to.width * (t - 0.5)).sin_cos();
                ([cos, sin], *weight)
            })
            .collect();
        let (low, high) = (to.theta_min.sin().powi(2), to.theta_max.sin().powi(2));
        let ring = |&(t, weight): &(f64, f64)| {
            let sine = (low + (high - low) * t).sqrt();
            let of = |([cos, sin], weight): &([f64; 2], f64)| {
                let (a, b) = (sine * cos - x, sine * sin - y);
                weight * (-precision * (a * a + b * b)).exp()
            };
            weight * self.factor(sine) * around.iter().map(of).sum::<f64>()
        };
        d * rows.iter().map(ring).sum::<f64>()
    }

    /// Returns the mean q of the lobe over the emergent cell `to`, averaged over the incident directions `from`.
    /// \[1/sr\]
    pub fn mean(&self, from: &[Point], to: &Cell) -> f64 {
        let exponent = |a: [f64; 2], b: [f64; 2]| {
            0.5 * ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)) / (self.spread * self.spread)
        };
        let centre = to.centre().vector().truncate();
        let middle = from[from.len() / 2].0;
        // Far cells need no points: both are smaller than their distance allows.
        let reach = (to.width * to.theta_max.sin()).max(to.theta_max.sin() - to.theta_min.sin()) + 0.25;
        if (exponent([centre.x, centre.y], middle).sqrt() - reach / self.spread).max(0.0).powi(2) > MOST_EXPONENT {
            return 0.0;
        }
        let points = self.points(to);
        let sum: f64 = from
            .iter()
            .map(|(a, d)| {
                let inner: f64 = points
                    .iter()
                    .map(|(b, e)| {
                        let x = exponent(*a, *b);
                        if x < MOST_EXPONENT { e * (-x).exp() } else { 0.0 }
                    })
                    .sum();
                d * inner
            })
            .sum();
        sum / (from.len() * points.len()) as f64
    }
}

/// Returns the size of a cell in direction cosines: across its ring, and along it.
fn sides(cell: &Cell) -> [f64; 2] {
    [cell.theta_max.sin() - cell.theta_min.sin(), cell.width * cell.theta_max.sin()]
}

/// Returns nodes and weights of the Gauss–Legendre rule of an order, computed once per order.
fn gauss_nodes(order: usize) -> &'static [(f64, f64)] {
    static RULES: [OnceLock<Vec<(f64, f64)>>; MOST[1] + 1] = [const { OnceLock::new() }; MOST[1] + 1];
    RULES[order].get_or_init(|| gauss_legendre(order))
}

/// Returns the scaled modified Bessel function e⁻ˣ I₀(x), x ≥ 0, to 2e-7 (Abramowitz and Stegun 9.8.1 and 9.8.2).
fn scaled_bessel(x: f64) -> f64 {
    let polynomial = |c: &[f64], t: f64| c.iter().rev().fold(0.0, |sum, c| sum * t + c);
    if x < 3.75 {
        let t = (x / 3.75).powi(2);
        let c = [1.0, 3.515_622_9, 3.089_942_4, 1.206_749_2, 0.265_973_2, 0.036_076_8, 0.004_581_3];
        (-x).exp() * polynomial(&c, t)
    } else {
        let c = [
            0.398_942_28,
            0.013_285_92,
            0.002_253_19,
            -0.001_575_65,
            0.009_162_81,
            -0.020_577_06,
            0.026_355_37,
            -0.016_476_33,
            0.003_923_77,
        ];
        polynomial(&c, 3.75 / x) / x.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bessel_at_known_places() {
        // I₀(1) = 1.2660658777520084, I₀(5) = 27.239871823604442.
        assert!((scaled_bessel(1.0) * 1_f64.exp() - 1.266_065_877_752).abs() < 1e-6);
        assert!((scaled_bessel(5.0) * 5_f64.exp() - 27.239_871_823_6).abs() < 1e-5);
    }
}
