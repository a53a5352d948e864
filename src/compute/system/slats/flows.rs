//! Light in a section: from face to face, to faces, and past them.

use super::along::Along;
use crate::compute::system::measure::Side;

/// Square matrix of faces, row by row.
#[derive(Debug, Clone)]
pub(super) struct Exchange {
    /// Number of faces.
    pub(super) size: usize,
    /// Values, row by row.
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

/// Parallel beam or fan that leaves the section.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lobe {
    /// Profile angles of its through directions at both ends; uniform between them. \[rad\]
    pub(super) psi: [f64; 2],
    /// Width of the incident light that it carries, in pitches.
    pub(super) width: f64,
    /// Sum of the squared spreads of the mirrors that it has met. \[rad²\]
    pub(super) variance: f64,
}

/// Light that mirrors reflect out of the section, for parallel light of one profile angle from one side.
#[derive(Debug, Clone, Default)]
pub(super) struct MirroredLight {
    /// Transmitted beams.
    pub(super) through: Vec<Lobe>,
    /// Reflected beams.
    pub(super) back: Vec<Lobe>,
}

/// Transport of light in the section, before the faces' diffuse reflectance.
#[derive(Debug, Clone)]
pub(super) struct Transport {
    /// Width of the light from face to face, over all directions: ½∫ t dψ, mirrors included; symmetric.
    pub(super) exchange: Exchange,
    /// Width over all directions that a face sends out, ½∫ t dψ: its length by the rule's count.
    pub(super) length: Vec<f64>,
    /// Width of a parallel beam that reaches every face, `[node][face]`, for light from outside and from inside.
    pub(super) incident: [Vec<Vec<f64>>; 2],
    /// Mirrored light that leaves, by node, from outside and from inside.
    pub(super) mirrored: [Vec<MirroredLight>; 2],
    /// Mirrored light that has met mirrors that spread light, if there are any.
    pub(super) rough: Option<Rough>,
}

/// Returns the index of a side in the pairs of this module.
pub(super) const fn index(side: Side) -> usize {
    match side {
        Side::Front => 0,
        Side::Back => 1,
    }
}

/// Light on faces after mirrors, as computed by rays.
#[derive(Debug, Clone)]
pub(super) struct Second {
    /// Light from face to face, symmetric.
    pub(super) exchange: Exchange,
    /// Width of parallel light on faces, `[node][face]`, from outside and from inside.
    pub(super) incident: [Vec<Vec<f64>>; 2],
}

/// Light of one variance that rough mirrors reflect out of the section, between nodes: ∫∫ over both nodes' hats of the
/// width, divided by both hats.
#[derive(Debug, Clone)]
pub(super) struct VarianceLevel {
    /// Light from outside by the first index to inside by the second; light from inside is the transpose.
    pub(super) through: Vec<f64>,
    /// Light reflected outside and inside; the second index is the node of light that takes the reverse path.
    pub(super) back: [Vec<f64>; 2],
}

/// All light that rough mirrors reflect out of the section.
#[derive(Debug, Clone)]
pub(super) struct Rough {
    /// Kernels of the direction cosine x along the slats.
    pub(super) along: Along,
    /// Light by level of variance, one entry per level of `along`.
    pub(super) levels: Vec<VarianceLevel>,
    /// Deficit of the sums over all light, by node, from outside and from inside. In pitches.
    pub(super) uncertainty: [Vec<f64>; 2],
}

impl Rough {
    /// Returns the flows of a level, by the nodes of the through directions: incident, emergent.
    pub(super) fn flows(&self, level: usize, side: Side, through: bool) -> Vec<f64> {
        let level = &self.levels[level];
        let n = self.uncertainty[0].len();
        match (through, side) {
            (true, Side::Front) => level.through.clone(),
            (true, Side::Back) => (0..n * n).map(|at| level.through[at % n * n + at / n]).collect(),
            // Through directions of reflected light are opposite.
            (false, _) => level.back[index(side)].chunks(n).flat_map(|line| line.iter().rev().copied()).collect(),
        }
    }
}
