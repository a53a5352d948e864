//! Light reflected by rough mirrors, from rays with random steps, made reciprocal and energy-conserving.
//!
//! Rays from either end of a path estimate the same flux: their mean is symmetric. With these means the sums over all
//! light are no longer exactly the light that was sent out, because of the random steps; a factor for every direction
//! and face, such that all sums are right again, corrects that. The deficit of the sums before the correction is stated
//! as error.

use super::along::Along;
use super::flows::{MirroredLight, Rough, Second, Transport, VarianceLevel};
use super::outline::SlatSection;
use super::profile_weights::ProfileGrid;
use crate::compute::scaling::by_rounds;

/// Number of rounds in which the factors are determined; each halves the deficit of the sums, so that 2⁻⁴⁰ ≈ 1e-12 of
/// it is left.
const ROUNDS: usize = 40;
/// Maximum correction factor. Chosen: bounds the correction of sums to which few rays have contributed; light that is
/// still missing shows in the energy balance, which is part of the stated error.
const LIMIT: f64 = 16.0;

/// Light reflected by rough mirrors between nodes of the profile angle, made symmetric: sums of flux and of flux times
/// variance.
struct Sums {
    through: Vec<[f64; 2]>,
    back: [Vec<[f64; 2]>; 2],
}

impl Sums {
    /// Sums up the light of all rays by incident and emergent node, as means of both paths.
    fn new(grid: ProfileGrid, mirrored: &[Vec<MirroredLight>; 2]) -> Self {
        let n = grid.len();
        let none = || vec![[0.0; 2]; n * n];
        let mut sums = Self { through: none(), back: [none(), none()] };
        let put = |cell: &mut [f64; 2], flux: f64, variance: f64| {
            cell[0] += flux;
            cell[1] += flux * variance;
        };
        for (side, nodes) in mirrored.iter().enumerate() {
            for (node, mirrored) in nodes.iter().enumerate() {
                // Each of both ends gives half.
                let scale = 0.25 * grid.hat(node);
                for (lobes, through) in [(&mirrored.through, true), (&mirrored.back, false)] {
                    for lobe in lobes.iter().filter(|lobe| lobe.variance > 0.0) {
                        let (below, above) = grid.place(0.5 * (lobe.psi[0] + lobe.psi[1]));
                        for (other, share) in [(below, 1.0 - above), (below + 1, above)] {
                            let flux = scale * share * lobe.width;
                            if through {
                                let at = if side == 0 { node * n + other } else { other * n + node };
                                put(&mut sums.through[at], flux, lobe.variance);
                            } else {
                                // Reflected light has the opposite through direction of light on the reverse path.
                                let other = n - 1 - other;
                                put(&mut sums.back[side][node * n + other], flux, lobe.variance);
                                put(&mut sums.back[side][other * n + node], flux, lobe.variance);
                            }
                        }
                    }
                }
            }
        }
        sums
    }
}

/// Returns the sums of light of every node from outside, of every node from inside, and of every face, with the
/// correction factors `scales` of all others applied.
fn rows(sums: &Sums, second: &Second, hat: &[f64], kept: &[f64], scales: &[f64]) -> Vec<f64> {
    let n = hat.len();
    let (nodes, faces) = scales.split_at(2 * n);
    let mut out = vec![0.0; scales.len()];
    for (i, hat) in hat.iter().enumerate() {
        let line = &sums.through[i * n..(i + 1) * n];
        for (j, [flux, _]) in line.iter().enumerate() {
            out[i] += flux * nodes[n + j];
            out[n + j] += flux * nodes[i];
        }
        for side in [0, 1] {
            let (line, own) = (&sums.back[side][i * n..(i + 1) * n], side * n..(side + 1) * n);
            out[side * n + i] += line.iter().zip(&nodes[own]).map(|([flux, _], d)| flux * d).sum::<f64>();
            for (face, width) in second.incident[side][i].iter().enumerate() {
                let flux = 0.5 * hat * width;
                out[side * n + i] += flux * kept[face] * faces[face];
                out[2 * n + face] += flux * nodes[side * n + i];
            }
        }
    }
    for (face, line) in second.exchange.values.chunks(kept.len()).enumerate() {
        out[2 * n + face] += line.iter().zip(kept).zip(faces).map(|((flux, c), d)| flux * c * d).sum::<f64>();
    }
    out
}

