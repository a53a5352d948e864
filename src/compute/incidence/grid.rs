//! Cells of a ring basis for the analysis of indicatrices: neighbours of cells, smoothing over tens of degrees, values
//! between cell centres.

use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Facade};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Emergent cells with the neighbours, weights and centres that the splitting of indicatrices needs.
#[derive(Debug, Clone)]
pub struct Grid {
    basis: RingBasis,
    /// Ring numbers of the basis by rising θ.
    order: Vec<usize>,
    /// Solid angle of every cell. \[sr\]
    pub solid: Vec<f64>,
    /// Projected solid angle ∫cosθ dω of every cell. \[sr\]
    pub projected: Vec<f64>,
    /// Unit vector to the centre of every cell, façade frame.
    pub centre: Vec<DVec3>,
    /// Indices of the cells that touch each cell.
    pub neighbours: Vec<Vec<u32>>,
}

impl Grid {
    /// Creates the neighbours, weights and centres of the cells of a basis.
    pub fn new(basis: &RingBasis) -> Self {
        let mut order: Vec<usize> = (0..basis.rings().len()).collect();
        order.sort_by(|&a, &b| basis.rings()[a].theta_min.total_cmp(&basis.rings()[b].theta_min));
        let mut grid = Self {
            basis: basis.clone(),
            order,
            solid: basis.cells().map(|cell| cell.solid_angle()).collect(),
            projected: basis.projected_solid_angles(),
            centre: basis.cells().map(|cell| cell.centre().vector()).collect(),
            neighbours: Vec::new(),
        };
        grid.neighbours = grid.touching();
        grid
    }

    /// Returns the basis whose cells the grid describes.
    pub fn basis(&self) -> &RingBasis {
        &self.basis
    }

    /// Returns the indices of the cells that touch each cell, ascending.
    fn touching(&self) -> Vec<Vec<u32>> {
        let mut list: Vec<Vec<u32>> = vec![Vec::new(); self.basis.len()];
        for (place, &ring) in self.order.iter().enumerate() {
            let (first, sectors) = (self.basis.first_cell(ring), self.basis.rings()[ring].sectors);
            for k in 0..sectors {
                if sectors > 1 {
                    list[first + k].push((first + (k + 1) % sectors) as u32);
                    list[first + (k + 1) % sectors].push((first + k) as u32);
                }
            }
            if let Some(&outer) = self.order.get(place + 1) {
                // The finer of the two rings decides: each of its cells touches those of the other at its two ends.
                let (fine, coarse) =
                    if self.basis.rings()[outer].sectors >= sectors { (outer, ring) } else { (ring, outer) };
                let theta = 0.5 * (self.basis.rings()[coarse].theta_min + self.basis.rings()[coarse].theta_max);
                for k in 0..self.basis.rings()[fine].sectors {
                    let index = self.basis.first_cell(fine) + k;
                    let cell = self.basis.cell(index);
                    for side in [-0.499, 0.499] {
                        let d = Dir::from_theta_phi(theta, cell.phi + side * cell.width);
                        if let Some(other) = self.basis.index(d) {
                            list[index].push(other as u32);
                            list[other].push(index as u32);
                        }
                    }
                }
            }
        }
        for neighbours in &mut list {
            neighbours.sort_unstable();
            neighbours.dedup();
        }
        list
    }

    /// Returns values on the cells smoothed once: half of each cell's value plus half of the mean over the cells that
    /// touch it.
    pub fn blurred(&self, values: &[f64]) -> Vec<f64> {
        let mean = |i: usize| {
            let around = &self.neighbours[i];
            if around.is_empty() {
                return values[i];
            }
            0.5 * values[i] + 0.5 * around.iter().map(|&j| values[j as usize]).sum::<f64>() / around.len() as f64
        };
        (0..values.len()).map(mean).collect()
    }

    /// Returns the position in `order` of the ring that holds a polar angle \[rad\].
    fn ring_place(&self, theta: f64) -> usize {
        let rings = self.basis.rings();
        self.order.partition_point(|&ring| rings[ring].theta_max <= theta).min(self.order.len() - 1)
    }

    /// Returns the four cells around a direction for bilinear interpolation, each as (index of the ring, index of the
    /// sector, number of sectors of the ring, weight); the weights add up to 1. Linear in θ between the middles of two
    /// rings, and in φ along each. Directions beyond the middles of the outermost rings take these rings' values.
    pub fn around_rings(&self, d: DVec3) -> [(usize, usize, usize, f64); 4] {
        let theta = d.truncate().length().atan2(d.z).min(FRAC_PI_2);
        let own = self.basis.azimuth().own_phi(d.y.atan2(d.x));
        let rings = self.basis.rings();
        let middle = |place: usize| {
            let ring = &rings[self.order[place]];
            if ring.sectors == 1 { ring.theta_min } else { 0.5 * (ring.theta_min + ring.theta_max) }
        };
        let place = self.ring_place(theta);
        let (low, high) = if theta < middle(place) { (place.saturating_sub(1), place) } else { (place, place + 1) };
        let high = high.min(self.order.len() - 1);
        let t = if high > low { ((theta - middle(low)) / (middle(high) - middle(low))).clamp(0.0, 1.0) } else { 0.0 };
        let along = |place: usize| {
            let ring = self.order[place];
            let sectors = rings[ring].sectors;
            let x = (own - rings[ring].first_phi) / (2.0 * PI) * sectors as f64;
            let x = x.rem_euclid(sectors as f64);
            let k = (x as usize).min(sectors - 1);
            (ring, sectors, k, (k + 1) % sectors, x - k as f64)
        };
        let (a, na, a0, a1, s) = along(low);
        let (b, nb, b0, b1, u) = along(high);
        [(a, a0, na, (1.0 - t) * (1.0 - s)), (a, a1, na, (1.0 - t) * s), (b, b0, nb, t * (1.0 - u)), (b, b1, nb, t * u)]
    }

