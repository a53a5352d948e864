//! Square grids of tensor trees: the unit square that Shirley and Chiu map to the disk of direction cosines. Equal
//! areas of the square are equal projected solid angles, so that every cell of a grid on it has a projected solid angle
//! of π/resolution².
//!
//! In the façade frame the square's first coordinate increases with x (right), the second with y (up); (0.5, 0.5) is
//! the normal. Concentric square frames map to concentric rings, which is why a grid of 2n × 2n cells can be resampled
//! to [`RingBasis::equal_area`]`(n)` ring by ring without any change in θ.
//!
//! References: P. Shirley and K. Chiu, "A low distortion map between disk and square", JGT 2(3), 1997; the centre
//! line and border rules are those of Radiance's `disk2square`.

use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Facade};
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// Maximum level of a square grid: 2⁹ = 512 cells along a side. Chosen: limit of input; deeper trees are refused.
pub const MAX_LEVEL: u32 = 9;

/// Returns the point of the unit disk (direction cosines) for a point of the unit square by the map of Shirley and
/// Chiu.
pub fn disk_from_square([x, y]: [f64; 2]) -> [f64; 2] {
    let (a, b) = (2.0 * x - 1.0, 2.0 * y - 1.0);
    if a == 0.0 && b == 0.0 {
        return [0.0, 0.0];
    }
    let (r, phi) = if a.abs() > b.abs() { (a, 0.25 * PI * (b / a)) } else { (b, 0.5 * PI - 0.25 * PI * (a / b)) };
    // A negative r turns the point to the opposite side, which is where regions 3 and 4 lie.
    [r * phi.cos(), r * phi.sin()]
}

/// Returns the point of the unit square for a point of the unit disk (direction cosines); the inverse of
/// [`disk_from_square`].
pub fn square_from_disk([x, y]: [f64; 2]) -> [f64; 2] {
    // Radiance shrinks its disk by 1e-13, so that a direction on a border belongs to the cell farther out.
    const HALF: f64 = 0.5 / 0.999_999_999_999_9;
    let r = x.hypot(y);
    if r == 0.0 {
        return [0.5, 0.5];
    }
    let (a, b) = if x.abs() >= y.abs() {
        (r.copysign(x), r.copysign(x) * (y / x).atan() / (0.25 * PI))
    } else {
        (r.copysign(y) * (x / y).atan() / (0.25 * PI), r.copysign(y))
    };
    [(a * HALF + 0.5).clamp(0.0, 1.0), (b * HALF + 0.5).clamp(0.0, 1.0)]
}

/// Grid of 2^level × 2^level cells of equal projected solid angle over the hemisphere of the façade frame, for incident
/// directions and reversed emergent directions. Cells are numbered row by row: index = iy · resolution + ix.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SquareGrid {
    level: u32,
}

impl SquareGrid {
    /// Creates a grid with 2^`level` cells along a side; `None` unless 1 ≤ `level` ≤ [`MAX_LEVEL`].
    pub const fn new(level: u32) -> Option<Self> {
        if level >= 1 && level <= MAX_LEVEL { Some(Self { level }) } else { None }
    }

    /// Returns the level of the grid: log₂ of the number of cells along a side.
    pub const fn level(self) -> u32 {
        self.level
    }

    /// Returns the number of cells along one side of the grid.
    pub const fn resolution(self) -> usize {
        1 << self.level
    }

    /// Returns the number of cells of the grid, never 0.
    #[allow(clippy::len_without_is_empty, reason = "it never is")]
    pub const fn len(self) -> usize {
        self.resolution() * self.resolution()
    }

    /// Returns the projected solid angle ∫cosθ dω of each cell, the same for all. \[sr\]
    pub fn projected_solid_angle(self) -> f64 {
        PI / self.len() as f64
    }

    /// Returns the cell with this index. Panics if there is none.
    pub fn cell(self, index: usize) -> SquareCell {
        assert!(index < self.len(), "cell {index} of {}", self.len());
        SquareCell { ix: index % self.resolution(), iy: index / self.resolution(), resolution: self.resolution() }
    }

    /// Returns all cells of the grid, row by row.
    pub fn cells(self) -> impl Iterator<Item = SquareCell> {
        (0..self.len()).map(move |index| self.cell(index))
    }

