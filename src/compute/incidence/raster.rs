//! Lobe of an indicatrix as samples on a square grid about its centre, so that the rotated lobe costs two scalar
//! products per direction.

use super::grid::Grid;
use super::lobes::Lobe;
use glam::DVec3;

/// Values of a lobe's q \[1/sr\] on a square grid of direction cosines about its centre.
#[derive(Debug, Clone)]
pub struct Raster {
    /// First axis of the grid, perpendicular to the centre.
    x: DVec3,
    /// Second axis of the grid, perpendicular to the centre.
    y: DVec3,
    /// Unit vector to the centre of the lobe.
    z: DVec3,
    /// Number of points per side.
    count: usize,
    /// Spacing of the points. \[direction cosine\]
    spacing: f64,
    /// Half of the grid's side. \[direction cosine\]
    half: f64,
    values: Vec<f64>,
}

/// Number of grid points per width of the data's emergent cells. Chosen: cost; held by the test
/// `at_the_measured_directions_the_data_come_back`.
const DENSITY: f64 = 3.0;

impl Raster {
    /// Samples a lobe, sharpened so that its means over cells are those of the data.
    pub fn new(grid: &Grid, lobe: &Lobe) -> Self {
        let points = lobe.sharpened(grid);
        let (x, y) = lobe.centre.any_orthonormal_pair();
        let cell = lobe.cell_width(grid);
        let half = (lobe.radius + cell).min(1.5).sin();
        let count = ((2.0 * half / cell * DENSITY).ceil() as usize).clamp(4, 400) + 1;
        let spacing = 2.0 * half / (count - 1) as f64;
        let mut values = Vec::with_capacity(count * count);
        for j in 0..count {
            for i in 0..count {
                let (a, b) = (i as f64 * spacing - half, j as f64 * spacing - half);
                let rest = 1.0 - a * a - b * b;
                let d = x * a + y * b + lobe.centre * rest.max(0.0).sqrt();
                values.push(if rest > 0.0 { points.at(grid, d) } else { 0.0 });
            }
        }
        Self { x, y, z: lobe.centre, count, spacing, half, values }
    }

    /// Returns the memory that its samples take. \[bytes\]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.values[..])
    }

    /// Returns the lobe rotated so that its centre lies in the direction `centre`.
    pub fn turned(&self, centre: DVec3) -> Turned<'_> {
        self.turned_by(glam::DQuat::from_rotation_arc(self.z, centre))
    }

    /// Returns the lobe rotated by `turn`.
    pub fn turned_by(&self, turn: glam::DQuat) -> Turned<'_> {
        Turned { raster: self, x: turn * self.x, y: turn * self.y, z: turn * self.z }
    }
}

/// Samples of a lobe, rotated to another centre.
pub struct Turned<'a> {
    raster: &'a Raster,
    x: DVec3,
    y: DVec3,
    z: DVec3,
}

impl Turned<'_> {
    /// Returns q of the rotated lobe in a direction (unit vector), 0 outside it. \[1/sr\]
    #[inline]
    pub fn at(&self, d: DVec3) -> f64 {
        let raster = self.raster;
        if self.z.dot(d) <= 0.0 {
            return 0.0;
        }
        let a = (self.x.dot(d) + raster.half) / raster.spacing;
        let b = (self.y.dot(d) + raster.half) / raster.spacing;
        let limit = (raster.count - 1) as f64;
        if !(a >= 0.0 && b >= 0.0 && a < limit && b < limit) {
            return 0.0;
        }
        let (i, j) = (a as usize, b as usize);
        let (s, t) = (a - i as f64, b - j as f64);
        let at = j * raster.count + i;
        let (v, n) = (&raster.values, raster.count);
        (1.0 - t) * ((1.0 - s) * v[at] + s * v[at + 1]) + t * ((1.0 - s) * v[at + n] + s * v[at + n + 1])
    }
}
