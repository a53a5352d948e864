//! The functions of a band on common cells in through-names, so that any two can be compared number by number.

use crate::compute::basis::{AzimuthMap, RingBasis};
use crate::compute::btdf::{Band, Component, Dataset, Scattered, matrix_roughly_on};
use crate::compute::direction::Dir;
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// Finer functions are compared on coarser cells.
const MOST_CELLS: usize = 700;

/// One function on the common cells: `q[i · n + o]`, incident cell i, emergent cell o (through-name).
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// Values. \[1/sr\]
    pub q: Vec<f64>,
    /// Directional-hemispherical value of every incident cell.
    pub tau: Vec<f64>,
}

/// A turn or mirror image of the hemisphere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Turn {
    /// Up and down exchanged.
    UpDown,
    /// Left and right exchanged.
    LeftRight,
    /// By 180° about the normal.
    HalfRound,
    /// By 90° about the normal.
    QuarterRound,
}

/// The functions of a band on common cells.
#[derive(Debug, Clone)]
pub struct Blocks {
    /// The cells, counted as the façade frame does.
    pub basis: RingBasis,
    /// Projected solid angles. \[sr\]
    pub weight: Vec<f64>,
    /// Cosine of the angle that stands for each cell.
    pub cosine: Vec<f64>,
    /// Transmission front, transmission back, reflection front, reflection back, as far as the file itself has them.
    pub given: [Option<Block>; 4],
    turns: [Vec<usize>; 4],
}

impl Blocks {
    /// The functions of a band that the source itself holds; `None` without any.
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

    /// One function.
    pub fn get(&self, component: Component) -> Option<&Block> {
        self.given[component as usize].as_ref()
    }

    /// The cell that a cell becomes.
    pub fn turned(&self, turn: Turn, cell: usize) -> usize {
        match turn {
            Turn::UpDown => self.turns[0][cell],
            Turn::LeftRight => self.turns[1][cell],
            Turn::HalfRound => self.turns[2][cell],
            Turn::QuarterRound => self.turns[3][cell],
        }
    }

    /// Σ w|a − b| / Σ w(a + b)/2 over all pairs of cells, w the product of projected solid angles; 0 for two zeros.
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

    /// How far a function is from its own image under a turn.
    pub fn asymmetry(&self, block: &Block, turn: Turn) -> f64 {
        let n = self.weight.len();
        self.difference(|i, o| block.q[i * n + o], |i, o| block.q[self.turned(turn, i) * n + self.turned(turn, o)])
    }

    /// Reciprocity error of a function against itself: exact for reflections, in names r = f(ω_i, ω_r) =
    /// f(ω_r, ω_i) is q(i, o) = q(o turned by 180°, i turned by 180°); for the transmission of systems that are alike
    /// on both sides the same.
    pub fn own_reciprocity(&self, block: &Block, factor: impl Fn(usize) -> f64) -> f64 {
        let n = self.weight.len();
        let turn = |k| self.turned(Turn::HalfRound, k);
        self.difference(|i, o| block.q[i * n + o] * factor(o), |i, o| block.q[turn(o) * n + turn(i)] * factor(i))
    }

    /// Mean of τ over the rings, from the normal outwards, with the polar angle of each. \[rad\]
    pub fn tau_by_ring(&self, block: &Block) -> Vec<(f64, f64)> {
        self.by_ring(&block.tau)
    }

    /// The same of the function read the other way round: the light that would leave if emergence were incidence.
    pub fn reversed_tau_by_ring(&self, block: &Block) -> Vec<(f64, f64)> {
        let n = self.weight.len();
        let sums: Vec<f64> = (0..n).map(|o| (0..n).map(|i| self.weight[i] * block.q[i * n + o]).sum()).collect();
        self.by_ring(&sums)
    }

    /// Means of values of the cells over the rings, from the normal outwards, with the polar angle of each. \[rad\]
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

    /// Mean over the hemisphere by projected solid angle.
    pub fn hemispherical(&self, block: &Block) -> f64 {
        block.tau.iter().zip(&self.weight).map(|(tau, w)| tau * w).sum::<f64>() / std::f64::consts::PI
    }

    /// Share of the light that keeps its cell.
    pub fn straight_share(&self, block: &Block) -> f64 {
        let n = self.weight.len();
        let straight: f64 = (0..n).map(|k| block.q[k * n + k] * self.weight[k] * self.weight[k]).sum();
        let all: f64 = block.tau.iter().zip(&self.weight).map(|(tau, w)| tau * w).sum();
        if all > 0.0 { straight / all } else { 0.0 }
    }
}

/// Do all turns map the cells onto each other? Complete rings, sectors centred on the horizontal, an even number.
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
