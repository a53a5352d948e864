//! A tensor tree of rank 4 in the shape of Radiance's, with every advantage: pruned for least misplaced flux instead of
//! by differences, leaves rounded to the best of several precisions, below the incident resolution of the data only
//! the emergent square is parted, and values coded by the same arithmetic coder or zstd, whichever is smaller.

use cfs::compute::basis::{RingBasis, SquareGrid};
use cfs::compute::btdf::Indicatrices;
use cfs::formats::compact_rows::range_coder::{Chance, Encoder};

/// Levels of the incident square: 16 × 16 cells, as many as 145 directions fill.
const IN_LEVELS: usize = 4;
/// Levels of the emergent square: 64 × 64 cells of about 2.5°.
const OUT_LEVELS: usize = 6;
const OUT: usize = 1 << OUT_LEVELS;

/// Cells along the incident and the emergent side at a level.
fn sides(level: usize) -> [usize; 2] {
    [1 << level.min(IN_LEVELS), 1 << level]
}

/// Place of a node (incident x, y, emergent x, y) in its level's list.
fn place(level: usize, [ix, iy, ox, oy]: [usize; 4]) -> usize {
    let [n, m] = sides(level);
    (iy * n + ix) * m * m + oy * m + ox
}

fn children(level: usize, corner: [usize; 4]) -> impl DoubleEndedIterator<Item = [usize; 4]> {
    let parted = if level < IN_LEVELS { 0 } else { 2 };
    let child = move |k: usize| {
        std::array::from_fn(|d| if d < parted { corner[d] } else { 2 * corner[d] + (k >> (d - parted) & 1) })
    };
    (0..1_usize << (4 - parted)).map(child)
}

pub struct Grid {
    /// Mean of every node, by level; the finest is the data.
    means: Vec<Vec<f64>>,
    /// Σ|q − mean| of every node, by level.
    off: Vec<Vec<f64>>,
    /// Incident cell of each incident direction.
    cell_of: Vec<usize>,
    emergent: SquareGrid,
}

impl Grid {
    pub fn of(data: &Indicatrices) -> Self {
        let incident = SquareGrid::new(IN_LEVELS as u32).unwrap();
        let emergent = SquareGrid::new(OUT_LEVELS as u32).unwrap();
        let at: Vec<Option<usize>> = emergent.cells().map(|cell| data.emergent().index(cell.centre())).collect();
        let values = incident.cells().flat_map(|cell| {
            let row = data.row(data.nearest(cell.centre())).into_owned();
            at.iter().map(move |o| o.map_or(0.0, |o| row[o])).collect::<Vec<f64>>()
        });
        let values: Vec<f64> = values.collect();
        let cell_of = data.incident().iter().map(|d| incident.index(d.0).unwrap()).collect();
        let (mut means, mut off) = (vec![], vec![]);
        for level in 0..=OUT_LEVELS {
            let [n, m] = sides(level);
            let (mut sum, mut count) = (vec![0.0; n * n * m * m], 0.0);
            let ancestor = |at: usize| {
                let (i, o) = (at / (OUT * OUT), at % (OUT * OUT));
                let (down_i, down_o) = (IN_LEVELS - level.min(IN_LEVELS), OUT_LEVELS - level);
                let side = 1 << IN_LEVELS;
                place(level, [(i % side) >> down_i, (i / side) >> down_i, (o % OUT) >> down_o, (o / OUT) >> down_o])
            };
            values.iter().enumerate().for_each(|(at, q)| sum[ancestor(at)] += q);
            count += values.len() as f64 / sum.len() as f64;
            sum.iter_mut().for_each(|s| *s /= count);
            let mut difference = vec![0.0; sum.len()];
            values.iter().enumerate().for_each(|(at, q)| difference[ancestor(at)] += (q - sum[ancestor(at)]).abs());
            means.push(sum);
            off.push(difference);
        }
        Self { means, off, cell_of, emergent }
    }

    pub fn values(&self) -> &[f64] {
        &self.means[OUT_LEVELS]
    }

    pub fn rings(&self) -> RingBasis {
        self.emergent.rings()
    }

    pub fn row_on_rings(&self, values: &[f64], direction: usize) -> Vec<f64> {
        let n = OUT * OUT;
        let cell = self.cell_of[direction];
        self.emergent.to_rings(&values[cell * n..(cell + 1) * n])
    }

