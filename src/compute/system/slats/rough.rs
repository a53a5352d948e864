//! Light reflected by rough mirrors from incident to emergent cells: the product F A K F, with the share F of each cell
//! in every node of the profile angle and bin of x, the flux A between nodes, and the kernel K between bins. It is
//! symmetric, and conserves energy where cells cover the hemisphere.

use super::along::{Along, BINS};
use super::flows::Rough;
use super::profile_weights::{Piece, ProfileGrid, primitive};
use crate::compute::basis::{Cell, RingBasis};
use crate::compute::quadrature::gauss_legendre;
use crate::compute::system::measure::{Measured, Setting, Side};
use rayon::prelude::*;

/// Share of a cell in one node of the profile angle: ∫∫ hat(ψ) √(1 − x²) dx dψ over each bin of x.
#[derive(Debug, Clone)]
struct Footing {
    node: usize,
    /// Index of the first bin of x that the cell reaches into at this node.
    first: usize,
    parts: Vec<f64>,
}

/// Returns the shares of every cell of a basis in the nodes of the profile angle and the bins of x.
fn footings(basis: &RingBasis, grid: ProfileGrid, along: &Along) -> Vec<Vec<Footing>> {
    let nodes: Vec<f64> = (0..grid.len()).map(|node| grid.psi(node)).collect();
    let rule = gauss_legendre(6);
    let cells: Vec<_> = basis.cells().collect();
    cells.par_iter().map(|cell| footings_of(cell, grid, &nodes, &rule, along)).collect()
}

/// Returns the shares of one cell in the nodes of the profile angle and the bins of x.
fn footings_of(cell: &Cell, grid: ProfileGrid, nodes: &[f64], rule: &[(f64, f64)], along: &Along) -> Vec<Footing> {
    let mut sums: Vec<(usize, Vec<f64>)> = vec![];
    for piece in Piece::of(cell) {
        let knots = piece.knots();
        let (low, high) = (knots[0], knots[knots.len() - 1]);
        // Hats have kinks at the nodes: the rule is to hold between them.
        let own: Vec<f64> = nodes.iter().copied().filter(|psi| (low..=high).contains(&(psi * piece.up))).collect();
        piece.integrate(rule, &own, |psi, weight| {
            let Some([a, b]) = piece.across(psi * piece.up) else { return };
            // Pieces know |x|; the bins run from left to right.
            let (from, to) = if piece.right > 0.0 { (a, b) } else { (-b, -a) };
            let length = primitive(to) - primitive(from);
            let (node, above) = grid.place(psi);
            for (node, share) in [(node, 1.0 - above), (node + 1, above)] {
                let at = sums.iter().position(|(other, _)| *other == node).unwrap_or_else(|| {
                    sums.push((node, vec![0.0; BINS]));
                    sums.len() - 1
                });
                // An end of the line may lie on, or by rounding beyond, an end of the bins.
                let start = along.edges.partition_point(|edge| *edge <= from).clamp(1, BINS) - 1;
                for (bin, ends) in along.edges.windows(2).enumerate().skip(start) {
                    if ends[0] >= to {
                        break;
                    }
                    // `weight` is D dψ of the whole line: each bin takes its share of D = ∫ √(1 − x²) dx.
                    let part = primitive(ends[1].min(to)) - primitive(ends[0].max(from));
                    sums[at].1[bin] += weight * share * part.max(0.0) / length;
                }
            }
        });
    }
    // Most of the bins of a cell are empty; what multiplies kernels and flows later runs over the others alone.
    let trimmed = |(node, bins): (usize, Vec<f64>)| {
        let first = bins.iter().position(|x| *x > 0.0)?;
        let last = bins.iter().rposition(|x| *x > 0.0)?;
        Some(Footing { node, first, parts: bins[first..=last].to_vec() })
    };
    sums.into_iter().filter_map(trimmed).collect()
}

