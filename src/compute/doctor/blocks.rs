//! Functions of a band on common cells, by through direction, so that any two can be compared number by number.

use crate::compute::basis::{AzimuthMap, RingBasis};
use crate::compute::btdf::{Band, Component, Dataset, Scattered, matrix_roughly_on};
use crate::compute::direction::Dir;
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// Maximum number of cells on which functions are compared; finer functions are compared on Klems cells. Chosen: cost,
/// which grows with its square. No test of its own.
const MOST_CELLS: usize = 700;

/// One function on the common cells: `q[i · n + o]`, incident cell i, emergent cell o (through direction).
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// Values. \[1/sr\]
    pub q: Vec<f64>,
    /// Direct-hemispherical transmittance or reflectance of every incident cell.
    pub tau: Vec<f64>,
}

/// Rotation or mirror image of the hemisphere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Turn {
    /// Up and down exchanged.
    UpDown,
    /// Left and right exchanged.
    LeftRight,
    /// Rotation by 180° about the normal.
    HalfRound,
    /// Rotation by 90° about the normal.
    QuarterRound,
}

/// Functions of a band on common cells.
#[derive(Debug, Clone)]
pub struct Blocks {
    /// Common cells, counted as in the façade frame.
    pub basis: RingBasis,
    /// Projected solid angles. \[sr\]
    pub weight: Vec<f64>,
    /// Cosine of the polar angle that represents each cell.
    pub cosine: Vec<f64>,
    /// Transmission front, transmission back, reflection front, reflection back; `None` where the file itself does not
    /// have the function.
    pub given: [Option<Block>; 4],
    turns: [Vec<usize>; 4],
}

impl Blocks {
    /// Creates the blocks of a band from the functions that the source itself holds; `None` if it holds none.
    pub fn new(dataset: &Dataset, band: &Band) -> Option<Self> {
        // Functions derived by reciprocity would agree with their origin whatever is wrong. The dataset's list is about
        // its visible band alone.
        let visible = std::ptr::eq(band, &dataset.visible);
        let own = |component: &Component| !(visible && dataset.derived.contains(component));
        let components: Vec<Component> = band.components().into_iter().filter(own).collect();
        // On the data's own cells nothing is blurred by resampling. They serve where incident and emergent cells are
        // the same ones, few enough for all pairs, and mapped onto each other by turns; else Klems' do.
        let basis = components
            .iter()
            .find_map(|component| match &band.get(*component)?.scattered {
                Some(Scattered::Cells(matrix)) if matrix.incident().rings() == matrix.emergent().rings() => {
                    (matrix.incident().len() <= MOST_CELLS && even(matrix.incident()))
                        .then(|| matrix.incident().clone().with_azimuth(AzimuthMap::FACADE))
                }
                _ => None,
            })
            .unwrap_or_else(|| RingBasis::klems_full(AzimuthMap::FACADE));
        let mut given = [const { None }; 4];
        for component in &components {
            let matrix = matrix_roughly_on(band.get(*component)?, &basis, &basis);
            given[*component as usize] =
                Some(Block { tau: matrix.tau_by_cell().to_vec(), q: matrix.values().into_owned() });
        }
        // On cells counted by through-names a turn only exchanges numbers. A cell without an image stands for itself.
        let turned = |turn: fn(DVec3) -> DVec3| -> Vec<usize> {
            let place = |d: Dir<_>| basis.index(Dir::from_unit(turn(d.vector())));
            basis.cells().enumerate().map(|(k, cell)| place(cell.centre()).unwrap_or(k)).collect()
        };
        let turns = [
            turned(|v| DVec3::new(v.x, -v.y, v.z)),
            turned(|v| DVec3::new(-v.x, v.y, v.z)),
            turned(|v| DVec3::new(-v.x, -v.y, v.z)),
            turned(|v| DVec3::new(-v.y, v.x, v.z)),
        ];
        let (weight, cosine) = (basis.projected_solid_angles(), basis.cells().map(|cell| cell.theta().cos()).collect());
        (!components.is_empty()).then_some(Self { basis, weight, cosine, given, turns })
    }

    /// Returns the block of one function.
    pub fn get(&self, component: Component) -> Option<&Block> {
        self.given[component as usize].as_ref()
    }

    /// Returns the index of the cell that `cell` becomes by a turn.
    pub fn turned(&self, turn: Turn, cell: usize) -> usize {
        match turn {
            Turn::UpDown => self.turns[0][cell],
            Turn::LeftRight => self.turns[1][cell],
            Turn::HalfRound => self.turns[2][cell],
            Turn::QuarterRound => self.turns[3][cell],
        }
    }