    /// Trees of several sizes: the values that they stand for, and their bytes.
    pub fn ladder(&self) -> impl Iterator<Item = (Vec<f64>, usize)> + '_ {
        let mean = self.means[0][0];
        (0..10).flat_map(move |k| {
            let leaves = self.pruned(mean * 0.02 * 2.5_f64.powi(k));
            [0.01, 0.03, 0.1].map(|precision| self.coded(&leaves, precision))
        })
    }

    /// Which nodes are leaves, so that Σ|q − mean| + λ·leaves is least.
    fn pruned(&self, lambda: f64) -> Vec<Vec<bool>> {
        let mut leaves: Vec<Vec<bool>> = self.means.iter().map(|level| vec![true; level.len()]).collect();
        let mut cost: Vec<f64> = vec![lambda; self.values().len()];
        for level in (0..OUT_LEVELS).rev() {
            let [n, m] = sides(level);
            let mut next = vec![0.0; n * n * m * m];
            for (at, next) in next.iter_mut().enumerate() {
                let (i, o) = (at / (m * m), at % (m * m));
                let parts: f64 =
                    children(level, [i % n, i / n, o % m, o / m]).map(|child| cost[place(level + 1, child)]).sum();
                let merged = self.off[level][at] + lambda;
                leaves[level][at] = merged <= parts;
                *next = merged.min(parts);
            }
            cost = next;
        }
        leaves
    }

    /// Leaves rounded to steps of a relative precision (absolute below a thousandth of the mean), and bytes.
    fn coded(&self, leaves: &[Vec<bool>], precision: f64) -> (Vec<f64>, usize) {
        let floor = 1e-3 * self.means[0][0].max(1e-30);
        let round = |q: f64| ((1.0 + q / floor).ln() / precision).round();
        let back = |level: f64| ((level * precision).exp() - 1.0) * floor;
        let mut values = vec![0.0; self.values().len()];
        let (mut shape, mut levels) = (vec![], vec![]);
        let mut stack = vec![(0, [0; 4])];
        while let Some((level, corner)) = stack.pop() {
            let leaf = leaves[level][place(level, corner)];
            if level < OUT_LEVELS {
                shape.push((level, leaf));
            }
            if leaf {
                let rounded = round(self.means[level][place(level, corner)]);
                levels.push(rounded as i32);
                fill(level, corner, back(rounded), &mut values);
            } else {
                stack.extend(children(level, corner).rev().map(|child| (level + 1, child)));
            }
        }
        (values, coder_bytes(&shape, &levels).min(zstd_bytes(&shape, &levels)))
    }
}

fn fill(level: usize, corner: [usize; 4], q: f64, values: &mut [f64]) {
    if level == OUT_LEVELS {
        values[place(level, corner)] = q;
    } else {
        children(level, corner).for_each(|child| fill(level + 1, child, q, values));
    }
}

/// Adaptive chances: shape by level and the node before, values by their difference to the leaf before.
fn coder_bytes(shape: &[(usize, bool)], levels: &[i32]) -> usize {
    let mut encoder = Encoder::default();
    let mut chances = [Chance::from_byte(128); 16];
    let mut before = false;
    for &(level, leaf) in shape {
        encoder.bit(&mut chances[2 * level + usize::from(before)], leaf);
        before = leaf;
    }
    let mut chances = vec![Chance::from_byte(128); 3 * 64];
    let (mut last, mut class) = (0, 0);
    for &level in levels {
        let difference = level - last;
        last = level;
        let magnitude = difference.unsigned_abs() + 1;
        let bits = 31 - magnitude.leading_zeros();
        for k in 0..=bits {
            encoder.bit(&mut chances[class * 64 + k as usize], k == bits);
        }
        for k in (0..bits).rev() {
            let bit = magnitude >> k & 1 == 1;
            // The bit behind the leading one is not even either.
            if k + 1 == bits {
                encoder.bit(&mut chances[class * 64 + 32 + k as usize], bit);
            } else {
                encoder.even_bit(bit);
            }
        }
        if difference != 0 {
            encoder.even_bit(difference < 0);
        }
        class = (bits as usize).min(2);
    }
    encoder.finish().len()
}

fn zstd_bytes(shape: &[(usize, bool)], levels: &[i32]) -> usize {
    let byte = |c: &[(usize, bool)]| c.iter().fold(0, |b, (_, leaf)| b << 1 | u8::from(*leaf));
    let mut bytes: Vec<u8> = shape.chunks(8).map(byte).collect();
    (0..2).for_each(|plane| bytes.extend(levels.iter().map(|level| level.to_le_bytes()[plane])));
    let effort = if levels.len() < 100_000 { 19 } else { 9 };
    zstd::bulk::compress(&bytes, effort).unwrap().len()
}
