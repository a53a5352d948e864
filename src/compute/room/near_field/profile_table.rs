//! Illuminance of a sensor by summed-area tables over the two profile angles a = atan(x/z), b = atan(y/z) of the
//! direction from the sensor, façade frame. For every sensor an aperture is a rectangle in these angles, so that the
//! sum over all full cells is four look-ups; cells that its border cuts have closed forms. Exact for a luminance that
//! is constant on the table's cells.
//!
//! The error is the difference from the table of half the resolution, plus the illuminance by all light in the
//! outermost cells: within a few degrees of grazing, a cell is much wider than the details of the luminance, and both
//! tables have the same error.

use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::Estimate;
use crate::compute::polygon::{clip, vector_solid_angle};
use crate::compute::room::aperture::View;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// Luminances of an aperture on n × n cells of two profile angles, with running sums of luminance times vector solid
/// angle.
pub struct ProfileTable {
    n: usize,
    /// Tangents of the n + 1 borders of the cells in each profile angle; the outermost are infinite.
    borders: Vec<f64>,
    /// Luminances of the cells, by row of b, then column of a. \[cd/m²\]
    luminance: Vec<f64>,
    /// Σ L ∫ω dω over all cells left of and below a node, at (n + 1)² nodes, without the outermost cells.
    sums: Vec<DVec3>,
}

impl ProfileTable {
    /// Creates a table of `n` × `n` cells of equal width in the profile angles, each with the luminance in the
    /// direction of its middle. `luminance`: of the aperture as a function of the direction from the sensor towards it,
    /// façade frame \[cd/m²\].
    pub fn new(n: usize, luminance: impl Fn(Dir<Facade>) -> f64 + Sync) -> Self {
        let angle = |i: f64| i * PI / n as f64 - FRAC_PI_2;
        let borders: Vec<f64> = (0..=n)
            .map(|i| match i {
                0 => f64::NEG_INFINITY,
                i if i == n => f64::INFINITY,
                i => angle(i as f64).tan(),
            })
            .collect();
        let middle: Vec<f64> = (0..n).map(|i| angle(i as f64 + 0.5).tan()).collect();
        let luminance: Vec<f64> = (0..n * n)
            .into_par_iter()
            .map(|k| Dir::new(DVec3::new(middle[k % n], middle[k / n], 1.0)).map_or(0.0, &luminance))
            .collect();
        let width = n + 1;
        let mut sums = vec![DVec3::ZERO; width * width];
        for j in 1..n.saturating_sub(1) {
            let mut row = DVec3::ZERO;
            for i in 1..n - 1 {
                row += luminance[j * n + i] * weight([borders[i], borders[i + 1]], [borders[j], borders[j + 1]]);
                sums[(j + 1) * width + i + 1] = sums[j * width + i + 1] + row;
            }
        }
        Self { n, borders, luminance, sums }
    }

    /// Returns the index of the cell that contains a gnomonic coordinate (tangent of a profile angle).
    fn cell(&self, x: f64) -> usize {
        (self.borders.partition_point(|border| *border <= x).max(1) - 1).min(self.n - 1)
    }

    /// Returns Σ L ∫ω dω over a rectangle in gnomonic coordinates, and the part of it in the outermost cells.
    fn rectangle(&self, x: [f64; 2], y: [f64; 2]) -> [DVec3; 2] {
        let [i0, i1] = x.map(|x| self.cell(x));
        let [j0, j1] = y.map(|y| self.cell(y));
        let (mut sum, mut outermost) = (DVec3::ZERO, DVec3::ZERO);
        let mut add = |i: usize, j: usize| {
            let across = [self.borders[i].max(x[0]), self.borders[i + 1].min(x[1])];
            let up = [self.borders[j].max(y[0]), self.borders[j + 1].min(y[1])];
            if across[1] > across[0] && up[1] > up[0] {
                let part = self.luminance[j * self.n + i] * weight(across, up);
                sum += part;
                if i == 0 || j == 0 || i + 1 == self.n || j + 1 == self.n {
                    outermost += part;
                }
            }
        };
        for i in i0..=i1 {
            add(i, j0);
            if j1 > j0 {
                add(i, j1);
            }
        }
        for j in j0 + 1..j1 {
            add(i0, j);
            if i1 > i0 {
                add(i1, j);
            }
        }
        if i1 > i0 + 1 && j1 > j0 + 1 {
            let node = |i: usize, j: usize| self.sums[j * (self.n + 1) + i];
            sum += node(i1, j1) - node(i0 + 1, j1) - node(i1, j0 + 1) + node(i0 + 1, j0 + 1);
        }
        [sum, outermost]
    }

