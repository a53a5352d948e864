//! Transmission and reflection functions of a band on common cells of directions of undeviated light, so that any two
//! can be compared value by value.

use crate::compute::basis::{AzimuthMap, RingBasis};
use crate::compute::btdf::{Band, Component, Dataset, Scattered, matrix_roughly_on};
use crate::compute::direction::Dir;
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// Maximum number of cells on which functions are compared; functions on finer cells are averaged over Klems cells
/// first. Chosen: cost, which grows with its square. No test of its own.
const MOST_CELLS: usize = 700;

/// One function of a band (transmission or reflection of one side) on the common cells; both incident and emergent
/// cells contain directions of undeviated light.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// Luminance coefficients q for incident cell i and emergent cell o of n cells, at index `i · n + o`. \[1/sr\]
    pub q: Vec<f64>,
    /// Direct-hemispherical transmittance or reflectance of every incident cell.
    pub tau: Vec<f64>,
}

/// Rotation or reflection that maps the hemisphere of directions onto itself.
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

/// Functions of a band on common cells, with the weights of these.
#[derive(Debug, Clone)]
pub struct Blocks {
    /// Common cells, with azimuths as in the façade frame.
    pub basis: RingBasis,
    /// Projected solid angle of each cell. \[sr\]
    pub weight: Vec<f64>,
    /// Cosine of the polar angle that represents each cell.
    pub cosine: Vec<f64>,
    /// Functions in the order of [`Component::ALL`]: transmission front, transmission back, reflection front,
    /// reflection back; `None` where the source file does not contain the function.
    pub given: [Option<Block>; 4],
    turns: [Vec<usize>; 4],
}

impl Blocks {
    /// Creates the functions of a band on common cells from those that the source file contains, without derived ones;
    /// `None` if it contains none.
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

    /// Returns one function on the common cells; `None` if the source file does not contain it.
    pub fn get(&self, component: Component) -> Option<&Block> {
        self.given[component as usize].as_ref()
    }

    /// Returns the index of the cell onto which `turn` maps the cell `cell`.
    pub fn turned(&self, turn: Turn, cell: usize) -> usize {
        match turn {
            Turn::UpDown => self.turns[0][cell],
            Turn::LeftRight => self.turns[1][cell],
            Turn::HalfRound => self.turns[2][cell],
            Turn::QuarterRound => self.turns[3][cell],
        }
    }

    /// Returns the relative difference of two functions `a(i, o)` and `b(i, o)`: Σ w|a − b| / Σ w(a + b)/2 over all
    /// pairs of cells, w the product of their projected solid angles; 0 if both are 0 everywhere.
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

    /// Returns the relative difference between a function and its image under a rotation or reflection of all
    /// directions (see [`Self::difference`]).
    pub fn asymmetry(&self, block: &Block, turn: Turn) -> f64 {
        let n = self.weight.len();
        self.difference(|i, o| block.q[i * n + o], |i, o| block.q[self.turned(turn, i) * n + self.turned(turn, o)])
    }

    /// Returns the relative difference between a function, multiplied by `factor` of the emergent cell, and its
    /// reverse. It is 0 for every reflection: f(ω_i, ω_r) = f(ω_r, ω_i) reads, by directions of undeviated light, q(i,
    /// o) = q(o turned by 180°, i turned by 180°). It is 0 also for the transmission of systems that are alike on both
    /// sides.
    pub fn own_reciprocity(&self, block: &Block, factor: impl Fn(usize) -> f64) -> f64 {
        let n = self.weight.len();
        let turn = |k| self.turned(Turn::HalfRound, k);
        self.difference(|i, o| block.q[i * n + o] * factor(o), |i, o| block.q[turn(o) * n + turn(i)] * factor(i))
    }

    /// Returns for each ring of cells, from the normal outwards, its polar angle \[rad\] and the mean
    /// direct-hemispherical value τ (or ρ) of the function over it.
    pub fn tau_by_ring(&self, block: &Block) -> Vec<(f64, f64)> {
        self.by_ring(&block.tau)
    }

    /// Returns for each ring of cells, from the normal outwards, its polar angle \[rad\] and the mean
    /// direct-hemispherical value of the function with incident and emergent directions exchanged.
    pub fn reversed_tau_by_ring(&self, block: &Block) -> Vec<(f64, f64)> {
        let n = self.weight.len();
        let sums: Vec<f64> = (0..n).map(|o| (0..n).map(|i| self.weight[i] * block.q[i * n + o]).sum()).collect();
        self.by_ring(&sums)
    }

    /// Returns for each ring of cells, from the normal outwards, its polar angle \[rad\] and the mean of `values`,
    /// given per cell, over it.
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

    /// Returns the hemispherical transmittance (or reflectance) of the function: the mean of its direct-hemispherical
    /// values, weighted by projected solid angle.
    pub fn hemispherical(&self, block: &Block) -> f64 {
        block.tau.iter().zip(&self.weight).map(|(tau, w)| tau * w).sum::<f64>() / std::f64::consts::PI
    }

    /// Returns the share of the transmitted (or reflected) light, under uniform incident light, that leaves in the cell
    /// that it came from; near 1 for panes and mirrors.
    pub fn straight_share(&self, block: &Block) -> f64 {
        let n = self.weight.len();
        let straight: f64 = (0..n).map(|k| block.q[k * n + k] * self.weight[k] * self.weight[k]).sum();
        let all: f64 = block.tau.iter().zip(&self.weight).map(|(tau, w)| tau * w).sum();
        if all > 0.0 { straight / all } else { 0.0 }
    }
}

/// Whether all of [`Turn`] map the cells of a basis onto each other: complete rings with an even number of sectors, one
/// of them centred on the horizontal.
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
