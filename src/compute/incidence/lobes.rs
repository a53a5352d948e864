//! Division of an indicatrix into a smooth base, which does not follow the incident direction, and a few lobes, which
//! do.

use super::grid::{Grid, Opening};
use glam::DVec3;

/// Radius of the opening (minimum filter followed by maximum filter) that finds the base. \[rad\] Chosen with [`BLUR`];
/// both are held by the test `schemes_misplace_what_the_prototypes_did`: responses misplace less than 3 % of the flux
/// of four analytic systems.
const REACH: f64 = 15.0 * std::f64::consts::PI / 180.0;
/// Blur of the opening that finds the base, as a standard deviation. \[rad\] Chosen: half of [`REACH`], held by the
/// same test.
const BLUR: f64 = 7.5 * std::f64::consts::PI / 180.0;
/// Minimum height of a peak as a share of the highest peak, below which it is merged into its neighbour; also the
/// minimum flux of a lobe as a share of the flux of all lobes, below which it is dropped. Chosen; held by the same test
/// as [`REACH`].
const LEAST: f64 = 0.006;
/// Maximum number of lobes of an indicatrix; the light of weaker ones stays in the base. Chosen: cost; further lobes
/// are mostly noise, and the analytic systems of the tests have at most two.
const MOST: usize = 6;
/// Minimum share of the luminance at a lobe's peak that is above the base. Chosen; held by the same test as [`REACH`].
const STANDS_OUT: f64 = 0.4;
/// Share of a lobe's peak below which cells belong to the base and are not shifted. A Gaussian lobe therefore ends at
/// 3.5 standard deviations, beyond which lies 0.2 % of its flux.
const EDGE: f64 = 2e-3;
/// Number of steps of [`Lobe::sharpened`]. Chosen: cost; held by the test
/// `at_the_measured_directions_the_data_come_back`: less than 4.5 % of the flux is misplaced on cells of 8°.
const SHARPENING: usize = 3;
/// Share of the lower of two peaks that the saddle between them reaches when they are one lobe. Chosen; held by the
/// same test as [`REACH`], whose panel has two lobes that meet.
const SADDLE: f64 = 0.9;

/// Lobe of an indicatrix: adjoining emergent cells with the part of q that rises above the smooth base.
#[derive(Debug, Clone, PartialEq)]
pub struct Lobe {
    /// Unit vector to the lobe's centre, its mean weighted by luminance and solid angle, as a direction of undeviated
    /// light (reversed emergent direction, z > 0 in the façade frame).
    pub centre: DVec3,
    /// Flux of the lobe as a share of the incident flux, ∫q cosθ dω.
    pub flux: f64,
    /// Angle about `centre` within which the centres of all its cells lie. \[rad\]
    pub radius: f64,
    /// Values ring by ring: index of the ring in the basis, first sector, values. \[1/sr\]
    rows: Vec<(usize, usize, Vec<f64>)>,
    /// Index in the basis of the ring of the first entry of `rows`.
    first_ring: usize,
}

impl Lobe {
    /// Returns the lobe's q in a cell, given by the indices of its ring and sector in the basis and by the number of
    /// sectors of that ring; 0 outside the lobe. \[1/sr\]
    #[inline]
    pub fn value(&self, ring: usize, sector: usize, sectors: usize) -> f64 {
        let Some((_, first, values)) = ring.checked_sub(self.first_ring).and_then(|k| self.rows.get(k)) else {
            return 0.0;
        };
        let k = if sector >= *first { sector - first } else { sector + sectors - first };
        values.get(k).copied().unwrap_or(0.0)
    }

    /// Returns the indices of the lobe's cells and its q there. \[1/sr\]
    pub fn cells<'a>(&'a self, grid: &'a Grid) -> impl Iterator<Item = (usize, f64)> + 'a {
        self.rows.iter().flat_map(move |(ring, first, values)| {
            let (start, sectors) = (grid.basis().first_cell(*ring), grid.basis().rings()[*ring].sectors);
            values.iter().enumerate().filter(|(_, q)| **q != 0.0).map(move |(k, q)| (start + (first + k) % sectors, *q))
        })
    }