    /// Returns Σ L ∫ω dω over any polygon, cell by cell, and the part of it in the outermost cells.
    fn polygon(&self, corners: &[DVec3]) -> [DVec3; 2] {
        let (mut sum, mut outermost) = (DVec3::ZERO, DVec3::ZERO);
        let (mut column, mut rest) = (Vec::new(), Vec::new());
        for i in 0..self.n {
            strip(corners, DVec3::X, [self.borders[i], self.borders[i + 1]], &mut rest, &mut column);
            for j in 0..self.n {
                if column.len() < 3 {
                    break;
                }
                let mut cell = Vec::new();
                strip(&column, DVec3::Y, [self.borders[j], self.borders[j + 1]], &mut rest, &mut cell);
                if cell.len() >= 3 {
                    let part = self.luminance[j * self.n + i] * vector_solid_angle(&cell);
                    sum += part;
                    if i == 0 || j == 0 || i + 1 == self.n || j + 1 == self.n {
                        outermost += part;
                    }
                }
            }
        }
        [sum, outermost]
    }
}

/// Clips a polygon to the strip between two planes through the point: `limits` in gnomonic coordinates along an axis.
fn strip(corners: &[DVec3], axis: DVec3, limits: [f64; 2], rest: &mut Vec<DVec3>, kept: &mut Vec<DVec3>) {
    let side = |limit: f64, sign: f64| if limit.is_finite() { sign * (axis - limit * DVec3::Z) } else { DVec3::Z };
    clip(corners, side(limits[0], 1.0), rest);
    clip(rest, side(limits[1], -1.0), kept);
}

/// Returns ∫ ω dω over a rectangle in gnomonic coordinates, by differences of corner functions.
fn weight(x: [f64; 2], y: [f64; 2]) -> DVec3 {
    corner(x[1], y[1]) - corner(x[0], y[1]) - corner(x[1], y[0]) + corner(x[0], y[0])
}

/// Returns the three functions whose mixed derivatives are {x, y, 1}/(1 + x² + y²)².
fn corner(x: f64, y: f64) -> DVec3 {
    let (u, v) = (x.hypot(1.0), y.hypot(1.0));
    let (p, q) = ((y / u).atan(), (x / v).atan());
    0.5 * DVec3::new(-p / u, -q / v, x / u * p + y / v * q)
}

/// Computes the illuminance of a sensor by an aperture from a table, with the error from a table of half the
/// resolution. \[lx\] `view`: aperture as seen from the sensor.
pub fn illuminance(view: &View, fine: &ProfileTable, coarse: &ProfileTable) -> Estimate {
    let mut seen = Vec::with_capacity(6);
    clip(&view.corners(), view.normal, &mut seen);
    if seen.len() < 3 {
        return Estimate::default();
    }
    let range = |axis: usize| {
        seen.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
            [low.min(p[axis] / view.distance), high.max(p[axis] / view.distance)]
        })
    };
    let (x, y) = (range(0), range(1));
    // A rectangle clipped by a plane parallel to one of its sides stays a rectangle.
    let on_a_side = |p: &DVec3| {
        let (px, py) = (p.x / view.distance, p.y / view.distance);
        (px == x[0] || px == x[1]) && (py == y[0] || py == y[1])
    };
    let rectangular = seen.iter().all(on_a_side);
    let [value, outermost, half] = {
        let at = |table: &ProfileTable| if rectangular { table.rectangle(x, y) } else { table.polygon(&seen) };
        let [sum, outermost] = at(fine);
        let [half, _] = at(coarse);
        [sum, outermost, half].map(|part| part.dot(view.normal).max(0.0))
    };
    Estimate::new(value, (value - half).abs() + outermost)
}