/// Cells that receive light of one node of the profile angle.
struct Targets {
    cells: Vec<usize>,
    /// Contribution to q of each cell of the light in every bin of x before it is spread along the slats,
    /// `[bin][cell]`. \[1/sr\]
    parts: Vec<f64>,
}

/// Returns the cells that receive light of each node after spreading along the slats by `kernel`. `solid`: projected
/// solid angles of the cells \[sr\].
fn targets(cells: &[Vec<Footing>], nodes: usize, kernel: &[f64], solid: &[f64]) -> Vec<Targets> {
    let mut footings: Vec<Vec<(usize, &Footing)>> = vec![vec![]; nodes];
    for (cell, list) in cells.iter().enumerate() {
        list.iter().for_each(|f| footings[f.node].push((cell, f)));
    }
    let one = |list: &Vec<(usize, &Footing)>| {
        let mut parts = vec![0.0; BINS * list.len()];
        for (at, (cell, f)) in list.iter().enumerate() {
            for (bin, line) in parts.chunks_mut(list.len()).enumerate() {
                let row = &kernel[bin * BINS + f.first..];
                line[at] = f.parts.iter().zip(row).map(|(part, x)| part * x).sum::<f64>() / solid[*cell];
            }
        }
        Targets { cells: list.iter().map(|(cell, _)| *cell).collect(), parts }
    };
    footings.par_iter().map(one).collect()
}

/// Adds the light reflected by rough mirrors out of the slats, and its error, to `measured`.
pub(super) fn add_rough(setting: &Setting<'_>, grid: ProfileGrid, rough: &Rough, measured: &mut Measured) {
    let incident = footings(setting.incident, grid, &rough.along);
    let other = (setting.incident != setting.emergent).then(|| footings(setting.emergent, grid, &rough.along));
    let emergent = other.as_ref().unwrap_or(&incident);
    let solid = [setting.incident, setting.emergent].map(RingBasis::projected_solid_angles);
    for side in Side::BOTH {
        for (i, error) in measured.seen_mut(side).error.iter_mut().enumerate() {
            // Nodes are drawn independently.
            let uncertainty = &rough.uncertainty[super::flows::index(side)];
            let square = |f: &Footing| (f.parts.iter().sum::<f64>() * uncertainty[f.node]).powi(2);
            *error += incident[i].iter().map(square).sum::<f64>().sqrt() / solid[0][i];
        }
    }
    for (level, (_, kernel)) in rough.along.levels.iter().enumerate() {
        let targets = targets(emergent, grid.len(), kernel, &solid[1]);
        for (side, through) in [(Side::Front, true), (Side::Front, false), (Side::Back, true), (Side::Back, false)] {
            let flows = rough.flows(level, side, through);
            if flows.iter().all(|flow| *flow == 0.0) {
                continue;
            }
            let seen = measured.seen_mut(side);
            let values = if through { &mut seen.transmitted } else { &mut seen.reflected };
            values.par_chunks_mut(solid[1].len()).zip(&incident).zip(&solid[0]).for_each(|((row, cell), solid)| {
                send(cell, &flows, &targets, 1.0 / solid, row);
            });
        }
    }
}

