//! Illuminance of an aperture by the sky from every cell of a basis, by fixed directions and weights: for a new sky of
//! a smooth model only its luminances in these directions are evaluated.
//!
//! The part of a cell above horizon or skyline is delimited exactly, like in [`super::incident_illuminances`]; it has
//! Gauss points in azimuth and polar angle, their weights scaled to the projected solid angle of the part.

use super::outside::Outside;
use super::region::{Frame, Region, Weight};
use crate::compute::basis::RingBasis;
use crate::compute::quadrature::gauss_legendre;
use glam::DVec3;
use std::f64::consts::PI;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Directions and weights \[sr\] for the illuminance of an aperture by the sky from every cell of one basis.
#[derive(Debug, Clone)]
pub struct SkySamples {
    cells: Vec<usize>,
    first: Vec<usize>,
    directions: Vec<DVec3>,
    weights: Vec<f64>,
}

impl SkySamples {
    /// Creates the directions in all cells of `basis` that reach above the horizon. `frame`: axes of the aperture in
    /// the world; `altitude`: of a uniform skyline, below which there are no directions \[rad\]; `spacing`: approximate
    /// maximum distance of neighbouring directions \[rad\].
    pub fn new(basis: &RingBasis, frame: &Frame, altitude: f64, spacing: f64) -> Self {
        let mut samples = Self { cells: Vec::new(), first: vec![0], directions: Vec::new(), weights: Vec::new() };
        let rules: Vec<Vec<(f64, f64)>> = (0..=MOST_POINTS).map(gauss_legendre).collect();
        let points = |width: f64| ((width / spacing - 1e-9).ceil() as usize).clamp(1, MOST_POINTS);
        for index in 0..basis.len() {
            let cell = basis.cell(index);
            let theta = (cell.theta_min, cell.theta_max);
            // Cells wider than a quarter turn are divided, because the quadrature rules are made for smooth pieces.
            let pieces = (cell.width / (0.5 * PI)).ceil().max(1.0) as usize;
            let step = cell.width / pieces as f64;
            let mut open = 0.0;
            for piece in 0..pieces {
                let from = cell.phi - 0.5 * cell.width + piece as f64 * step;
                let region = Region { frame: *frame, theta, phi: (from, from + step) };
                open += solid(&region, 0.0, &rules);
                samples.cut(&region, altitude.sin(), &rules, points);
            }
            if open > 1e-9 * cell.projected_solid_angle() {
                samples.cells.push(index);
                samples.first.push(samples.directions.len());
            } else {
                let last = samples.first[samples.first.len() - 1];
                samples.directions.truncate(last);
                samples.weights.truncate(last);
            }
        }
        samples
    }

    /// Adds directions and weights for the part of a region above the altitude of sine `level`.
    fn cut(&mut self, region: &Region, level: f64, rules: &[Vec<(f64, f64)>], points: impl Fn(f64) -> usize) {
        for (from, to) in strips(region, level) {
            let begin = self.weights.len();
            let middle = 0.5 * (region.theta.0 + region.theta.1);
            let (mut exact, mut sum) = (0.0, 0.0);
            for &(s, ws) in &rules[points((to - from) * middle.sin())] {
                let phi = from + (to - from) * s;
                let Some((low, high)) = region.above(phi, level) else { continue };
                for &(t, wt) in &rules[points(high - low)] {
                    let theta = low + (high - low) * t;
                    let weight = ws * wt * (to - from) * (high - low) * theta.sin() * theta.cos();
                    self.directions.push(region.frame.direction(theta, phi));
                    self.weights.push(weight);
                    sum += weight;
                }
            }
            for &(s, ws) in &rules[MOST_POINTS] {
                let phi = from + (to - from) * s;
                exact += region
                    .above(phi, level)
                    .map_or(0.0, |(low, high)| ws * (to - from) * Weight::Projected.between(low, high));
            }
            if sum > 0.0 {
                self.weights[begin..].iter_mut().for_each(|weight| *weight *= exact / sum);
            }
        }
    }

    /// Removes the directions that obstructions hide. `hidden`: whether a direction (world's axes) is hidden; `open`:
    /// projected solid angle of the visible sky in each of [`Self::cells`], to which the weights of the remaining
    /// directions are scaled. \[sr\]
    pub fn without(&mut self, hidden: impl Fn(DVec3) -> bool, open: &[f64]) {
        let (mut first, mut directions, mut weights) = (vec![0], Vec::new(), Vec::new());
        for (pair, open) in self.first.windows(2).zip(open) {
            let begin = weights.len();
            for k in pair[0]..pair[1] {
                if !hidden(self.directions[k]) {
                    directions.push(self.directions[k]);
                    weights.push(self.weights[k]);
                }
            }
            // If the visible part of a cell lies between its directions, all of them represent it.
            if weights.len() == begin && *open > 0.0 {
                directions.extend(&self.directions[pair[0]..pair[1]]);
                weights.extend(&self.weights[pair[0]..pair[1]]);
            }
            let kept: f64 = weights[begin..].iter().sum();
            if kept > 0.0 {
                weights[begin..].iter_mut().for_each(|weight| *weight *= open.max(0.0) / kept);
            }
            first.push(weights.len());
        }
        (self.first, self.directions, self.weights) = (first, directions, weights);
    }

