//! Solid angles (cells) around the nodes of a C-γ table, and their weights in a zonal sum.

use super::{Aim, weights};
use glam::DVec3;
use std::f64::consts::PI;

/// Points per side of a cell, for its mean. Chosen: cost; the flux of a spot is exact in any case. Held by the test
/// `a_beam_through_a_tile_lights_its_outline_evenly_and_nothing_beside`.
const POINTS: usize = 4;

/// Nodes of a C-γ table and the cells around them.
pub(super) struct Cells<'a> {
    pub aim: Aim,
    pub c: &'a [f64],
    pub gamma: &'a [f64],
    /// Weights of the planes and of the angles in a zonal sum.
    pub weights: (Vec<f64>, Vec<f64>),
}

impl<'a> Cells<'a> {
    pub fn new(aim: Aim, c: &'a [f64], gamma: &'a [f64]) -> Self {
        Self { aim, c, gamma, weights: weights(c, gamma) }
    }

    /// Returns the limits in C of the cells of a plane, not reduced to 0 … 2π. \[rad\]
    pub fn c_cell(&self, plane: usize) -> [f64; 2] {
        let (turn, count) = (2.0 * PI, self.c.len());
        let before = if plane > 0 { self.c[plane - 1] } else { self.c[count - 1] - turn };
        let after = if plane + 1 < count { self.c[plane + 1] } else { self.c[0] + turn };
        [0.5 * (before + self.c[plane]), 0.5 * (self.c[plane] + after)]
    }

    pub fn gamma_cell(&self, angle: usize) -> [f64; 2] {
        let own = self.gamma[angle];
        let before = angle.checked_sub(1).map_or(own, |before| self.gamma[before]);
        let after = self.gamma.get(angle + 1).copied().unwrap_or(own);
        [0.5 * (before + own), 0.5 * (own + after)]
    }

    /// Returns the weight of a node in a zonal sum; `node` counts plane by plane. \[sr\]
    pub fn weight(&self, node: usize) -> f64 {
        self.weights.0[node / self.gamma.len()] * self.weights.1[node % self.gamma.len()]
    }

    /// Returns the mean of a luminous intensity over a cell with these limits in C and γ \[rad\], weighted by solid
    /// angle. `intensity` is a function of the direction of propagation in the façade frame.
    pub fn mean(&self, intensity: &dyn Fn(DVec3) -> f64, c: [f64; 2], gamma: [f64; 2]) -> f64 {
        let at = |range: [f64; 2], k: usize| range[0] + (range[1] - range[0]) * (k as f64 + 0.5) / POINTS as f64;
        let (mut sum, mut weight) = (0.0, 0.0);
        for j in 0..POINTS {
            let gamma = at(gamma, j);
            let sine = gamma.sin();
            for i in 0..POINTS {
                sum += sine * intensity(self.aim.direction(at(c, i), gamma).0.vector());
            }
            weight += POINTS as f64 * sine;
        }
        if weight > 0.0 { sum / weight } else { 0.0 }
    }
}
