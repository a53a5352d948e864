//! Interreflection between diffuse surfaces: closed-form exchange areas, one Cholesky factorisation per mesh, any
//! number of right-hand sides.
//!
//! With B = ρE the balance E = E₀ + Fρ E becomes the symmetric positive definite system (A/ρ − AF) B = A E₀ over all
//! patches that reflect. It is factored, not iterated: at ρ = 0.99 iterations need thousands of sweeps.

use super::form_factor::{parallel_corner, perpendicular_corner};
use super::mesh::{Mesh, Wall};
use super::polygon::{clip, vector_solid_angle};
use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, Side};
use glam::DVec3;
use std::f64::consts::PI;

/// A meshed room, ready to answer for any first illuminance.
pub struct Radiosity {
    /// The patches.
    pub mesh: Mesh,
    /// Patches with ρ > 0.
    active: Vec<usize>,
    factor: Option<Llt<f64>>,
    exchange: Exchange,
    /// Largest deviation of Σ_j F_ij from 1.
    pub closure: f64,
}

/// A·F of all pairs of patches, row by row. \[m²\]
struct Exchange {
    count: usize,
    values: Vec<f64>,
}

/// No light is ever absorbed: the balance has no solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("every surface reflects all light and no aperture absorbs any: the illuminance grows without limit")]
pub struct NothingAbsorbs;

impl Radiosity {
    /// Computes and factors. Memory: two dense matrices of the number of patches.
    pub fn new(mesh: Mesh) -> Result<Self, NothingAbsorbs> {
        let exchange = Exchange::new(&mesh);
        let closure = mesh
            .patches
            .iter()
            .enumerate()
            .map(|(i, patch)| (exchange.row(i).iter().sum::<f64>() / patch.area - 1.0).abs())
            .fold(0.0, f64::max);
        let active: Vec<usize> = (0..mesh.patches.len()).filter(|&i| mesh.patches[i].reflectance > 0.0).collect();
        let factor = if active.is_empty() {
            None
        } else {
            // One thread: the result must not depend on their number.
            faer::set_global_parallelism(faer::Par::Seq);
            let matrix = Mat::from_fn(active.len(), active.len(), |r, c| {
                let (i, j) = (active[r], active[c]);
                let diagonal = if i == j { mesh.patches[i].area / mesh.patches[i].reflectance } else { 0.0 };
                diagonal - exchange.row(i)[j]
            });
            Some(matrix.llt(Side::Lower).map_err(|_not_positive| NothingAbsorbs)?)
        };
        Ok(Self { mesh, active, factor, exchange, closure })
    }

    /// Exitance B of every patch from the first illuminance E₀ of every patch. \[lm/m²\]
    pub fn exitance(&self, first: &[f64]) -> Vec<f64> {
        let mut exitance = vec![0.0; self.mesh.patches.len()];
        if let Some(factor) = &self.factor {
            let rhs = Mat::from_fn(self.active.len(), 1, |r, _| {
                let i = self.active[r];
                self.mesh.patches[i].area * first[i]
            });
            let solution = factor.solve(&rhs);
            for (r, &i) in self.active.iter().enumerate() {
                exitance[i] = solution[(r, 0)].max(0.0);
            }
        }
        exitance
    }

    /// Mean illuminance of every patch from patches of given exitance, no reflection. \[lx\]
    pub fn illuminance_from(&self, emitters: &[(usize, f64)]) -> Vec<f64> {
        let mut first = vec![0.0; self.mesh.patches.len()];
        for &(j, exitance) in emitters {
            for ((e, af), patch) in first.iter_mut().zip(self.exchange.row(j)).zip(&self.mesh.patches) {
                *e += af * exitance / patch.area;
            }
        }
        first
    }