    /// Returns the mean of a function of the direction over a cell, weighted by projected solid angle, from `points`²
    /// directions.
    pub fn cell_mean(&self, cell: usize, points: usize, f: impl Fn(DVec3) -> f64) -> f64 {
        if points <= 1 {
            return f(self.centre[cell]);
        }
        let c = self.basis.cell(cell);
        let (low, high) = (c.theta_min.sin().powi(2), c.theta_max.sin().powi(2));
        let mut sum = 0.0;
        for i in 0..points {
            let theta = (low + (high - low) * (i as f64 + 0.5) / points as f64).sqrt().min(1.0).asin();
            for j in 0..points {
                let phi = c.phi + c.width * ((j as f64 + 0.5) / points as f64 - 0.5);
                let d: Dir<Facade> = Dir::from_theta_phi(theta, phi);
                sum += f(d.vector());
            }
        }
        sum / (points * points) as f64
    }

    /// Calls `visit` with the index of every cell whose centre lies within `radius` \[rad\] of a direction, and of some
    /// neighbours in the same rings.
    pub fn within(&self, centre: DVec3, radius: f64, mut visit: impl FnMut(usize)) {
        let (theta, phi) = (centre.truncate().length().atan2(centre.z), centre.y.atan2(centre.x));
        let rings = self.basis.rings();
        let own = self.basis.azimuth().own_phi(phi);
        let sin_radius = radius.sin();
        for &index in &self.order {
            let ring = &rings[index];
            if ring.theta_max < theta - radius {
                continue;
            }
            if ring.theta_min > theta + radius {
                break;
            }
            let first = self.basis.first_cell(index);
            // Half width of the cap in azimuth, up to its tangent meridians; all round if it contains the pole.
            let reach = if theta > radius && sin_radius < theta.sin() { (sin_radius / theta.sin()).asin() } else { PI };
            let width = 2.0 * PI / ring.sectors as f64;
            let from = ((own - reach - ring.first_phi) / width).floor() as i64;
            let count = ((2.0 * reach / width).ceil() as usize + 2).min(ring.sectors);
            for k in 0..count {
                visit(first + (from + k as i64).rem_euclid(ring.sectors as i64) as usize);
            }
        }
    }
}

/// Greyscale opening of values on cells (local minimum, then smoothing over tens of degrees), computed on coarse cells;
/// it removes narrow peaks.
#[derive(Debug, Clone)]
pub struct Opening {
    coarse_of: Vec<u32>,
    near: Vec<Vec<u32>>,
    /// Coarse cells around every fine cell, with their weights, sum 1.
    spread: Vec<Vec<(u32, f64)>>,
    coarse: usize,
}

impl Opening {
    /// Creates an opening that takes the lowest value within an angle of `reach` and smooths it by a Gaussian of
    /// standard deviation `sigma`. \[rad\]
    pub fn new(grid: &Grid, reach: f64, sigma: f64) -> Self {
        let coarse = RingBasis::equal_area(11);
        let centre: Vec<DVec3> = coarse.cells().map(|cell| cell.centre().vector()).collect();
        let nearest = |d: DVec3| coarse.index(Dir::<Facade>::from_unit(d)).unwrap_or(0) as u32;
        let near = centre
            .iter()
            .map(|a| (0..centre.len() as u32).filter(|&k| a.dot(centre[k as usize]) > reach.cos()).collect())
            .collect();
        let spread = grid
            .centre
            .iter()
            .map(|a| {
                let mut list: Vec<(u32, f64)> = (0..centre.len() as u32)
                    .filter_map(|k| {
                        let cosine = a.dot(centre[k as usize]);
                        (cosine > (3.0 * sigma).cos()).then(|| (k, ((cosine - 1.0) / (sigma * sigma)).exp()))
                    })
                    .collect();
                let sum: f64 = list.iter().map(|(_, w)| w).sum();
                list.iter_mut().for_each(|(_, w)| *w /= sum);
                list
            })
            .collect();
        Self { coarse_of: grid.centre.iter().map(|&d| nearest(d)).collect(), near, spread, coarse: coarse.len() }
    }

    /// Returns the greyscale opening of values on the cells of the grid: the values without narrow peaks, nowhere above
    /// the values themselves.
    pub fn of(&self, values: &[f64]) -> Vec<f64> {
        let mut lowest = vec![f64::INFINITY; self.coarse];
        for (value, &k) in values.iter().zip(&self.coarse_of) {
            lowest[k as usize] = lowest[k as usize].min(*value);
        }
        let eroded: Vec<f64> = self
            .near
            .iter()
            .map(|list| list.iter().map(|&k| lowest[k as usize]).fold(f64::INFINITY, f64::min))
            .collect();
        let smooth = |list: &Vec<(u32, f64)>| {
            let (sum, weight) = list
                .iter()
                .filter(|(k, _)| eroded[*k as usize].is_finite())
                .fold((0.0, 0.0), |(sum, weight), &(k, w)| (sum + w * eroded[k as usize], weight + w));
            if weight > 0.0 { sum / weight } else { 0.0 }
        };
        self.spread.iter().zip(values).map(|(list, &value)| smooth(list).min(value)).collect()
    }
}