    /// Returns Σ w|a − b| / Σ w(a + b)/2 over all pairs of cells, w the product of projected solid angles; 0 for two
    /// zeros.
    pub fn difference(&self, a: impl Fn(usize, usize) -> f64, b: impl Fn(usize, usize) -> f64) -> f64 {
        let (mut difference, mut sum) = (0.0, 0.0);
        let n = self.weight.len();
        for i in 0..n {
            for o in 0..n {
                let w = self.weight[i] * self.weight[o];
                let (a, b) = (a(i, o), b(i, o));
                difference += w * (a - b).abs();
                sum += 0.5 * w * (a + b).abs();
            }
        }
        if sum > 0.0 { difference / sum } else { 0.0 }
    }

    /// Returns the relative difference between a function and its own image under a turn.
    pub fn asymmetry(&self, block: &Block, turn: Turn) -> f64 {
        let n = self.weight.len();
        self.difference(|i, o| block.q[i * n + o], |i, o| block.q[self.turned(turn, i) * n + self.turned(turn, o)])
    }

    /// Returns the reciprocity error of a function against itself. Reflections fulfil it exactly: f(ω_i, ω_r) = f(ω_r,
    /// ω_i) reads, by through direction, q(i, o) = q(o turned by 180°, i turned by 180°). The transmission of systems
    /// that are alike on both sides fulfils it too.
    pub fn own_reciprocity(&self, block: &Block, factor: impl Fn(usize) -> f64) -> f64 {
        let n = self.weight.len();
        let turn = |k| self.turned(Turn::HalfRound, k);
        self.difference(|i, o| block.q[i * n + o] * factor(o), |i, o| block.q[turn(o) * n + turn(i)] * factor(i))
    }

    /// Returns the mean of τ over each ring, from the normal outwards, with its polar angle. \[rad\]
    pub fn tau_by_ring(&self, block: &Block) -> Vec<(f64, f64)> {
        self.by_ring(&block.tau)
    }

    /// Returns the ring means of the reversed function: the light that would leave if emergence were incidence.
    pub fn reversed_tau_by_ring(&self, block: &Block) -> Vec<(f64, f64)> {
        let n = self.weight.len();
        let sums: Vec<f64> = (0..n).map(|o| (0..n).map(|i| self.weight[i] * block.q[i * n + o]).sum()).collect();
        self.by_ring(&sums)
    }

    /// Returns the means of cell values over the rings, from the normal outwards, with the polar angle of each. \[rad\]
    pub(super) fn by_ring(&self, values: &[f64]) -> Vec<(f64, f64)> {
        let mean = |ring: usize| {
            let (from, to) =
                (self.basis.first_cell(ring), self.basis.first_cell(ring) + self.basis.rings()[ring].sectors);
            (self.basis.cell(from).theta(), values[from..to].iter().sum::<f64>() / (to - from) as f64)
        };
        let mut rings: Vec<(f64, f64)> = (0..self.basis.rings().len()).map(mean).collect();
        rings.sort_by(|a, b| a.0.total_cmp(&b.0));
        rings
    }

    /// Returns the mean of τ over the hemisphere, weighted by projected solid angle.
    pub fn hemispherical(&self, block: &Block) -> f64 {
        block.tau.iter().zip(&self.weight).map(|(tau, w)| tau * w).sum::<f64>() / std::f64::consts::PI
    }

    /// Returns the share of the light that stays in its cell.
    pub fn straight_share(&self, block: &Block) -> f64 {
        let n = self.weight.len();
        let straight: f64 = (0..n).map(|k| block.q[k * n + k] * self.weight[k] * self.weight[k]).sum();
        let all: f64 = block.tau.iter().zip(&self.weight).map(|(tau, w)| tau * w).sum();
        if all > 0.0 { straight / all } else { 0.0 }
    }
}

/// Whether all turns map the cells onto each other: complete rings, sectors centred on the horizontal, an even number.
fn even(basis: &RingBasis) -> bool {
    let mut rings = basis.rings().to_vec();
    rings.sort_by(|a, b| a.theta_min.total_cmp(&b.theta_min));
    let complete = rings.windows(2).all(|w| (w[0].theta_max - w[1].theta_min).abs() < 1e-9)
        && rings.first().is_some_and(|ring| ring.theta_min == 0.0)
        && rings.last().is_some_and(|ring| (ring.theta_max - FRAC_PI_2).abs() < 1e-9);
    let own = basis.azimuth();
    let aligned = own.offset.rem_euclid(FRAC_PI_2).min(FRAC_PI_2 - own.offset.rem_euclid(FRAC_PI_2)) < 1e-9;
    complete
        && aligned
        && rings.iter().all(|ring| ring.first_phi == 0.0 && (ring.sectors == 1 || ring.sectors % 2 == 0))
}