/// Makes the light found by rays reciprocal and energy-conserving: corrects `second`, the light on faces by way of
/// mirrors, and returns the light that leaves. `direct` is the transport without mirrors.
pub(super) fn settle(section: &SlatSection, grid: ProfileGrid, direct: &Transport, second: &mut Second) -> Rough {
    let n = grid.len();
    let hat: Vec<f64> = (0..n).map(|node| grid.hat(node)).collect();
    let mirror: Vec<f64> = section.faces.iter().map(|face| face.surface.mirror).collect();
    let kept: Vec<f64> = mirror.iter().map(|m| 1.0 - m).collect();
    let sums = Sums::new(grid, &direct.mirrored);

    // The first light that mirrors reflect is known; lobes of ideal mirrors are not changed.
    let ideal = |mirrored: &MirroredLight| -> f64 {
        let all = mirrored.through.iter().chain(&mirrored.back);
        all.filter(|lobe| lobe.variance <= 0.0).map(|lobe| lobe.width).sum()
    };
    let reflected = |incident: &[f64]| incident.iter().zip(&mirror).map(|(x, m)| x * m).sum::<f64>();
    let of_node = |side: usize, node: usize| {
        0.5 * hat[node] * (reflected(&direct.incident[side][node]) - ideal(&direct.mirrored[side][node])).max(0.0)
    };
    let of_nodes = (0..2 * n).map(|k| Some(of_node(k / n, k % n)));
    // Faces that send nothing need no sums: nothing is followed from them.
    let of_faces = direct.exchange.values.chunks(mirror.len()).zip(&section.faces);
    let of_faces = of_faces.map(|(line, face)| (face.surface.diffuse > 0.0).then(|| reflected(line)));
    let wanted: Vec<Option<f64>> = of_nodes.chain(of_faces).collect();
    let rows = |scales: &[f64]| rows(&sums, second, &hat, &kept, scales);
    let found = rows(&vec![1.0; wanted.len()]);
    let uncertainty = [0, 1].map(|side: usize| {
        let pairs = wanted[side * n..].iter().zip(&found[side * n..]);
        pairs.zip(&hat).map(|((wanted, found), hat)| 2.0 * (wanted.unwrap_or_default() - found).abs() / hat).collect()
    });
    let scales = by_rounds(rows, &wanted, ROUNDS, 0.0, LIMIT);
    let (nodes, face_scales) = scales.split_at(2 * n);
    let (front, back) = nodes.split_at(n);

    for side in [0, 1] {
        for (line, d) in second.incident[side].iter_mut().zip(&nodes[side * n..]) {
            line.iter_mut().zip(face_scales).for_each(|(x, face)| *x *= d * face);
        }
    }
    let faces = mirror.len();
    for (at, x) in second.exchange.values.iter_mut().enumerate() {
        *x *= face_scales[at / faces] * face_scales[at % faces];
    }
    let smallest = section.faces.iter().filter(|face| face.surface.mirror > 0.0 && face.surface.spread > 0.0);
    let along = Along::new(smallest.map(|face| face.surface.spread.powi(2)).fold(f64::INFINITY, f64::min));
    let levels = divided(&sums, [front, back], &hat, &along);
    Rough { along, levels, uncertainty }
}

/// Returns the corrected sums as densities over the profile angles, divided among the levels of variance of `along`.
fn divided(sums: &Sums, [front, back]: [&[f64]; 2], hat: &[f64], along: &Along) -> Vec<VarianceLevel> {
    let n = hat.len();
    let none = || vec![0.0; n * n];
    let mut levels: Vec<VarianceLevel> =
        along.levels.iter().map(|_| VarianceLevel { through: none(), back: [none(), none()] }).collect();
    for at in 0..n * n {
        let (i, j) = (at / n, at % n);
        let mut put = |[flux, moment]: [f64; 2], scale: f64, pick: fn(&mut VarianceLevel) -> &mut Vec<f64>| {
            if flux > 0.0 {
                let (level, above) = along.place(moment / flux);
                let density = 2.0 * flux * scale / (hat[i] * hat[j]);
                pick(&mut levels[level])[at] += density * (1.0 - above);
                pick(&mut levels[level + 1])[at] += density * above;
            }
        };
        put(sums.through[at], front[i] * back[j], |level| &mut level.through);
        put(sums.back[0][at], front[i] * front[j], |level| &mut level.back[0]);
        put(sums.back[1][at], back[i] * back[j], |level| &mut level.back[1]);
    }
    levels
}
