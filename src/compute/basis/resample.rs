//! Resampling of values from the cells of one ring basis to those of another.
//!
//! Both bases are products of θ-rings and equal azimuth sectors, so that the overlap of two cells is the product of an
//! overlap in sin²θ and one in φ: exact, no sampling. Values are assumed to be constant on their cells; the result is
//! their mean over every target cell, so that the flux is conserved to rounding wherever the source covers the
//! hemisphere.

use super::rings::RingBasis;
use std::f64::consts::PI;

/// Resampling from the cells of one ring basis to those of another by the overlaps of their projected solid angles, in
/// the façade frame.
#[derive(Debug, Clone)]
pub struct Resampling {
    /// Source cells that overlap each target cell, each with the overlap relative to the projected solid angle of the
    /// target cell.
    shares: Vec<Vec<(usize, f64)>>,
}

impl Resampling {
    /// Computes the overlaps of the cells of `source` with those of `target`.
    pub fn new(source: &RingBasis, target: &RingBasis) -> Self {
        let mut shares = vec![Vec::new(); target.len()];
        for (to, to_ring) in target.rings().iter().enumerate() {
            let to_span = span(to_ring.theta_min, to_ring.theta_max);
            for (from, from_ring) in source.rings().iter().enumerate() {
                let common =
                    span(to_ring.theta_min.max(from_ring.theta_min), to_ring.theta_max.min(from_ring.theta_max));
                if common <= 1e-13 * to_span {
                    continue;
                }
                let others: Vec<(f64, f64)> = (0..from_ring.sectors)
                    .map(|i| source.cell(source.first_cell(from) + i))
                    .map(|cell| (cell.phi, cell.width))
                    .collect();
                for o in 0..to_ring.sectors {
                    let index = target.first_cell(to) + o;
                    let cell = target.cell(index);
                    for (i, &other) in others.iter().enumerate() {
                        if are_disjoint((cell.phi, cell.width), other) {
                            continue;
                        }
                        let width = common_width((cell.phi, cell.width), other);
                        if width > 1e-12 * cell.width {
                            shares[index].push((source.first_cell(from) + i, common / to_span * (width / cell.width)));
                        }
                    }
                }
            }
        }
        Self { shares }
    }

    /// Returns the means over the target cells of a function that is constant on the source cells; `values` holds it by
    /// source cell.
    pub fn apply(&self, values: &[f64]) -> Vec<f64> {
        self.shares.iter().map(|list| list.iter().map(|&(cell, share)| share * values[cell]).sum()).collect()
    }

    /// Returns the source cells that overlap the target cell with index `target`, with the share of the target's
    /// projected solid angle that each covers.
    pub fn shares(&self, target: usize) -> &[(usize, f64)] {
        &self.shares[target]
    }
}

/// Returns sin²b − sin²a without cancellation; not positive if b ≤ a.
fn span(a: f64, b: f64) -> f64 {
    (b - a).sin() * (b + a).sin()
}

/// Whether two azimuth intervals, given by centre and width \[rad\], certainly do not overlap. It spares most pairs of
/// fine cells the sum over full turns.
fn are_disjoint(a: (f64, f64), b: (f64, f64)) -> bool {
    let way = a.0 - b.0;
    (way - 2.0 * PI * (way / (2.0 * PI)).round()).abs() > 0.5 * (a.1 + b.1) + 1e-9
}

/// Returns the common width of two azimuth intervals given by centre and width, both at most a full turn. \[rad\]
fn common_width(a: (f64, f64), b: (f64, f64)) -> f64 {
    let (a0, a1) = (a.0 - 0.5 * a.1, a.0 + 0.5 * a.1);
    [-4.0 * PI, -2.0 * PI, 0.0, 2.0 * PI, 4.0 * PI]
        .iter()
        .map(|turn| {
            let (b0, b1) = (b.0 - 0.5 * b.1 + turn, b.0 + 0.5 * b.1 + turn);
            (a1.min(b1) - a0.max(b0)).max(0.0)
        })
        .sum()
}

/// Returns for every target cell the index of the identical source cell; `None` unless both bases have the same cells,
/// numbered differently.
pub fn same_cells(source: &RingBasis, target: &RingBasis) -> Option<Vec<usize>> {
    if source.len() != target.len() {
        return None;
    }
    target
        .cells()
        .map(|cell| {
            let index = source.index(cell.centre())?;
            let other = source.cell(index);
            let turn = (cell.phi - other.phi).rem_euclid(2.0 * PI);
            let same = (cell.theta_min - other.theta_min).abs() < 1e-9
                && (cell.theta_max - other.theta_max).abs() < 1e-9
                && (cell.width - other.width).abs() < 1e-9
                // A ring that is one cell looks the same from every azimuth.
                && (cell.width > 1.99 * PI || turn.min(2.0 * PI - turn) < 1e-9);
            same.then_some(index)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::rings::AzimuthMap;
    use super::*;
    use crate::compute::direction::Dir;

    fn bases() -> Vec<RingBasis> {
        vec![
            RingBasis::klems_full(AzimuthMap::KLEMS_FRONT),
            RingBasis::klems_quarter(AzimuthMap::KLEMS_BACK),
            RingBasis::tregenza(),
            RingBasis::equal_area(6),
            RingBasis::hemisphere(),
        ]
    }

    #[test]
    fn keeps_flux_and_uniform_values() {
        for source in bases() {
            let values: Vec<f64> = (0..source.len()).map(|k| ((k * 37) % 11) as f64).collect();
            let flux = |basis: &RingBasis, v: &[f64]| -> f64 {
                basis.projected_solid_angles().iter().zip(v).map(|(w, x)| w * x).sum()
            };
            for target in bases() {
                let resampling = Resampling::new(&source, &target);
                let out = resampling.apply(&values);
                assert!((flux(&source, &values) - flux(&target, &out)).abs() < 1e-10, "{}", target.name());
                let uniform = resampling.apply(&vec![3.0; source.len()]);
                assert!(uniform.iter().all(|v| (v - 3.0).abs() < 1e-11));
            }
        }
    }

    #[test]
    fn agrees_with_dense_sampling() {
        let source = RingBasis::klems_full(AzimuthMap::KLEMS_BACK);
        let target = RingBasis::tregenza();
        let values: Vec<f64> = (0..source.len()).map(|k| ((k * 53) % 17) as f64).collect();
        let out = Resampling::new(&source, &target).apply(&values);
        for (index, cell) in target.cells().enumerate() {
            let (n, mut sum) = (60, 0.0);
            let (s0, s1) = (cell.theta_min.sin().powi(2), cell.theta_max.sin().powi(2));
            for a in 0..n {
                let theta = (s0 + (s1 - s0) * (a as f64 + 0.5) / n as f64).sqrt().asin();
                for b in 0..n {
                    let phi = cell.phi + cell.width * ((b as f64 + 0.5) / n as f64 - 0.5);
                    sum += values[source.index(Dir::from_theta_phi(theta, phi)).unwrap()];
                }
            }
            assert!((sum / (n * n) as f64 - out[index]).abs() < 0.25, "{index}");
        }
    }
}