    /// Weights w with E_interreflected = Σ w_j B_j at a point (configuration factors).
    pub fn gather_weights(&self, position: DVec3, normal: DVec3) -> Vec<f64> {
        let mut kept = Vec::with_capacity(8);
        self.mesh
            .patches
            .iter()
            .map(|patch| {
                if patch.reflectance == 0.0 {
                    return 0.0;
                }
                let wall = &self.mesh.walls[patch.wall];
                let corners = patch.corners(wall).map(|c| c - position);
                let in_front = corners.map(|c| normal.dot(c) > 0.0);
                let sum = if in_front == [true; 4] {
                    vector_solid_angle(&corners)
                } else if in_front == [false; 4] {
                    return 0.0;
                } else {
                    clip(&corners, normal, &mut kept);
                    vector_solid_angle(&kept)
                };
                sum.dot(normal).abs() / PI
            })
            .collect()
    }
}

impl Exchange {
    fn new(mesh: &Mesh) -> Self {
        let count = mesh.patches.len();
        let mut exchange = Self { count, values: vec![0.0; count * count] };
        for i in 0..mesh.walls.len() {
            for j in i + 1..mesh.walls.len() {
                if mesh.walls[i].axis == mesh.walls[j].axis {
                    exchange.parallel(&mesh.walls[i], &mesh.walls[j]);
                } else {
                    exchange.perpendicular(&mesh.walls[i], &mesh.walls[j]);
                }
            }
        }
        exchange
    }

    fn row(&self, i: usize) -> &[f64] {
        &self.values[i * self.count..(i + 1) * self.count]
    }

    fn set(&mut self, i: usize, j: usize, value: f64) {
        self.values[i * self.count + j] = value;
        self.values[j * self.count + i] = value;
    }

    fn parallel(&mut self, a: &Wall, b: &Wall) {
        let z = (a.position - b.position).abs();
        let table = CornerTable::new([&a.lines[0], &b.lines[0], &a.lines[1], &b.lines[1]], |x0, x1, y0, y1| {
            parallel_corner(x0 - x1, y0 - y1, z)
        });
        let [n0, n1] = [a.lines[0].len() - 1, a.lines[1].len() - 1];
        for i0 in 0..n0 {
            for i1 in 0..n1 {
                for j0 in 0..n0 {
                    for j1 in 0..n1 {
                        let value = table.fourth_difference([i0, j0, i1, j1]);
                        self.set(a.first + i0 * n1 + i1, b.first + j0 * n1 + j1, value);
                    }
                }
            }
        }
    }

    fn perpendicular(&mut self, a: &Wall, b: &Wall) {
        // The common axis runs along both walls; the other axis of a wall is counted from the line where they meet.
        let common = 3 - a.axis - b.axis;
        let place = |wall: &Wall| usize::from(wall.along[1] == common);
        let (pa, pb) = (place(a), place(b));
        let across = |wall: &Wall, p: usize, meets: f64| -> Vec<f64> {
            wall.lines[1 - p].iter().map(|line| (line - meets).abs()).collect()
        };
        let (xa, yb) = (across(a, pa, b.position), across(b, pb, a.position));
        let table = CornerTable::new([&a.lines[pa], &b.lines[pb], &xa, &yb], |u0, u1, x, y| {
            perpendicular_corner(u0 - u1, x, y)
        });
        let index = |wall: &Wall, p: usize, along: usize, across: usize| {
            let n1 = wall.lines[1].len() - 1;
            wall.first + if p == 0 { along * n1 + across } else { across * n1 + along }
        };
        for i in 0..a.lines[pa].len() - 1 {
            for k in 0..xa.len() - 1 {
                for j in 0..b.lines[pb].len() - 1 {
                    for l in 0..yb.len() - 1 {
                        let value = table.fourth_difference([i, j, k, l]);
                        self.set(index(a, pa, i, k), index(b, pb, j, l), value);
                    }
                }
            }
        }
    }
}

/// Corner values over four lists of lines.
struct CornerTable {
    stride: [usize; 4],
    values: Vec<f64>,
}

impl CornerTable {
    fn new(lines: [&[f64]; 4], corner: impl Fn(f64, f64, f64, f64) -> f64) -> Self {
        let [n0, n1, n2, n3] = lines.map(<[f64]>::len);
        let mut values = Vec::with_capacity(n0 * n1 * n2 * n3);
        for &a in lines[0] {
            for &b in lines[1] {
                for &c in lines[2] {
                    for &d in lines[3] {
                        values.push(corner(a, b, c, d));
                    }
                }
            }
        }
        Self { stride: [n1 * n2 * n3, n2 * n3, n3, 1], values }
    }