/// Adds the light of one incident cell, with the flux `flows` from node to node, to the emergent cells' values `row`,
/// multiplied by `scale`.
fn send(cell: &[Footing], flows: &[f64], targets: &[Targets], scale: f64, row: &mut [f64]) {
    // Before it is spread by the kernel, light keeps the few bins of x that the cell has: only these are carried along.
    let first = cell.iter().map(|f| f.first).min().unwrap_or(0);
    let last = cell.iter().map(|f| f.first + f.parts.len()).max().unwrap_or(first);
    let (n, width) = (targets.len(), last - first);
    let mut sent = vec![0.0; n * width];
    // First A F, summed over the cell's nodes, then K and the cells that take it, once a node: products one after the
    // other instead of one for every pair of parts.
    for f in cell {
        let start = f.first - first;
        let range = start..start + f.parts.len();
        // Most pairs of nodes exchange nothing.
        for (other, flow) in flows[f.node * n..(f.node + 1) * n].iter().enumerate().filter(|(_, flow)| **flow > 0.0) {
            let line = &mut sent[other * width..(other + 1) * width][range.clone()];
            line.iter_mut().zip(&f.parts).for_each(|(sum, part)| *sum += scale * flow * part);
        }
    }
    let mut taken = vec![];
    // `max(1)`: a cell without any part has no bins, and chunks of 0 are not allowed.
    for (line, targets) in sent.chunks(width.max(1)).zip(targets) {
        let count = targets.cells.len();
        taken.clear();
        taken.resize(count, 0.0);
        for (bin, amount) in line.iter().enumerate().filter(|(_, amount)| **amount > 0.0) {
            // The cells of a node stand side by side here, which lets the sum run straight through; they are sorted
            // into the row at the end.
            let parts = &targets.parts[(first + bin) * count..(first + bin + 1) * count];
            taken.iter_mut().zip(parts).for_each(|(sum, part)| *sum += amount * part);
        }
        targets.cells.iter().zip(&taken).for_each(|(cell, x)| row[*cell] += x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::AzimuthMap;
    use crate::compute::direction::{Dir, Facade};
    use crate::compute::estimate::Silent;
    use crate::compute::system::slats::SlatProfile;
    use crate::compute::system::slats::{SlatArray, Surface};
    use std::f64::consts::FRAC_PI_2;

    /// A closed rough sheet reflects by one step on the spheres of its lobe: the mean sine of the profile angle falls
    /// by the mean cosine of the step, that of the direction cosine along the slats by e^(−3σ²/2).
    #[test]
    fn a_rough_sheet_scatters_by_steps_on_spheres() {
        let (basis, fine) = (RingBasis::klems_full(AzimuthMap::KLEMS_FRONT), RingBasis::even(4_f64.to_radians()));
        let mean = |basis: &RingBasis, f: &dyn Fn(Dir<Facade>) -> f64| -> Vec<f64> {
            basis.cells().map(|cell| crate::compute::basis::cell_mean(&cell, 16, f)).collect()
        };
        let sine = |d: Dir<Facade>| crate::compute::profile_angle::profile_angle(d).unwrap().sin();
        let [along, seen_along] = [&basis, &fine].map(|basis| mean(basis, &|d| d.vector().x));
        let [up, seen_up] = [&basis, &fine].map(|basis| mean(basis, &sine));
        for degrees in [12.0_f64, 45.0] {
            let sigma = degrees.to_radians();
            let rough = Surface { diffuse: 0.0, mirror: 0.8, spread: sigma };
            let flat = SlatProfile::Flat { width: 0.08 };
            let slats = SlatArray::new(flat, 0.0, 0.072, FRAC_PI_2, [rough, Surface::matt(0.0)]).unwrap();
            let setting = Setting { incident: &basis, emergent: &fine, error: 0.01, seed: 1 };
            let m = slats.measure(&setting, &Silent).unwrap();
            // E cosθ for the length θ of a normal step in a plane.
            let step = 1e-3;
            let cosine: f64 = (0..10_000)
                .map(|k| (k as f64 + 0.5) * step)
                .map(|t| t * (-0.5 * t * t).exp() * (sigma * t).cos() * step)
                .sum();
            let weight = fine.projected_solid_angles();
            for (i, row) in m.front.reflected.chunks(fine.len()).enumerate() {
                let of = |f: &[f64]| row.iter().zip(&weight).zip(f).map(|((q, w), f)| q * w * f).sum::<f64>() / 0.8;
                let exact = [1.0, along[i] * (-1.5 * sigma * sigma).exp(), up[i] * cosine];
                let got = [of(&vec![1.0; fine.len()]), of(&seen_along), of(&seen_up)];
                let off = got.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!((got[0] - 1.0).abs() < 1e-3 && off < 0.03, "{degrees} {i}: {got:?} {exact:?}");
            }
        }
    }
}
