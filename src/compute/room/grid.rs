//! Interpolation of luminances that vary over the area of an aperture, on a grid of points with parabolas through each
//! three of them.

use super::aperture::{Aperture, View};
use super::through;
use crate::compute::quadrature::gauss_legendre;
use crate::compute::sequence::net;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Number of grid lines along each side of an aperture: odd, for parabolas through three lines each. Chosen: cost; held
/// by the test `a_sensor_sees_what_the_aperture_shows_there` (2e-3).
const LINES: usize = 13;
/// Distance of the outermost lines from the borders, relative to the side: a point on the border may lie in a box that
/// touches it. Chosen: far above the rounding of positions; a millimetre on a side of 2 m.
const INSET: f64 = 5e-4;
/// Number of Gauss points between three grid lines: exact for a parabola times a polynomial of degree five.
const RULE: usize = 4;
/// Number of directions from a sensor in which the points of an aperture are sampled, a power of two, required by
/// [`net`]. Chosen: cost; only the positions are sampled, solid angles are exact.
const DIRECTIONS: u32 = 4096;
/// Number of points of an aperture that are tested for direct sun. Chosen: cost; 24 per point of the grid.
const POINTS: u32 = 4096;

/// Grid of points on an aperture, close together along its borders, where the visible outside changes fast beside an
/// obstruction.
#[derive(Debug, Clone)]
pub struct Grid {
    aperture: Aperture,
    /// Positions of the grid lines as shares of a side.
    lines: Vec<f64>,
}

/// Indices of points of a grid on an aperture with their weights.
pub type Weights = Vec<(u16, f32)>;

/// Emergent cells that a sensor sees, each with the grid points of the aperture through which it sees them and their
/// weights. \[sr\]
pub type CellWeights = Vec<(usize, Weights)>;

impl Grid {
    /// Creates the grid of an aperture with Chebyshev points along each side.
    pub fn of(aperture: &Aperture) -> Self {
        let line = |k: usize| 0.5 - (0.5 - INSET) * (PI * k as f64 / (LINES - 1) as f64).cos();
        Self { aperture: *aperture, lines: (0..LINES).map(line).collect() }
    }

    /// Returns the share of the aperture's area that each grid point represents.
    pub fn parts(&self) -> Vec<f64> {
        self.integrals(|_| 1.0, |_| 1.0)
    }

    /// Returns for every grid point the integral over the aperture of its interpolation weight times a function of each
    /// coordinate; coordinates are shares of the sides.
    pub fn integrals(&self, of_x: impl Fn(f64) -> f64, of_y: impl Fn(f64) -> f64) -> Vec<f64> {
        let side = |of: &dyn Fn(f64) -> f64| {
            let mut sums = vec![0.0; self.lines.len()];
            let last = self.lines.len() - 1;
            for first in (0..last).step_by(2) {
                let low = if first == 0 { 0.0 } else { self.lines[first] };
                let high = if first + 2 == last { 1.0 } else { self.lines[first + 2] };
                for (s, weight) in gauss_legendre(RULE) {
                    let at = low + (high - low) * s;
                    self.along(at).into_iter().for_each(|(k, value)| sums[k] += weight * (high - low) * of(at) * value);
                }
            }
            sums
        };
        let (x, y) = (side(&of_x), side(&of_y));
        y.iter().flat_map(|y| x.iter().map(move |x| x * y)).collect()
    }

    /// Returns the coordinates of the grid points as shares of the sides, from the lower left.
    pub fn shares(&self) -> Vec<[f64; 2]> {
        self.lines.iter().flat_map(|y| self.lines.iter().map(|x| [*x, *y])).collect()
    }

    /// Returns the number of grid points.
    pub fn count(&self) -> usize {
        self.lines.len().pow(2)
    }

    /// Returns the positions of the grid points in the room's frame. \[m\]
    pub fn places(&self) -> Vec<DVec3> {
        let [u, v] = [DVec3::X, DVec3::Y].map(|axis| self.aperture.surface.room_from_facade(axis));
        let [u, v] = [self.aperture.size[0] * u, self.aperture.size[1] * v];
        self.shares().into_iter().map(|[x, y]| self.aperture.corner + x * u + y * v).collect()
    }

    /// Returns the three grid lines around a position on a side with their interpolation weights.
    fn along(&self, at: f64) -> [(usize, f64); 3] {
        let first = (self.lines.partition_point(|line| *line <= at).clamp(1, self.lines.len() - 2) - 1) / 2 * 2;
        let [a, b, c] = [0, 1, 2].map(|k| self.lines[first + k]);
        [
            (first, (at - b) * (at - c) / ((a - b) * (a - c))),
            (first + 1, (at - a) * (at - c) / ((b - a) * (b - c))),
            (first + 2, (at - a) * (at - b) / ((c - a) * (c - b))),
        ]
    }

    /// Returns the grid points around a position, given as shares of the sides, with their interpolation weights.
    fn around(&self, place: [f64; 2]) -> impl Iterator<Item = (usize, f64)> + use<> {
        let ([along, across], count) = (place.map(|at| self.along(at)), self.lines.len());
        across.into_iter().flat_map(move |(k, b)| along.map(|(i, a)| (k * count + i, a * b)))
    }

