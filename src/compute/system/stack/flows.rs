//! Scattered light to and fro between layers, on the cells of [`front_basis`]: what the matrices of the layers make of
//! the light that arises in the gaps.

use super::passage::Place;
use crate::compute::basis::RingBasis;
use crate::compute::estimate::Silent;
use crate::compute::system::measure::beams::mirror_images;
use crate::compute::system::measure::{Measured, Setting, Side, Specimen, front_basis};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Error at which the layers are measured.
const ERROR: f64 = 0.01;
/// Rounds through all layers at most, and the share of the light that may still be on its way after them.
const ROUNDS: usize = 1000;
const LEFT: f64 = 1e-7;

/// The layers as matrices, light from either side by its own names.
pub(super) struct Flows {
    /// Incident and emergent cells, by names as light from either side has them.
    pub cells: RingBasis,
    /// Their projected solid angles. \[sr\]
    pub weight: Vec<f64>,
    /// The cell that each becomes when turned by 180° about the normal.
    turn: Vec<usize>,
    layers: Vec<[OneWay; 2]>,
    /// Largest estimated error of a layer.
    pub error: f64,
}

/// What a layer does with light from one side.
struct OneWay {
    /// Share of the flux of a cell that goes to another, `[from · n + to]`.
    through: Vec<f64>,
    back: Vec<f64>,
    /// Share of the light of a cell that goes straight on.
    straight: Vec<f64>,
}

/// Light that arises in the gaps of a stack, flux by cell, and that leaves it.
pub(super) struct Sources {
    /// By gap: inwards, outwards.
    pub gaps: Vec<[Vec<f64>; 2]>,
}

impl Sources {
    /// Nothing yet between so many layers.
    pub fn dark(layers: usize, cells: usize) -> Self {
        Self { gaps: vec![[vec![0.0; cells], vec![0.0; cells]]; layers + 1] }
    }

    /// The light that arises in a place, by cell.
    pub fn at(&mut self, (gap, inwards): Place) -> &mut Vec<f64> {
        &mut self.gaps[gap][usize::from(!inwards)]
    }

    /// All of it, as a share of the light that has come.
    pub fn total(&self) -> f64 {
        self.gaps.iter().flatten().flatten().sum()
    }
}

impl Flows {
    /// Measures every layer once.
    pub fn new(layers: &[Box<dyn Specimen>]) -> Self {
        let cells = front_basis();
        let weight = cells.projected_solid_angles();
        let turn = mirror_images(&cells, |phi| phi + PI).expect("Klems cells can be turned by 180°");
        let setting = Setting { incident: &cells, emergent: &cells, error: ERROR, seed: 1 };
        let measured: Vec<Measured> =
            layers.iter().map(|layer| layer.measure(&setting, &Silent).expect("never withdrawn")).collect();
        let error = measured.iter().map(|layer| layer.quality().error).fold(0.0, f64::max);
        let one_way = |layer: &dyn Specimen, measured: &Measured, side: Side| {
            let seen = measured.seen(side);
            let flux = |q: &[f64]| -> Vec<f64> { q.iter().zip(weight.iter().cycle()).map(|(q, w)| q * w).collect() };
            let through = flux(&seen.transmitted);
            let n = cells.len();
            let straight = (0..n).into_par_iter().map(|c| {
                // Not more than the cell's own mean, so that what is left of it is never negative.
                layer.straight(cells.cell(c).centre(), side).min(through[c * n + c])
            });
            let straight = straight.collect();
            OneWay { back: flux(&seen.reflected), straight, through }
        };
        let layers = layers
            .iter()
            .zip(&measured)
            .map(|(layer, measured)| Side::BOTH.map(|side| one_way(layer.as_ref(), measured, side)))
            .collect();
        Self { cells, weight, turn, layers, error }
    }

    /// What goes straight on through all layers that are left from a gap on, by cell; names as light from `asked`.
    pub fn straight_out(&self, (gap, inwards): Place, asked: Side) -> Vec<f64> {
        let passed = if inwards { gap..self.layers.len() } else { 0..gap };
        let side = if inwards { Side::Front } else { Side::Back };
        let own = |c: usize| if side == asked { c } else { self.turn[c] };
        let share = |c: usize| passed.clone().map(|k| self.layers[k][usize::from(!inwards)].straight[own(c)]).product();
        (0..self.turn.len()).map(share).collect()
    }

    /// The light of the sources that leaves inwards and outwards in the end; names as light from `asked`.
    pub fn leaving(&self, sources: &Sources, asked: Side) -> [Vec<f64>; 2] {
        let n = self.layers.len();
        let mut light = Sources::dark(n, self.turn.len());
        let enough = LEFT * sources.total();
        let mut before = 0.0;
        for _ in 0..ROUNDS {
            for k in 0..n {
                let mut next = sources.gaps[k + 1][0].clone();
                self.add(&mut next, &self.layers[k][0].through, &light.gaps[k][0], Side::Front == asked);
                self.add(&mut next, &self.layers[k][1].back, &light.gaps[k + 1][1], Side::Back == asked);
                light.gaps[k + 1][0] = next;
            }
            for k in (0..n).rev() {
                let mut next = sources.gaps[k][1].clone();
                self.add(&mut next, &self.layers[k][1].through, &light.gaps[k + 1][1], Side::Back == asked);
                self.add(&mut next, &self.layers[k][0].back, &light.gaps[k][0], Side::Front == asked);
                light.gaps[k][1] = next;
            }
            // Light only grows from round to round, and with it what is still missing shrinks.
            let now = light.total();
            if now - before <= enough {
                break;
            }
            before = now;
        }
        let [inwards, outwards] = [(n, 0), (0, 1)].map(|(gap, sense)| std::mem::take(&mut light.gaps[gap][sense]));
        [inwards, outwards]
    }

    /// Adds what a matrix makes of light; `own`: the matrix has the names of the light. Else what comes and what it becomes
    /// change theirs, row by row the matrix stays as it lies.
    fn add(&self, to: &mut [f64], matrix: &[f64], light: &[f64], own: bool) {
        let n = self.turn.len();
        if own {
            for (&flux, row) in light.iter().zip(matrix.chunks_exact(n)).filter(|(flux, _)| **flux != 0.0) {
                to.iter_mut().zip(row).for_each(|(to, share)| *to += flux * share);
            }
            return;
        }
        let mut turned = vec![0.0; n];
        let light: Vec<f64> = self.turn.iter().map(|&i| light[i]).collect();
        self.add(&mut turned, matrix, &light, true);
        to.iter_mut().zip(&self.turn).for_each(|(to, &o)| *to += turned[o]);
    }
}
