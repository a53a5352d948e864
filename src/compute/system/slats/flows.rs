//! Light in the section of slats: from face to face, from outside to the faces, and past them. Amounts are widths of
//! beams in pitches.

use super::along::Along;
use crate::compute::system::measure::Side;

/// Exchange of light between all pairs of faces: square matrix, stored row by row.
#[derive(Debug, Clone)]
pub(super) struct Exchange {
    /// Number of faces.
    pub(super) size: usize,
    /// Values, row by row: light from the row's face to the column's. \[pitches\]
    pub(super) values: Vec<f64>,
}

impl Exchange {
    /// Creates an exchange between `size` faces without any light.
    pub(super) fn new(size: usize) -> Self {
        Self { size, values: vec![0.0; size * size] }
    }

    /// Adds an amount of light from one face to another. \[pitches\]
    pub(super) fn add(&mut self, from: usize, to: usize, amount: f64) {
        self.values[from * self.size + to] += amount;
    }

    /// Adds all values of another exchange between the same faces.
    pub(super) fn add_all(&mut self, other: &Self) {
        self.values.iter_mut().zip(&other.values).for_each(|(sum, x)| *sum += x);
    }
}

/// Parallel beam or fan of light that leaves the section of slats.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lobe {
    /// Profile angles of the directions of undeviated light at both ends of the fan, which is uniform between them.
    /// \[rad\]
    pub(super) psi: [f64; 2],
    /// Width of the incident parallel light that it carries, times the reflectances that it has met. \[pitches\]
    pub(super) width: f64,
    /// Sum of the squared spreads σ² of the mirrors that it has met; 0 without rough mirrors. \[rad²\]
    pub(super) variance: f64,
}

/// Light that mirrors reflect out of the section, for parallel light of one profile angle from one side.
#[derive(Debug, Clone, Default)]
pub(super) struct MirroredLight {
    /// Transmitted beams and fans.
    pub(super) through: Vec<Lobe>,
    /// Reflected beams and fans.
    pub(super) back: Vec<Lobe>,
}

/// Transport of light in the section of slats, before any diffuse reflection: between faces, from outside to faces, and
/// by mirrors out of the section.
#[derive(Debug, Clone)]
pub(super) struct Transport {
    /// Exchange between faces, ½∫ t dψ over all directions ψ with the width t of light from one to the other, directly
    /// and by mirrors; symmetric. \[pitches\]
    pub(super) exchange: Exchange,
    /// Light that each face sends out, ½∫ t dψ over all directions: its length as the quadrature over ψ gives it.
    /// \[pitches\]
    pub(super) length: Vec<f64>,
    /// Width of parallel light that reaches every face, `[node of the profile angle][face]`, for light from outside and
    /// from inside. \[pitches\]
    pub(super) incident: [Vec<Vec<f64>>; 2],
    /// Specularly reflected light that leaves the section, by node of the profile angle, for light from outside and
    /// from inside.
    pub(super) mirrored: [Vec<MirroredLight>; 2],
    /// Light reflected out of the section by rough mirrors, if there are any.
    pub(super) rough: Option<Rough>,
}

/// Returns the index of a side in the pairs of this module.
pub(super) const fn index(side: Side) -> usize {
    match side {
        Side::Front => 0,
        Side::Back => 1,
    }
}

/// Light that reaches faces after reflection by mirrors, as computed by rays.
#[derive(Debug, Clone)]
pub(super) struct Second {
    /// Exchange between faces by way of mirrors; symmetric.
    pub(super) exchange: Exchange,
    /// Width of parallel light that reaches faces by way of mirrors, `[node of the profile angle][face]`, for light
    /// from outside and from inside. \[pitches\]
    pub(super) incident: [Vec<Vec<f64>>; 2],
}

/// Light that rough mirrors reflect out of the section with one variance along the slats, as a matrix between the nodes
/// of the incident and the emergent profile angle: ∫∫ of the width over the hat functions of both nodes, divided by the
/// integrals of both.
#[derive(Debug, Clone)]
pub(super) struct VarianceLevel {
    /// Light transmitted from outside (first index) to inside (second index); for light from inside it is the
    /// transpose.
    pub(super) through: Vec<f64>,
    /// Light reflected to the outside, and to the inside; the second index is the node of the light that takes the
    /// reverse path.
    pub(super) back: [Vec<f64>; 2],
}

/// Light that rough mirrors reflect out of the section, by levels of the variance along the slats.
#[derive(Debug, Clone)]
pub(super) struct Rough {
    /// Kernels by which the direction cosine x along the slats changes, one per level of variance.
    pub(super) along: Along,
    /// Light of each level of variance, one entry per level of `along`.
    pub(super) levels: Vec<VarianceLevel>,
    /// Error of the rays' sums before they are corrected (missing or surplus light), by node of the profile angle, for
    /// light from outside and from inside. \[pitches\]
    pub(super) uncertainty: [Vec<f64>; 2],
}

impl Rough {
    /// Returns the matrix of light from node to node of a level for light from `side`, transmitted or reflected,
    /// indexed by the nodes of the directions of undeviated light: incident, then emergent.
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
