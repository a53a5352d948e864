//! Light of rough mirrors from cell to cell: F A K F with the cells' parts F of every node and bin of x, the flux A
//! between nodes, and the kernel K between bins; symmetric throughout, and complete where cells cover the hemisphere.

use super::along::{Along, BINS};
use super::profile_weights::{Piece, ProfileGrid, primitive};
use super::reciprocal::Rough;
use crate::compute::basis::RingBasis;
use crate::compute::goniophotometer::{Measured, Setting, Side};
use crate::compute::quadrature::gauss_legendre;
use rayon::prelude::*;

/// Part of a cell at one node: ∫ hat √(1 − x²) dx dψ over bins of x.
#[derive(Debug, Clone)]
struct Footing {
    node: usize,
    /// The first bin.
    first: usize,
    parts: Vec<f64>,
}

/// Parts of every cell of a basis.
fn footings(basis: &RingBasis, grid: ProfileGrid, along: &Along) -> Vec<Vec<Footing>> {
    let nodes: Vec<f64> = (0..grid.len()).map(|node| grid.psi(node)).collect();
    let rule = gauss_legendre(6);
    let cells: Vec<_> = basis.cells().collect();
    let one = |cell: &crate::compute::basis::Cell| {
        let mut sums: Vec<(usize, Vec<f64>)> = vec![];
        for piece in Piece::of(cell) {
            let knots = piece.knots();
            let (low, high) = (knots[0], knots[knots.len() - 1]);
            let own: Vec<f64> = nodes.iter().copied().filter(|psi| (low..=high).contains(&(psi * piece.up))).collect();
            piece.integrate(&rule, &own, |psi, weight| {
                let Some([a, b]) = piece.across(psi * piece.up) else { return };
                let (from, to) = if piece.right > 0.0 { (a, b) } else { (-b, -a) };
                let length = primitive(to) - primitive(from);
                let (node, above) = grid.place(psi);
                for (node, share) in [(node, 1.0 - above), (node + 1, above)] {
                    let at = sums.iter().position(|(other, _)| *other == node).unwrap_or_else(|| {
                        sums.push((node, vec![0.0; BINS]));
                        sums.len() - 1
                    });
                    let start = along.edges.partition_point(|edge| *edge <= from).clamp(1, BINS) - 1;
                    for (bin, ends) in along.edges.windows(2).enumerate().skip(start) {
                        if ends[0] >= to {
                            break;
                        }
                        let part = primitive(ends[1].min(to)) - primitive(ends[0].max(from));
                        sums[at].1[bin] += weight * share * part.max(0.0) / length;
                    }
                }
            });
        }
        let trimmed = |(node, bins): (usize, Vec<f64>)| {
            let first = bins.iter().position(|x| *x > 0.0)?;
            let last = bins.iter().rposition(|x| *x > 0.0)?;
            Some(Footing { node, first, parts: bins[first..=last].to_vec() })
        };
        sums.into_iter().filter_map(trimmed).collect()
    };
    cells.par_iter().map(one).collect()
}

/// Adds what rough mirrors throw out.
pub(super) fn add_rough(setting: &Setting<'_>, grid: ProfileGrid, rough: &Rough, measured: &mut Measured) {
    let incident = footings(setting.incident, grid, &rough.along);
    let emergent = footings(setting.emergent, grid, &rough.along);
    let solid = [setting.incident, setting.emergent].map(RingBasis::projected_solid_angles);
    let n = grid.len();
    for side in Side::BOTH {
        let own = super::transport::index(side);
        let seen = measured.seen_mut(side);
        for (i, error) in seen.error.iter_mut().enumerate() {
            // Nodes are drawn independently.
            let square = |f: &Footing| (f.parts.iter().sum::<f64>() * rough.doubt[own][f.node]).powi(2);
            *error += incident[i].iter().map(square).sum::<f64>().sqrt() / solid[0][i];
        }
        for (through, values) in [(true, &mut seen.transmitted), (false, &mut seen.reflected)] {
            values.par_chunks_mut(solid[1].len()).enumerate().for_each(|(i, row)| {
                let flow = |level: usize, node: usize, other: usize| {
                    let level = &rough.levels[level];
                    match (through, own) {
                        (true, 0) => level.through[node * n + other],
                        (true, _) => level.through[other * n + node],
                        // Names of what is thrown back are opposite.
                        (false, _) => level.back[own][node * n + n - 1 - other],
                    }
                };
                let sent = sent(&incident[i], n, rough, flow);
                for (o, q) in row.iter_mut().enumerate() {
                    let at = |f: &Footing| -> f64 {
                        let line = &sent[f.node * BINS + f.first..];
                        f.parts.iter().zip(line).map(|(part, x)| part * x).sum()
                    };
                    *q += emergent[o].iter().map(at).sum::<f64>() / (solid[0][i] * solid[1][o]);
                }
            });
        }
    }
}

/// What a cell sends to every node and bin, per ∫ hat √(1 − x²) dx dψ.
fn sent(cell: &[Footing], n: usize, rough: &Rough, flow: impl Fn(usize, usize, usize) -> f64) -> Vec<f64> {
    let mut sent = vec![0.0; n * BINS];
    let first = cell.iter().map(|f| f.first).min().unwrap_or(0);
    let last = cell.iter().map(|f| f.first + f.parts.len()).max().unwrap_or(0);
    let width = last - first;
    let mut before = vec![0.0; n * width];
    for (level, (_, kernel)) in rough.along.levels.iter().enumerate() {
        before.fill(0.0);
        for f in cell {
            for (other, line) in before.chunks_mut(width.max(1)).enumerate() {
                let flow = flow(level, f.node, other);
                if flow > 0.0 {
                    line[f.first - first..].iter_mut().zip(&f.parts).for_each(|(sum, part)| *sum += flow * part);
                }
            }
        }
        for (line, out) in before.chunks(width.max(1)).zip(sent.chunks_mut(BINS)) {
            for (k, amount) in line.iter().enumerate().filter(|(_, amount)| **amount > 0.0) {
                let row = &kernel[(first + k) * BINS..(first + k + 1) * BINS];
                out.iter_mut().zip(row).for_each(|(sum, x)| *sum += amount * x);
            }
        }
    }
    sent
}
