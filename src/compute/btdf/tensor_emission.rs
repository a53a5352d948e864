//! Luminances and indicatrices by a tensor tree, summed over its leaves without expanding it to a full matrix.

use super::Indicatrix;
use super::pyramid::Pyramid;
use super::tensor_tree::{TensorTree, TreeNode, TreeRank};
use crate::compute::basis::{RingBasis, SquareGrid};
use crate::compute::direction::Incident;
use std::f64::consts::PI;

impl TensorTree {
    /// Computes the emergent luminance \[cd/m²\] from the illuminance \[lx\] of the system from every cell of
    /// [`TensorTree::incident_grid`] (façade frame, row by row). Panics if the number of illuminances is not that of
    /// the cells.
    ///
    /// The result is given on [`RingBasis::equal_area`]: the emergent grid of the tree with straightened azimuth
    /// borders, with the flux conserved ring by ring (see [`SquareGrid::to_rings`]). Rank 3: the emergent distribution
    /// rotates with the azimuth of every incident cell, and is spread over the cell's width.
    pub fn luminance(&self, illuminance: &[f64]) -> (RingBasis, Vec<f64>) {
        let grid = self.incident_grid();
        assert_eq!(illuminance.len(), grid.len(), "one illuminance an incident cell");
        let luminance = match self.rank() {
            TreeRank::Four => grid.to_rings(&self.luminance_anisotropic(illuminance)),
            TreeRank::Three => self.luminance_isotropic(&grid.to_rings(illuminance)),
        };
        (grid.rings(), luminance)
    }

    /// Computes the emergent luminance \[cd/m²\] from illuminances like [`TensorTree::luminance`], but on the emergent
    /// square grid itself (façade frame, row by row); `None` for rank 3, whose emergent grid rotates with the incident
    /// direction.
    pub fn luminance_on_grid(&self, illuminance: &[f64]) -> Option<Vec<f64>> {
        assert_eq!(illuminance.len(), self.incident_grid().len(), "one illuminance an incident cell");
        (self.rank() == TreeRank::Four).then(|| self.luminance_anisotropic(illuminance))
    }

    /// Computes the emergent luminance \[cd/m²\] of a tree of rank 4 from the illuminances \[lx\] from the cells of its
    /// incident grid, both in the façade frame, row by row.
    fn luminance_anisotropic(&self, illuminance: &[f64]) -> Vec<f64> {
        let grid = self.incident_grid();
        let own = Pyramid::gather(grid.level(), self.turned(illuminance));
        let mut out = Pyramid::new(grid.level());
        self.for_each_leaf(&mut |level, corner, q| {
            let e = own.get(level, corner[0], corner[1]);
            if e != 0.0 && q != 0.0 {
                *out.at(level, corner[2], corner[3]) += q * e;
            }
        });
        self.turned(&out.spread())
    }

    /// Computes the emergent luminance \[cd/m²\] by light from one incident direction with the given illuminance of the
    /// system \[lx\].
    pub fn sun_luminance(&self, incident: Incident, illuminance: f64) -> (RingBasis, Vec<f64>) {
        let Indicatrix { basis, mut q } = self.indicatrix(incident);
        q.iter_mut().for_each(|q| *q *= illuminance);
        (basis, q)
    }

    /// Returns the emergent distribution of the incident cell that contains the direction, on
    /// [`RingBasis::equal_area`]; rotated to the exact azimuth for rank 3. All values are 0 for z < 0.
    pub fn indicatrix(&self, incident: Incident) -> Indicatrix {
        let grid = self.incident_grid();
        let q = match (self.disk(incident.0), self.rank()) {
            (None, _) => vec![0.0; grid.len()],
            (Some(disk), TreeRank::Four) => {
                let [ix, iy] = grid.position(disk);
                grid.to_rings(&self.turned(&self.slice(&[ix, iy])))
            }
            (Some(disk), TreeRank::Three) => {
                let row = self.relative_row(self.ring(disk));
                turn_rings(grid, &row, incident.0.phi())
            }
        };
        Indicatrix { basis: grid.rings(), q }
    }

    /// Returns q on the emergent square, in the tree's axes, for one finest incident cell given by its incident
    /// coordinates. \[1/sr\]
    fn slice(&self, incident: &[usize]) -> Vec<f64> {
        let mut out = Pyramid::new(self.incident_grid().level());
        self.slice_node(0, 0, incident, [0, 0], &mut out);
        out.spread()
    }