    /// Returns the lobe with values at cell centres whose linear interpolation has the lobe's means over the cells.
    /// This undoes the blur of means and interpolation, so that a lobe can be shifted by a fraction of a cell without
    /// becoming wider.
    pub fn sharpened(&self, grid: &Grid) -> Self {
        let mut points = self.clone();
        for _ in 0..SHARPENING {
            let errors: Vec<(usize, usize, f64)> = self
                .rows
                .iter()
                .enumerate()
                .flat_map(|(row, (ring, first, values))| {
                    let points = &points;
                    let sectors = grid.basis().rings()[*ring].sectors;
                    values.iter().enumerate().filter(|(_, q)| **q != 0.0).map(move |(k, q)| {
                        let cell = grid.basis().first_cell(*ring) + (first + k) % sectors;
                        (row, k, q - grid.cell_mean(cell, 3, |d| points.at(grid, d)))
                    })
                })
                .collect();
            for (row, k, error) in errors {
                let value = &mut points.rows[row].2[k];
                *value = (*value + error).max(0.0);
            }
        }
        points
    }

    /// Returns the typical width of the lobe's cells: the square root of their mean solid angle. \[rad\]
    pub fn cell_width(&self, grid: &Grid) -> f64 {
        let (sum, count) = self.cells(grid).fold((0.0, 0), |(sum, count), (i, _)| (sum + grid.solid[i], count + 1));
        (sum / f64::from(count.max(1))).sqrt()
    }

    /// Returns the lobe's q in a direction, linear between cell centres. \[1/sr\]
    pub fn at(&self, grid: &Grid, d: DVec3) -> f64 {
        if d.z <= 0.0 {
            return 0.0;
        }
        grid.around_rings(d).into_iter().map(|(ring, sector, sectors, w)| w * self.value(ring, sector, sectors)).sum()
    }

    /// Creates a lobe from the indices of its cells and its q there \[1/sr\]; `None` without flux.
    fn new(grid: &Grid, cells: &[(usize, f64)]) -> Option<Self> {
        let flux: f64 = cells.iter().map(|&(i, q)| q * grid.projected[i]).sum();
        let centre: DVec3 = cells.iter().map(|&(i, q)| grid.centre[i] * (q * grid.solid[i])).sum();
        let centre = centre.try_normalize().filter(|_| flux > 0.0)?;
        let radius = cells.iter().map(|&(i, _)| grid.centre[i].dot(centre)).fold(1.0, f64::min).clamp(-1.0, 1.0).acos();
        let basis = grid.basis();
        let mut by_ring: std::collections::BTreeMap<usize, Vec<(usize, f64)>> = std::collections::BTreeMap::new();
        for &(i, q) in cells {
            let ring = (0..basis.rings().len()).rev().find(|&r| basis.first_cell(r) <= i)?;
            by_ring.entry(ring).or_default().push((i - basis.first_cell(ring), q));
        }
        let (&first_ring, &last_ring) = (by_ring.keys().next()?, by_ring.keys().next_back()?);
        let rows = (first_ring..=last_ring)
            .map(|ring| {
                let Some(list) = by_ring.get_mut(&ring) else {
                    return (ring, 0, Vec::new());
                };
                list.sort_by_key(|&(sector, _)| sector);
                let sectors = basis.rings()[ring].sectors;
                // Starts behind the widest gap, so that the row is as short as it can be on a circle.
                let gap = |k: usize| {
                    let next = if k + 1 == list.len() { list[0].0 + sectors } else { list[k + 1].0 };
                    next - list[k].0
                };
                let widest = (0..list.len()).max_by_key(|&k| gap(k)).unwrap_or(0);
                let first = list[(widest + 1) % list.len()].0;
                let mut values = Vec::new();
                for &(sector, q) in list.iter() {
                    let k = (sector + sectors - first) % sectors;
                    if values.len() <= k {
                        values.resize(k + 1, 0.0);
                    }
                    values[k] = q;
                }
                (ring, first, values)
            })
            .collect();
        Some(Self { centre, flux, radius, rows, first_ring })
    }
}

/// Splitter of indicatrices into a smooth base and lobes.
#[derive(Debug, Clone)]
pub struct Splitter {
    opening: Opening,
}

impl Splitter {
    /// Creates a splitter for indicatrices on the emergent cells of a grid.
    pub fn new(grid: &Grid) -> Self {
        Self { opening: Opening::new(grid, REACH, BLUR) }
    }

