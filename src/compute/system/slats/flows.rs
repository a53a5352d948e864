//! What is known of the light in a section: from face to face, to faces, and past them.

use super::along::Along;
use crate::compute::system::measure::Side;

/// A square matrix of faces, row by row.
#[derive(Debug, Clone)]
pub(super) struct Exchange {
    /// Faces.
    pub(super) size: usize,
    /// Row by row.
    pub(super) values: Vec<f64>,
}

impl Exchange {
    pub(super) fn new(size: usize) -> Self {
        Self { size, values: vec![0.0; size * size] }
    }

    pub(super) fn add(&mut self, from: usize, to: usize, amount: f64) {
        self.values[from * self.size + to] += amount;
    }

    pub(super) fn add_all(&mut self, other: &Self) {
        self.values.iter_mut().zip(&other.values).for_each(|(sum, x)| *sum += x);
    }
}

/// A parallel beam that leaves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lobe {
    /// Profile angles of its name, from and to: evenly between. \[rad\]
    pub(super) psi: [f64; 2],
    /// Width of the incident light that it carries, in pitches.
    pub(super) width: f64,
    /// Sum of the squared spreads of the mirrors that it has met. \[rad²\]
    pub(super) variance: f64,
}

/// What mirrors make of parallel light that comes at one profile angle from one side.
#[derive(Debug, Clone, Default)]
pub(super) struct Thrown {
    /// Transmitted.
    pub(super) through: Vec<Lobe>,
    /// Thrown back.
    pub(super) back: Vec<Lobe>,
}

/// Everything the section does to light, before the faces' diffuse reflectance.
#[derive(Debug, Clone)]
pub(super) struct Transport {
    /// Width of the light from face to face, over all directions: ½∫ t dψ, mirrors included; symmetric.
    pub(super) exchange: Exchange,
    /// Width over all directions that a face sends out, ½∫ t dψ: its length by the rule's count.
    pub(super) length: Vec<f64>,
    /// Width of a parallel beam that comes to every face, `[node][face]`, for light from outside and from inside.
    pub(super) landed: [Vec<Vec<f64>>; 2],
    /// Mirrored light that leaves, a node, from outside and from inside.
    pub(super) thrown: [Vec<Thrown>; 2],
    /// What of it has met mirrors that spread light, if any do.
    pub(super) rough: Option<Rough>,
}

/// Index of a side in the pairs of this module.
pub(super) const fn index(side: Side) -> usize {
    match side {
        Side::Front => 0,
        Side::Back => 1,
    }
}

/// What comes to faces by way of mirrors, as rays have found it.
#[derive(Debug, Clone)]
pub(super) struct Second {
    /// From face to face, symmetric.
    pub(super) exchange: Exchange,
    /// From parallel light, `[node][face]`, from outside and from inside.
    pub(super) landed: [Vec<Vec<f64>>; 2],
}

/// Light of one variance that rough mirrors throw out, between nodes: ∫∫ over both nodes' hats of the width, divided by
/// both hats.
#[derive(Debug, Clone)]
pub(super) struct VarianceLevel {
    /// From outside by the first index to inside by the second; from inside it is the transpose.
    pub(super) through: Vec<f64>,
    /// Thrown back outside and inside; the second index is the node from which light takes the way back.
    pub(super) back: [Vec<f64>; 2],
}

/// All light that rough mirrors throw out.
#[derive(Debug, Clone)]
pub(super) struct Rough {
    /// What becomes of x.
    pub(super) along: Along,
    /// As many as `along` has.
    pub(super) levels: Vec<VarianceLevel>,
    /// What the sums over all that light can do lacked, a node, from outside and from inside. In pitches.
    pub(super) doubt: [Vec<f64>; 2],
}

impl Rough {
    /// Flows of a level, by the nodes that name the light: incident, emergent.
    pub(super) fn flows(&self, level: usize, side: Side, through: bool) -> Vec<f64> {
        let level = &self.levels[level];
        let n = self.doubt[0].len();
        match (through, side) {
            (true, Side::Front) => level.through.clone(),
            (true, Side::Back) => (0..n * n).map(|at| level.through[at % n * n + at / n]).collect(),
            // Names of what is thrown back are opposite.
            (false, _) => level.back[index(side)].chunks(n).flat_map(|line| line.iter().rev().copied()).collect(),
        }
    }
}