    fn slice_node(&self, index: usize, level: u32, incident: &[usize], corner: [usize; 2], out: &mut Pyramid) {
        match self.nodes()[index] {
            TreeNode::Leaf(q) => *out.at(level, corner[0], corner[1]) = q,
            TreeNode::Branch(first) => {
                let shift = self.incident_grid().level() - level - 1;
                let fixed = incident.iter().enumerate().fold(0, |bits, (d, at)| bits | (at >> shift & 1) << d);
                for child in 0..4 {
                    let below = [2 * corner[0] + (child & 1), 2 * corner[1] + (child >> 1)];
                    let node = first as usize + (fixed | child << incident.len());
                    self.slice_node(node, level + 1, incident, below, out);
                }
            }
        }
    }

    /// Returns q on the ring cells for incident directions in one ring of sinθ at azimuth 0 of the façade frame (rank
    /// 3). \[1/sr\]
    fn relative_row(&self, ring: usize) -> Vec<f64> {
        let grid = self.incident_grid();
        let resolution = grid.resolution();
        let own = self.slice(&[resolution / 2 - 1 - ring]);
        // Both kinds of axes mirror azimuths, so the relative azimuth changes its sign.
        let mirrored: Vec<f64> =
            (0..resolution).rev().flat_map(|iy| own[iy * resolution..][..resolution].to_vec()).collect();
        grid.to_rings(&mirrored)
    }

    /// Converts values on a grid in the tree's axes to the façade frame, or vice versa.
    fn turned(&self, values: &[f64]) -> Vec<f64> {
        let resolution = self.incident_grid().resolution();
        (0..values.len())
            .map(|k| {
                let [ix, iy] = self.axes().turn_cell([k % resolution, k / resolution], resolution);
                values[iy * resolution + ix]
            })
            .collect()
    }

    /// Computes the luminance of the emergent ring cells by the illuminances from the incident ring cells, for a tree
    /// of rank 3. \[cd/m²\]
    fn luminance_isotropic(&self, illuminance: &[f64]) -> Vec<f64> {
        let grid = self.incident_grid();
        let rings = grid.resolution() / 2;
        let mut luminance = vec![0.0; grid.len()];
        for ring in 0..rings {
            let arriving = &illuminance[ring_cells(ring)];
            if arriving.iter().all(|e| *e == 0.0) {
                continue;
            }
            let row = self.relative_row(ring);
            for out in 0..rings {
                let (q, l) = (&row[ring_cells(out)], &mut luminance[ring_cells(out)]);
                let n = q.len();
                if q.iter().all(|q| *q == 0.0) {
                    continue;
                }
                for (t, e) in sectors(arriving, n).into_iter().enumerate().filter(|(_, e)| *e != 0.0) {
                    for (u, q) in q.iter().enumerate() {
                        // The azimuth of the sum of two sectors is distributed as a triangle from (t + u) to (t + u +
                        // 2) sector widths.
                        let half = 0.5 * e * q;
                        l[(t + u) % n] += half;
                        l[(t + u + 1) % n] += half;
                    }
                }
            }
        }
        luminance
    }
}

/// Returns the range of the cells of one ring of [`RingBasis::equal_area`].
fn ring_cells(ring: usize) -> std::ops::Range<usize> {
    4 * ring * ring..4 * (ring + 1) * (ring + 1)
}

/// Distributes totals of equal sectors over `n` equal sectors, both starting at azimuth 0.
fn sectors(totals: &[f64], n: usize) -> Vec<f64> {
    let mut out = vec![0.0; n];
    let ratio = n as f64 / totals.len() as f64;
    for (k, total) in totals.iter().enumerate() {
        let (from, to) = (k as f64 * ratio, (k + 1) as f64 * ratio);
        let mut sector = from as usize;
        while sector < n && (sector as f64) < to - 1e-12 {
            let common = to.min((sector + 1) as f64) - from.max(sector as f64);
            out[sector] += total * common / ratio;
            sector += 1;
        }
    }
    out
}

/// Returns values on ring cells rotated by an azimuth; the value of a sector is divided between the two sectors that it
/// then overlaps.
fn turn_rings(grid: SquareGrid, values: &[f64], phi: f64) -> Vec<f64> {
    let mut out = vec![0.0; values.len()];
    for ring in 0..grid.resolution() / 2 {
        let (from, to) = (&values[ring_cells(ring)], &mut out[ring_cells(ring)]);
        let n = from.len();
        let shift = phi / (2.0 * PI) * n as f64;
        let (whole, part) = (shift.floor() as usize, shift - shift.floor());
        for (k, q) in from.iter().enumerate() {
            to[(k + whole) % n] += (1.0 - part) * q;
            to[(k + whole + 1) % n] += part * q;
        }
    }
    out
}
