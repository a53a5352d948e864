//! A tensor tree of rank 4 in the shape of Radiance's, with every advantage: pruned for least misplaced flux instead of
//! by differences, leaves rounded to the best of several precisions, below the incident resolution of the data only
//! the emergent square is parted, and values coded by the same arithmetic coder or zstd, whichever is smaller.

use cfs::compute::basis::{RingBasis, SquareGrid};
use cfs::compute::btdf::Indicatrices;
use cfs::formats::compact_rows::range_coder::{Chance, Encoder};
use std::collections::HashMap;

/// Cells along the incident side: as many as 145 directions fill.
const IN: usize = 16;
/// Levels of the incident square.
const IN_LEVELS: usize = 4;
/// Levels of the emergent square: 64 × 64 cells of about 2.5°.
const OUT_LEVELS: usize = 6;
const OUT: usize = 1 << OUT_LEVELS;

pub struct Grid {
    /// q by incident cell, then emergent cell, both row by row.
    pub values: Vec<f64>,
    /// Incident cell of each incident direction.
    cell_of: Vec<usize>,
    emergent: SquareGrid,
}

struct Pruned<'a> {
    grid: &'a Grid,
    lambda: f64,
    /// Whether a node is a leaf, and its mean, by (level, corners).
    leaves: HashMap<(usize, [usize; 4]), f64>,
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
        let values = values.collect();
        let cell_of = data.incident().iter().map(|d| incident.index(d.0).unwrap()).collect();
        Self { values, cell_of, emergent }
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
    pub fn ladder(&self) -> Vec<(Vec<f64>, usize)> {
        let mean: f64 = self.values.iter().sum::<f64>() / self.values.len() as f64;
        let mut out = vec![];
        for k in 0..13 {
            let mut pruned = Pruned { grid: self, lambda: mean * 0.004 * 2.2_f64.powi(k), leaves: HashMap::new() };
            pruned.node(0, [0; 4]);
            for precision in [0.005, 0.02, 0.05, 0.12] {
                out.push(pruned.coded(precision, mean));
            }
        }
        out
    }
}

impl Pruned<'_> {
    /// Ranges of a node: incident x, y, emergent x, y, in finest cells.
    fn ranges(level: usize, corner: [usize; 4]) -> [std::ops::Range<usize>; 4] {
        let incident = IN >> level.min(IN_LEVELS);
        let emergent = OUT >> level;
        std::array::from_fn(|d| {
            let side = if d < 2 { incident } else { emergent };
            corner[d] * side..(corner[d] + 1) * side
        })
    }

    fn each(level: usize, corner: [usize; 4], mut f: impl FnMut(usize)) {
        let [ix, iy, ox, oy] = Self::ranges(level, corner);
        for iy in iy {
            for ix in ix.clone() {
                for oy in oy.clone() {
                    for ox in ox.clone() {
                        f((iy * IN + ix) * OUT * OUT + oy * OUT + ox);
                    }
                }
            }
        }
    }

    fn children(level: usize, corner: [usize; 4]) -> Vec<[usize; 4]> {
        let parted = if level < IN_LEVELS { 0 } else { 2 };
        (0..1 << (4 - parted))
            .map(|k| std::array::from_fn(|d| if d < parted { corner[d] } else { 2 * corner[d] + (k >> (d - parted) & 1) }))
            .collect()
    }

    /// Least cost of a subtree: |q − mean| summed, and λ a leaf.
    fn node(&mut self, level: usize, corner: [usize; 4]) -> f64 {
        let (mut sum, mut count, mut off) = (0.0, 0.0, 0.0);
        Self::each(level, corner, |at| {
            sum += self.grid.values[at];
            count += 1.0;
        });
        let mean: f64 = sum / count;
        Self::each(level, corner, |at| off += (self.grid.values[at] - mean).abs());
        let merged = off + self.lambda;
        if level == OUT_LEVELS {
            self.leaves.insert((level, corner), mean);
            return merged;
        }
        let parts: f64 = Self::children(level, corner).into_iter().map(|child| self.node(level + 1, child)).sum();
        if merged <= parts {
            self.leaves.insert((level, corner), mean);
            merged
        } else {
            parts
        }
    }

    /// Leaves rounded to steps of a relative precision (of absolute size below a thousandth of the mean), and bytes.
    fn coded(&self, precision: f64, mean: f64) -> (Vec<f64>, usize) {
        let floor = 1e-3 * mean.max(1e-30);
        let round = |q: f64| ((1.0 + q / floor).ln() / precision).round();
        let back = |level: f64| ((level * precision).exp() - 1.0) * floor;
        let mut values = vec![0.0; self.grid.values.len()];
        let (mut shape, mut levels) = (vec![], vec![]);
        let mut stack = vec![(0, [0; 4])];
        while let Some((level, corner)) = stack.pop() {
            let leaf = self.leaves.get(&(level, corner));
            if level < OUT_LEVELS {
                shape.push((level, leaf.is_some()));
            }
            match leaf {
                Some(q) => {
                    levels.push(round(*q) as i32);
                    Self::each(level, corner, |at| values[at] = back(round(*q)));
                }
                None => stack.extend(Self::children(level, corner).into_iter().rev().map(|c| (level + 1, c))),
            }
        }
        (values, coder_bytes(&shape, &levels).min(zstd_bytes(&shape, &levels)))
    }
}

/// Adaptive chances: shape by level and the node before, values by their difference to the leaf before.
fn coder_bytes(shape: &[(usize, bool)], levels: &[i32]) -> usize {
    let mut encoder = Encoder::new();
    let mut chances = vec![Chance::from_byte(128); 16];
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
            // The first bit behind the leading one is not even either.
            if k + 1 == bits { encoder.bit(&mut chances[class * 64 + 32 + k as usize], bit) } else { encoder.even_bit(bit) }
        }
        if difference != 0 {
            encoder.even_bit(difference < 0);
        }
        class = (bits as usize).min(2);
    }
    encoder.finish().len()
}

fn zstd_bytes(shape: &[(usize, bool)], levels: &[i32]) -> usize {
    let mut bytes: Vec<u8> = shape.chunks(8).map(|c| c.iter().fold(0, |b, (_, leaf)| b << 1 | u8::from(*leaf))).collect();
    (0..2).for_each(|plane| bytes.extend(levels.iter().map(|level| level.to_le_bytes()[plane])));
    zstd::bulk::compress(&bytes, 19).unwrap().len()
}

/// Fewest bytes of any tree whose error is not larger.
pub fn best_at(trees: &[(f64, f64)], error: f64) -> Option<f64> {
    trees.iter().filter(|(e, _)| *e <= error).map(|(_, bytes)| *bytes).min_by(f64::total_cmp)
}