    /// Returns the index of the cell that contains a direction of the façade frame; `None` for z < 0. Borders belong to
    /// the cell farther from the normal.
    pub fn index(self, d: Dir<Facade>) -> Option<usize> {
        let v = d.vector();
        if v.z < -1e-12 {
            return None;
        }
        let [ix, iy] = self.position([v.x, v.y]);
        Some(iy * self.resolution() + ix)
    }

    /// Returns column and row of the cell that contains a point of the unit disk.
    pub(crate) fn position(self, disk: [f64; 2]) -> [usize; 2] {
        square_from_disk(disk).map(|s| ((s * self.resolution() as f64) as usize).min(self.resolution() - 1))
    }

    /// Returns the ring basis of the same cells with straightened azimuth borders: [`RingBasis::equal_area`].
    pub fn rings(self) -> RingBasis {
        RingBasis::equal_area(self.resolution() / 2)
    }

    /// Returns values on the cells of the grid, resampled to those of [`Self::rings`]. Sums over each ring are exactly
    /// conserved. Because all cells have the same projected solid angle, it may be used for means (luminance, q) and
    /// for totals (illuminance, flux).
    pub fn to_rings(self, values: &[f64]) -> Vec<f64> {
        assert_eq!(values.len(), self.len(), "one value a cell");
        let mut out = vec![0.0; self.len()];
        for share in self.shares().iter() {
            out[share.sector as usize] += share.fraction * values[share.cell as usize];
        }
        out
    }

    /// Returns the shares of square cells in ring cells, computed once for each resolution.
    fn shares(self) -> Arc<Vec<Share>> {
        static KEPT: [OnceLock<Arc<Vec<Share>>>; MAX_LEVEL as usize + 1] =
            [const { OnceLock::new() }; MAX_LEVEL as usize + 1];
        KEPT[self.level as usize].get_or_init(|| Arc::new(shares(self.resolution()))).clone()
    }
}

/// Share of a square cell that lies in a cell of the ring basis.
#[derive(Debug, Clone, Copy)]
struct Share {
    cell: u32,
    sector: u32,
    fraction: f64,
}

/// Computes the shares of square cells in ring cells: by midpoints across each concentric square frame, exactly along
/// its azimuth.
fn shares(resolution: usize) -> Vec<Share> {
    // Number of midpoints across the thickness of a frame. Chosen: cost; sums of rings and uniform values are exact
    // with any number, because sectors and cells divide a frame along lines whose length grows linearly.
    const STEPS: usize = 8;
    let n = resolution / 2;
    let mut all = Vec::new();
    for k in 1..=n {
        // The quarter around +x: a from (k − 1)/n to k/n, b from −a to a, φ = (π/4)·b/a. Lengths in cells.
        let sectors = 8 * k - 4;
        let first_sector = 4 * (k - 1) * (k - 1);
        let mut quarter: Vec<(i64, usize, f64)> = Vec::new();
        for step in 0..STEPS {
            let a = (k - 1) as f64 + (step as f64 + 0.5) / STEPS as f64;
            // b at the border between sectors: φ = s·2π/sectors.
            let b_of_sector = |s: f64| 8.0 * a * s / sectors as f64;
            let mut b = -a;
            while b < a - 1e-12 {
                let cell = (b + 1e-12).floor() as i64;
                let sector = (b * sectors as f64 / (8.0 * a) + 1e-12).floor();
                let next = ((cell + 1) as f64).min(b_of_sector(sector + 1.0)).min(a);
                let sector = (sector as i64).rem_euclid(sectors as i64) as usize;
                let length = (next - b) / STEPS as f64;
                match quarter.iter_mut().find(|entry| entry.0 == cell && entry.1 == sector) {
                    Some(entry) => entry.2 += length,
                    None => quarter.push((cell, sector, length)),
                }
                b = next;
            }
        }
        for &(cell, sector, fraction) in &quarter {
            let (mut ix, mut iy) = (n + k - 1, (n as i64 + cell) as usize);
            let mut sector = sector;
            for _ in 0..4 {
                all.push(Share {
                    cell: (iy * resolution + ix) as u32,
                    sector: (first_sector + sector) as u32,
                    fraction,
                });
                // A quarter turn: (x, y) → (−y, x).
                (ix, iy) = (resolution - 1 - iy, ix);
                sector = (sector + 2 * k - 1) % sectors;
            }
        }
    }
    all
}

/// Cell of a square grid over the hemisphere ([`SquareGrid`]).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SquareCell {
    ix: usize,
    iy: usize,
    resolution: usize,
}