    /// Returns the indices in the basis of the cells that reach above the horizon, rising.
    pub fn cells(&self) -> &[usize] {
        &self.cells
    }

    /// Returns the number of directions in all cells.
    pub fn len(&self) -> usize {
        self.directions.len()
    }

    /// Returns a hash of all directions and weights, as a key for caches.
    pub fn fingerprint(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.first.hash(&mut hasher);
        for (d, weight) in self.directions.iter().zip(&self.weights) {
            [d.x, d.y, d.z, *weight].map(f64::to_bits).hash(&mut hasher);
        }
        hasher.finish()
    }

    /// Whether there are no directions, because no sky is visible from the aperture.
    pub fn is_empty(&self) -> bool {
        self.directions.is_empty()
    }

    /// Computes the illuminance of the aperture from each of [`Self::cells`] by the sky alone, without ground and
    /// skyline, into `out`. \[lx\] The skyline of `outside` must be the one for which the directions were created.
    pub fn illuminances(&self, outside: &Outside, out: &mut Vec<f64>) {
        out.clear();
        out.extend(self.first.windows(2).map(|pair| {
            let range = pair[0]..pair[1];
            let parts = self.directions[range.clone()].iter().zip(&self.weights[range]);
            parts.map(|(d, weight)| weight * outside.sky_luminance(*d)).sum::<f64>()
        }));
    }
}

/// Maximum number of points along one side of a piece of a cell. Chosen: cost; held by the test
/// `a_uniform_sky_above_a_skyline_is_exact_and_a_clear_one_close`.
const MOST_POINTS: usize = 8;

/// Returns the intervals of azimuth within which the part of a region above the altitude of sine `level` has smooth
/// limits.
fn strips(region: &Region, level: f64) -> Vec<(f64, f64)> {
    let mut inner = Vec::new();
    region.cut_knots(level, &mut inner);
    let knots = region.sorted(inner);
    let open = |pair: &[f64]| region.above(0.5 * (pair[0] + pair[1]), level).is_some();
    knots.windows(2).filter(|pair| open(pair)).map(|pair| (pair[0], pair[1])).collect()
}

/// Returns the projected solid angle of the part of a region above the altitude of sine `level`. \[sr\]
fn solid(region: &Region, level: f64, rules: &[Vec<(f64, f64)>]) -> f64 {
    let share = |(from, to): (f64, f64)| -> f64 {
        let at = |s: f64| region.above(from + (to - from) * s, level);
        rules[MOST_POINTS]
            .iter()
            .map(|&(s, w)| w * (to - from) * at(s).map_or(0.0, |(a, b)| Weight::Projected.between(a, b)))
            .sum()
    };
    strips(region, level).into_iter().map(share).sum()
}

#[cfg(test)]
mod tests {
    use super::super::{Distribution, incident_illuminances};
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::basis::AzimuthMap;
    use crate::compute::direction::{Dir, Orientation, Surface};

    #[test]
    fn a_uniform_sky_above_a_skyline_is_exact_and_a_clear_one_close() {
        let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let orientation = Orientation::new(Bearing::from_degrees(160.0));
        let sun = Dir::from_altitude_bearing(0.6, Bearing::from_degrees(190.0));
        for surface in [Surface::Facade, Surface::Roof] {
            let frame = Frame::of_aperture(orientation, surface);
            for (distribution, spacing, bound) in [
                (Distribution::uniform(), 0.3, 1e-6),
                (Distribution::cie(12, sun).unwrap(), 0.09, 1e-3),
                (Distribution::cie(1, sun).unwrap(), 0.09, 1e-3),
            ] {
                let samples = SkySamples::new(&basis, &frame, 0.2, spacing);
                let outside = Outside::new(distribution, 1e4).unwrap().with_skyline(0.2, 0.0).unwrap();
                let exact = incident_illuminances(&outside, &basis, &frame);
                let total: f64 = exact.iter().map(|e| e.value).sum();
                let mut out = Vec::new();
                samples.illuminances(&outside, &mut out);
                let mut by_cell = vec![0.0; basis.len()];
                samples.cells().iter().zip(&out).for_each(|(&cell, e)| by_cell[cell] = *e);
                let off: f64 = exact.iter().zip(&by_cell).map(|(a, b)| (a.value - b).abs()).sum();
                assert!(off < bound * total, "{surface:?} {spacing}: {off} of {total}");
            }
        }
    }
}