    /// Differences over the cells that begin at the given lines; both orders of summation give the same sign, and an
    /// exchange area is positive.
    fn fourth_difference(&self, cell: [usize; 4]) -> f64 {
        let base: usize = cell.iter().zip(&self.stride).map(|(i, s)| i * s).sum();
        let [a, b, c, d] = self.stride;
        let second = |at: usize| self.values[at + c + d] - self.values[at + c] - self.values[at + d] + self.values[at];
        (second(base + a + b) - second(base + a) - second(base + b) + second(base)).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::super::aperture::Aperture;
    use super::super::mesh::BoxRoom;
    use super::*;
    use crate::compute::direction::Surface;

    fn room(rho: f64) -> BoxRoom {
        BoxRoom { size: DVec3::new(4.0, 6.0, 3.0), floor: rho, walls: rho, ceiling: rho }
    }

    fn window() -> Aperture {
        Aperture { surface: Surface::Facade, corner: DVec3::new(0.3, 0.0, 0.8), size: [2.5, 1.7] }
    }

    #[test]
    fn every_patch_sees_the_whole_room() {
        for (size, step) in [([4.0, 6.0, 3.0], 0.7), ([100.0, 1.0, 1.0], 0.6), ([0.1, 0.1, 10.0], 0.1)] {
            let room = BoxRoom { size: DVec3::from_array(size), ..room(0.5) };
            let radiosity = Radiosity::new(Mesh::new(&room, &[], &[], step)).unwrap();
            assert!(radiosity.closure < 1e-9, "{size:?}: {}", radiosity.closure);
        }
    }

    #[test]
    fn uniform_light_and_reflectance_give_the_infinite_series() {
        // E = E₀/(1 − ρ) everywhere, in any box, when E₀ and ρ are the same everywhere.
        for rho in [0.3, 0.9, 0.99, 0.999] {
            let mesh = Mesh::new(&room(rho), &[window()], &[rho], 0.8);
            let radiosity = Radiosity::new(mesh).unwrap();
            let exitance = radiosity.exitance(&vec![100.0; radiosity.mesh.patches.len()]);
            for b in exitance {
                assert!((b / rho * (1.0 - rho) / 100.0 - 1.0).abs() < 1e-8, "{rho}: {b}");
            }
        }
    }

    #[test]
    fn a_point_sees_configuration_factors_that_sum_to_one() {
        let radiosity = Radiosity::new(Mesh::new(&room(0.5), &[window()], &[0.1], 0.9)).unwrap();
        for normal in [DVec3::Z, DVec3::NEG_X, DVec3::new(0.3, 0.5, -0.4).normalize()] {
            let sum: f64 = radiosity.gather_weights(DVec3::new(1.1, 2.3, 0.85), normal).iter().sum();
            assert!((sum - 1.0).abs() < 1e-12, "{normal}: {sum}");
        }
    }

    #[test]
    fn flux_that_enters_is_absorbed() {
        let (rho, rho_window) = (0.7, 0.2);
        let mesh = Mesh::new(&room(rho), &[window()], &[rho_window], 0.5);
        let radiosity = Radiosity::new(mesh).unwrap();
        let emitters: Vec<(usize, f64)> = (0..radiosity.mesh.patches.len())
            .filter(|&i| radiosity.mesh.patches[i].aperture.is_some())
            .map(|i| (i, 1000.0))
            .collect();
        let first = radiosity.illuminance_from(&emitters);
        let exitance = radiosity.exitance(&first);
        let absorbed: f64 = radiosity
            .mesh
            .patches
            .iter()
            .zip(&exitance)
            .map(|(patch, b)| patch.area * b / patch.reflectance * (1.0 - patch.reflectance))
            .sum();
        assert!((absorbed / (1000.0 * window().area()) - 1.0).abs() < 1e-9, "{absorbed}");
    }

    #[test]
    fn a_room_that_absorbs_nothing_is_refused() {
        assert!(Radiosity::new(Mesh::new(&room(1.0), &[], &[], 2.0)).is_err());
    }
}