    /// Returns, for every emergent cell that a sensor sees, the grid points through which it sees the cell, with
    /// weights that add up to the cell's projected solid angle. \[sr\] `cells`: indices and projected solid angles of
    /// these cells; `cell`: returns the index of the cell that contains a direction of the façade frame; `middle`:
    /// returns the direction in the middle of a cell.
    pub fn by_cell(
        &self,
        view: &View,
        cells: impl Iterator<Item = (usize, f64)>,
        cell: impl Fn(DVec3) -> Option<usize>,
        middle: impl Fn(usize) -> DVec3,
    ) -> CellWeights {
        let mut seen: BTreeMap<usize, BTreeMap<usize, f64>> = BTreeMap::new();
        let add = |sums: &mut BTreeMap<usize, f64>, place, counts| {
            self.around(place).for_each(|(point, share)| *sums.entry(point).or_default() += counts * share);
        };
        through::spread(view, DIRECTIONS, |towards, counts, place| {
            if let Some(cell) = cell(towards).filter(|_| counts > 0.0) {
                add(seen.entry(cell).or_default(), place, counts);
            }
        });
        let one = |(cell, counts): (usize, f64)| {
            let sums = seen.entry(cell).or_insert_with(|| {
                // Without any direction in the cell, its middle represents it, or the point of the aperture nearest to
                // that.
                let (towards, mut sums) = (middle(cell), BTreeMap::new());
                let share = |at: f64, [low, high]: [f64; 2]| {
                    ((at / towards.z.max(1e-9) * view.distance - low) / (high - low)).clamp(0.0, 1.0)
                };
                add(&mut sums, [share(towards.x, view.x), share(towards.y, view.y)], 1.0);
                sums
            });
            let sum: f64 = sums.values().sum();
            (cell, sums.iter().map(|(point, share)| (*point as u16, (counts * share / sum) as f32)).collect())
        };
        cells.filter(|(_, counts)| *counts != 0.0).map(one).collect()
    }

    /// Returns the index of the grid point nearest to a position, given as shares of the sides.
    fn near(&self, place: [f64; 2]) -> usize {
        let [i, k] = place.map(|at| {
            let after = self.lines.partition_point(|line| *line <= at).clamp(1, self.lines.len() - 1);
            if at - self.lines[after - 1] < self.lines[after] - at { after - 1 } else { after }
        });
        k * self.lines.len() + i
    }

    /// Returns, for every grid point, the sunlit share of the area nearest to it, 0 … 1. `pieces`: corners of the
    /// convex sunlit pieces of the aperture, room's frame. \[m\]
    pub fn lit(&self, pieces: &[Vec<DVec3>]) -> Vec<f64> {
        let flat = |corner: &DVec3| {
            let to = self.aperture.surface.facade_from_room(*corner - self.aperture.corner);
            DVec2::new(to.x / self.aperture.size[0], to.y / self.aperture.size[1])
        };
        let pieces: Vec<Vec<DVec2>> = pieces.iter().map(|piece| piece.iter().map(flat).collect()).collect();
        let holds = |piece: &Vec<DVec2>, at: DVec2| {
            let sides = || piece.iter().zip(piece.iter().cycle().skip(1)).map(|(a, b)| (*b - *a).perp_dot(at - *a));
            sides().all(|side| side >= 0.0) || sides().all(|side| side <= 0.0)
        };
        let (mut lit, mut all) = (vec![0.0; self.count()], vec![0.0; self.count()]);
        // The points themselves are added, because a point in a corner is nearest to few others.
        for place in (0..POINTS).map(|number| net(number, 1)).chain(self.shares()) {
            let reached = pieces.iter().any(|piece| holds(piece, DVec2::from_array(place)));
            let near = self.near(place);
            all[near] += 1.0;
            lit[near] += if reached { 1.0 } else { 0.0 };
        }
        lit.iter().zip(all).map(|(lit, all)| lit / all).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Surface;
    use crate::compute::polygon::projected_solid_angle;

    #[test]
    fn a_sensor_sees_what_the_aperture_shows_there() {
        let aperture = Aperture { surface: Surface::Facade, corner: DVec3::new(0.5, 0.0, 0.9), size: [3.0, 1.8] };
        let grid = Grid::of(&aperture);
        assert!((grid.parts().iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let light = |p: DVec3| 2.0 + (p.x - 0.45).sqrt() - 0.2 * p.z * p.z;
        let values: Vec<f64> = grid.places().into_iter().map(light).collect();
        let view = aperture.view(DVec3::new(1.0, 0.8, 0.85), DVec3::Z).unwrap();
        let whole = projected_solid_angle(&view.corners(), view.normal);
        let seen = grid.by_cell(&view, std::iter::once((0, whole)), |_| Some(0), |_| DVec3::Z);
        let seen: f64 = seen[0].1.iter().map(|(point, counts)| f64::from(*counts) * values[usize::from(*point)]).sum();
        let (mut exact, count) = (0.0, 400);
        for (i, k) in (0..count).flat_map(|i| (0..count).map(move |k| (i, k))) {
            let [x, y] = [i, k].map(|k| (f64::from(k) + 0.5) / f64::from(count));
            let point = DVec3::new(0.5 + 3.0 * x, 0.0, 0.9 + 1.8 * y);
            let to = point - DVec3::new(1.0, 0.8, 0.85);
            let area = 3.0 * 1.8 / f64::from(count * count);
            exact += light(point) * area * to.z.max(0.0) * -to.y / to.length_squared().powi(2);
        }
        assert!((seen / exact - 1.0).abs() < 2e-3, "{seen} {exact}");
        // The sun on one half.
        let [a, b, c, _] = aperture.corners();
        let lit = grid.lit(&[vec![a, b, c]]);
        assert!((lit[12] - 1.0).abs() < 1e-12 && lit[156] == 0.0, "{lit:?}");
    }
}