impl SquareCell {
    /// Returns column (along x) and row (along y) of the cell in the grid, from 0.
    pub const fn position(self) -> [usize; 2] {
        [self.ix, self.iy]
    }

    /// Returns the lower corner and the side length of the cell on the unit square.
    pub fn bounds(self) -> ([f64; 2], f64) {
        let side = 1.0 / self.resolution as f64;
        ([self.ix as f64 * side, self.iy as f64 * side], side)
    }

    /// Returns the direction, façade frame, at a point of the cell given by coordinates 0 … 1 inside it. For emergent
    /// cells it is the reversed emergent direction.
    pub fn direction(self, at: [f64; 2]) -> Dir<Facade> {
        let ([x, y], side) = self.bounds();
        let [x, y] = disk_from_square([x + at[0] * side, y + at[1] * side]);
        Dir::from_unit(DVec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt()))
    }

    /// Returns the direction in the middle of the cell, façade frame.
    pub fn centre(self) -> Dir<Facade> {
        self.direction([0.5, 0.5])
    }

    /// Returns `n` × `n` directions of the façade frame, each of which represents the same share of the cell's
    /// projected solid angle. `n` ≥ 1.
    pub fn samples(self, n: usize) -> impl Iterator<Item = Dir<Facade>> {
        (0..n * n).map(move |k| self.direction([((k % n) as f64 + 0.5) / n as f64, ((k / n) as f64 + 0.5) / n as f64]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn square_and_disk_are_inverse() {
        for i in 0..40 {
            for j in 0..40 {
                let s = [(i as f64 + 0.5) / 40.0, (j as f64 + 0.3) / 40.0];
                let back = square_from_disk(disk_from_square(s));
                assert!((back[0] - s[0]).abs() < 1e-12 && (back[1] - s[1]).abs() < 1e-12, "{s:?} {back:?}");
            }
        }
        // Where the axes lead: right, up, left, down.
        for (s, d) in
            [([1.0, 0.5], [1.0, 0.0]), ([0.5, 1.0], [0.0, 1.0]), ([0.0, 0.5], [-1.0, 0.0]), ([0.5, 0.0], [0.0, -1.0])]
        {
            let got = disk_from_square(s);
            assert!((got[0] - d[0]).abs() < 1e-15 && (got[1] - d[1]).abs() < 1e-15);
        }
    }

    #[test]
    fn the_map_keeps_areas() {
        // Share of random square cells inside sinθ < 1/2 must be a quarter of the area.
        let grid = SquareGrid::new(8).unwrap();
        let inside = grid.cells().filter(|cell| cell.centre().theta() < 30_f64.to_radians()).count();
        assert_eq!(inside, grid.len() / 4);
        // A sector of 37° at any radius: area share 37/360.
        let sector = grid.cells().filter(|cell| cell.centre().phi() < 37_f64.to_radians()).count();
        assert!((sector as f64 / grid.len() as f64 - 37.0 / 360.0).abs() < 1e-3);
    }

    #[test]
    fn handing_over_to_rings_keeps_uniform_values_and_every_ring_sum() {
        for level in 1..=6 {
            let grid = SquareGrid::new(level).unwrap();
            let rings = grid.rings();
            assert!(grid.to_rings(&vec![2.5; grid.len()]).iter().all(|v| (v - 2.5).abs() < 1e-12));
            for index in [0, grid.len() / 3, grid.len() - 1] {
                let mut one = vec![0.0; grid.len()];
                one[index] = 1.0;
                let out = grid.to_rings(&one);
                assert!((out.iter().sum::<f64>() - 1.0).abs() < 1e-12);
                let centre = grid.cell(index).centre();
                // The light stays in its ring and near its azimuth.
                let near = rings.index(centre).unwrap();
                for (k, v) in out.iter().enumerate().filter(|(_, v)| **v > 0.0) {
                    let cell = rings.cell(k);
                    assert!((cell.theta_min - rings.cell(near).theta_min).abs() < 1e-12, "{k} {v}");
                    let turn = (cell.phi - centre.phi()).rem_euclid(2.0 * PI);
                    assert!(turn.min(2.0 * PI - turn) < 2.0 * cell.width, "level {level} cell {index}: {turn}");
                }
            }
        }
    }

    #[test]
    fn cells_hold_their_samples() {
        let grid = SquareGrid::new(4).unwrap();
        for index in 0..grid.len() {
            assert!(grid.cell(index).samples(3).all(|d| grid.index(d) == Some(index)));
        }
    }
}