    /// Returns the lobes of an indicatrix `q` \[1/sr\] on the cells of `grid`, largest flux first. The remainder of `q`
    /// is the base.
    pub fn lobes(&self, grid: &Grid, q: &[f64]) -> Vec<Lobe> {
        let base = self.opening.of(q);
        let sharp: Vec<f64> = q.iter().zip(&base).map(|(q, b)| (q - b).max(0.0)).collect();
        let total: f64 = sharp.iter().zip(&grid.projected).map(|(q, w)| q * w).sum();
        let all: f64 = q.iter().zip(&grid.projected).map(|(q, w)| q * w).sum();
        // Below these limits, the light above the base is noise on a diffuser, no lobe.
        if total <= 0.005 * all || total < 1e-6 {
            return Vec::new();
        }
        let owner = basins(grid, &grid.blurred(&sharp));
        let mut peaks: std::collections::BTreeMap<u32, f64> = std::collections::BTreeMap::new();
        for (&owner, &q) in owner.iter().zip(&sharp) {
            let peak = peaks.entry(owner).or_insert(0.0);
            *peak = peak.max(q);
        }
        let mut cells: std::collections::BTreeMap<u32, Vec<(usize, f64)>> = std::collections::BTreeMap::new();
        for (i, (&owner, &q)) in owner.iter().zip(&sharp).enumerate() {
            if owner != NONE && q > EDGE * peaks[&owner] {
                cells.entry(owner).or_default().push((i, q));
            }
        }
        // A peak that rises too little above the base is a slope of the base, no lobe.
        let stands_out = |cells: &&Vec<(usize, f64)>| {
            let &(top, height) = cells.iter().max_by(|a, b| a.1.total_cmp(&b.1)).expect("a basin has cells");
            height > STANDS_OUT * q[top]
        };
        let mut lobes: Vec<Lobe> =
            cells.values().filter(stands_out).filter_map(|cells| Lobe::new(grid, cells)).collect();
        lobes.retain(|lobe| lobe.flux > LEAST * total);
        lobes.sort_by(|a, b| b.flux.total_cmp(&a.flux));
        lobes.truncate(MOST);
        lobes
    }
}

/// Owner of a cell that belongs to no peak: larger than any number of a peak.
const NONE: u32 = u32::MAX;

/// Returns for every cell the index of the peak that steepest ascent leads to; peaks without a distinct saddle between
/// them count as one.
fn basins(grid: &Grid, values: &[f64]) -> Vec<u32> {
    let highest = values.iter().copied().fold(0.0, f64::max);
    let mut rank: Vec<u32> = (0..values.len() as u32).filter(|&i| values[i as usize] > 1e-4 * highest).collect();
    rank.sort_by(|&a, &b| values[b as usize].total_cmp(&values[a as usize]).then(a.cmp(&b)));
    let mut owner = vec![NONE; values.len()];
    // Flooding from the top: a cell that joins two basins is the saddle between them.
    let mut parent: Vec<u32> = Vec::new();
    let mut peak: Vec<f64> = Vec::new();
    fn root(parent: &[u32], mut k: u32) -> u32 {
        while parent[k as usize] != k {
            k = parent[k as usize];
        }
        k
    }
    for &i in &rank {
        let value = values[i as usize];
        let mut best: Option<(f64, u32)> = None;
        let mut met: Vec<u32> = Vec::new();
        for &j in &grid.neighbours[i as usize] {
            if owner[j as usize] != NONE {
                let basin = root(&parent, owner[j as usize]);
                if !met.contains(&basin) {
                    met.push(basin);
                }
                if best.is_none_or(|(v, _)| values[j as usize] > v) {
                    best = Some((values[j as usize], owner[j as usize]));
                }
            }
        }
        match best {
            None => {
                owner[i as usize] = parent.len() as u32;
                parent.push(parent.len() as u32);
                peak.push(value);
            }
            Some((_, own)) => {
                owner[i as usize] = own;
                let strongest = met.iter().copied().max_by(|&a, &b| peak[a as usize].total_cmp(&peak[b as usize]));
                for &basin in &met {
                    let Some(strongest) = strongest else { break };
                    let small = peak[basin as usize] < LEAST * highest;
                    if basin != strongest && (small || value >= SADDLE * peak[basin as usize]) {
                        parent[basin as usize] = strongest;
                    }
                }
            }
        }
    }
    owner.iter().map(|&k| if k == NONE { NONE } else { root(&parent, k) }).collect()
}
