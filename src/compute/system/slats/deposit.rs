//! Distribution of specularly reflected light over emergent cells.
//!
//! Ideal mirrors of horizontal slats leave the direction cosine x along the slats unchanged and change the profile
//! angle only. On a line of constant ψ the emergent cells divide x into intervals; an incident cell sends light to that
//! line within its own interval of x, so that shares are lengths in ∫ √(1 − x²) dx: exact in x, and on the nodes of ψ.
//! Rough mirrors are treated in `rough`.

use super::profile_weights::{Piece, ProfileGrid, primitive};
use crate::compute::basis::RingBasis;

/// Intervals of the direction cosine x that the cells of a basis cover at every node of the profile angle, in terms of
/// ∫ √(1 − x²) dx.
#[derive(Debug, Clone)]
pub(super) struct Intervals {
    /// Intervals of each node in rising order: (from, to, index of the cell).
    lines: Vec<Vec<(f64, f64, usize)>>,
}

impl Intervals {
    /// Creates the intervals of the cells of a basis at the nodes of a grid of profile angles.
    pub(super) fn new(basis: &RingBasis, grid: ProfileGrid) -> Self {
        let mut lines = vec![vec![]; grid.len()];
        for (index, cell) in basis.cells().enumerate() {
            for piece in Piece::of(&cell) {
                let knots = piece.knots();
                let (low, high) = (knots[0], knots[knots.len() - 1]);
                let (low, high) = if piece.up > 0.0 { (low, high) } else { (-high, -low) };
                let (first, last) = (grid.place(low).0, grid.place(high).0 + 1);
                for (node, line) in lines.iter_mut().enumerate().take(last + 1).skip(first) {
                    let psi = piece.up * grid.psi(node);
                    // ψ = 0 belongs to the upper half.
                    if psi < 0.0 || (psi == 0.0 && piece.up < 0.0) {
                        continue;
                    }
                    if let Some([from, to]) = piece.across(psi.max(1e-9)) {
                        let (from, to) = (piece.right * from, piece.right * to);
                        line.push((primitive(from.min(to)), primitive(from.max(to)), index));
                    }
                }
            }
        }
        for line in &mut lines {
            line.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
        }
        Self { lines }
    }

    /// Returns the intervals sorted by cell: for each of `cells` cells a list of (node, from, to).
    pub(super) fn by_cell(&self, cells: usize) -> Vec<Vec<(usize, f64, f64)>> {
        let mut list = vec![vec![]; cells];
        for (node, line) in self.lines.iter().enumerate() {
            for &(from, to, cell) in line {
                list[cell].push((node, from, to));
            }
        }
        list
    }

    /// Calls `put(cell, share)` for all cells that overlap the interval `from` … `to` of ∫ √(1 − x²) dx at a node. The
    /// shares add up to 1 where the cells cover the hemisphere.
    pub(super) fn divide(&self, node: usize, from: f64, to: f64, mut put: impl FnMut(usize, f64)) {
        let line = &self.lines[node];
        let length = to - from;
        if length <= 0.0 {
            return;
        }
        let start = line.partition_point(|&(_, end, _)| end <= from);
        for &(low, high, cell) in line[start..].iter().take_while(|&&(low, ..)| low < to) {
            let share = (high.min(to) - low.max(from)) / length;
            if share > 0.0 {
                put(cell, share);
            }
        }
    }
}
