//! Exchange areas A·F between the patches of two nested meshes of one box, from shared tables of corner values.
//!
//! A pair of walls needs the corner function only for the distinct differences between their grid lines: for lines
//! along the common axis only the distance matters, so that many combinations coincide.

use super::form_factor::{parallel_corner, perpendicular_corner};
use super::mesh::{Mesh, Nested, Wall};
use faer::MatRef;

/// Exchange areas A·F (area times form factor) of every receiving patch (row) and emitting patch (column). \[m²\] They
/// depend on the shape of a room alone, so that rooms whose surfaces differ in reflectance share them.
pub struct Exchange {
    columns: usize,
    values: Vec<f64>,
}

impl Exchange {
    /// Computes the exchange areas of the coarse patches of a meshed room with the fine ones.
    pub fn level(nested: &Nested) -> Self {
        Self::new(&nested.coarse, &nested.fine)
    }

    /// Returns the exchange areas of the coarser patches with the coarse ones, by sums of those of [`Self::level`].
    pub fn coarser(&self, nested: &Nested) -> Self {
        let (receivers, emitters) = (nested.coarser.patches.len(), nested.coarse.patches.len());
        self.gathered(Some(&nested.coarser_of_coarse), receivers, &nested.coarse_of_fine, emitters)
    }

    /// Returns the memory that they take. \[bytes\]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.values[..])
    }

    /// Computes the exchange areas between the patches of two meshes of the same box room.
    pub fn new(receivers: &Mesh, emitters: &Mesh) -> Self {
        let columns = emitters.patches.len();
        let mut exchange = Self { columns, values: vec![0.0; receivers.patches.len() * columns] };
        for a in &receivers.walls {
            for b in &emitters.walls {
                if a.axis != b.axis {
                    exchange.perpendicular(a, b);
                } else if a.position != b.position {
                    exchange.parallel(a, b);
                }
            }
        }
        exchange
    }

    /// Returns the exchange areas of one receiving patch with every emitting patch. \[m²\]
    pub fn row(&self, receiver: usize) -> &[f64] {
        &self.values[receiver * self.columns..(receiver + 1) * self.columns]
    }

    /// Returns the exchange areas as a matrix: a row for each receiving patch, a column for each emitting patch. \[m²\]
    pub fn matrix(&self) -> MatRef<'_, f64> {
        MatRef::from_row_major_slice(&self.values, self.rows(), self.columns)
    }

    /// Returns the number of receiving patches.
    pub fn rows(&self) -> usize {
        self.values.len() / self.columns.max(1)
    }

    /// Returns the exchange areas summed over groups of patches, with `rows` rows and `columns` columns. `row_of[i]`
    /// and `column_of[j]` are the row and the column of the result to which the patches i and j belong.
    pub fn gathered(&self, row_of: Option<&[usize]>, rows: usize, column_of: &[usize], columns: usize) -> Self {
        let mut values = vec![0.0; rows * columns];
        for i in 0..self.rows() {
            let to = row_of.map_or(i, |of| of[i]) * columns;
            for (&column, af) in column_of.iter().zip(self.row(i)) {
                values[to + column] += af;
            }
        }
        Self { columns, values }
    }

    /// Computes the exchange areas between the patches of two parallel walls.
    fn parallel(&mut self, a: &Wall, b: &Wall) {
        let z = (a.position - b.position).abs();
        // Both walls lie across the same axis, so that their lines run along the same two. The corner function G is
        // even in both offsets: distances are enough, and equal ones share an entry.
        let [x, y] = [0, 1].map(|side| Differences::new(&a.lines[side], &b.lines[side]));
        let table: Vec<f64> =
            x.values.iter().flat_map(|&x| y.values.iter().map(move |&y| parallel_corner(x, y, z))).collect();
        let width = y.values.len();
        let (b0, b1) = (b.lines[0].len() - 1, b.lines[1].len() - 1);
        for i in 0..a.lines[0].len() - 1 {
            for j in 0..a.lines[1].len() - 1 {
                let row = a.first + i * (a.lines[1].len() - 1) + j;
                for k in 0..b0 {
                    let base = row * self.columns + b.first + k * b1;
                    // A F = Σ (−1)^(i+j+k+l) G(x_i − ξ_k, y_j − η_l, z): the second difference in x first, whose places
                    // in the table serve the whole run over l, then that in y.
                    let at = [x.at(i, k), x.at(i + 1, k), x.at(i, k + 1), x.at(i + 1, k + 1)].map(|x| x * width);
                    let out = &mut self.values[base..base + b1];
                    for (l, af) in out.iter_mut().enumerate() {
                        let sum = |y: usize| table[at[0] + y] - table[at[1] + y] - table[at[2] + y] + table[at[3] + y];
                        // Negative only by rounding, if patches are small and far apart.
                        *af = (sum(y.at(j, l)) - sum(y.at(j + 1, l)) - sum(y.at(j, l + 1)) + sum(y.at(j + 1, l + 1)))
                            .abs();
                    }
                }
            }
        }
    }

    /// Computes the exchange areas between the patches of two perpendicular walls.
    fn perpendicular(&mut self, a: &Wall, b: &Wall) {
        // The common axis runs along both walls; the other axis of a wall is counted from the line where they meet.
        let common = 3 - a.axis - b.axis;
        let place = |wall: &Wall| usize::from(wall.along[1] == common);
        let (pa, pb) = (place(a), place(b));
        let across = |wall: &Wall, p: usize, meets: f64| -> Vec<f64> {
            wall.lines[1 - p].iter().map(|line| (line - meets).abs()).collect()
        };
        let (xa, yb) = (across(a, pa, b.position), across(b, pb, a.position));
        let u = Differences::new(&a.lines[pa], &b.lines[pb]);
        // Second differences in the two distances from the common edge, for every distance along it.
        let (na, nb) = (xa.len() - 1, yb.len() - 1);
        let mut second = vec![0.0; u.values.len() * na * nb];
        let mut corner = vec![0.0; xa.len() * yb.len()];
        for (&u, second) in u.values.iter().zip(second.chunks_exact_mut(na * nb)) {
            for (&x, row) in xa.iter().zip(corner.chunks_exact_mut(yb.len())) {
                for (&y, value) in yb.iter().zip(row) {
                    *value = perpendicular_corner(u, x, y);
                }
            }
            for k in 0..na {
                for l in 0..nb {
                    let at = k * yb.len() + l;
                    second[k * nb + l] =
                        corner[at] - corner[at + 1] - corner[at + yb.len()] + corner[at + yb.len() + 1];
                }
            }
        }
        let index = |wall: &Wall, p: usize, along: usize, across: usize| {
            let n1 = wall.lines[1].len() - 1;
            wall.first + if p == 0 { along * n1 + across } else { across * n1 + along }
        };
        for i in 0..a.lines[pa].len() - 1 {
            for j in 0..b.lines[pb].len() - 1 {
                let at = [u.at(i, j), u.at(i + 1, j), u.at(i, j + 1), u.at(i + 1, j + 1)].map(|u| u * na * nb);
                for k in 0..na {
                    let row = index(a, pa, i, k) * self.columns;
                    for l in 0..nb {
                        let cell = k * nb + l;
                        let value =
                            second[at[0] + cell] - second[at[1] + cell] - second[at[2] + cell] + second[at[3] + cell];
                        self.values[row + index(b, pb, j, l)] = value.abs();
                    }
                }
            }
        }
    }
}

/// Distinct distances between the grid lines of two lists.
struct Differences {
    values: Vec<f64>,
    /// Index in `values` of each pair's distance.
    index: Vec<usize>,
    width: usize,
}

impl Differences {
    fn new(a: &[f64], b: &[f64]) -> Self {
        let length = a.last().copied().unwrap_or(0.0);
        let mut order: Vec<(f64, usize)> =
            a.iter().flat_map(|a| b.iter().map(move |b| (a - b).abs())).enumerate().map(|(i, d)| (d, i)).collect();
        order.sort_by(|p, q| p.0.total_cmp(&q.0));
        let mut values: Vec<f64> = Vec::new();
        let mut index = vec![0; order.len()];
        for (distance, pair) in order {
            // Distances that differ by rounding only count as equal.
            if values.last().is_none_or(|last| distance - last > 4.0 * f64::EPSILON * length) {
                values.push(distance);
            }
            index[pair] = values.len() - 1;
        }
        Self { values, index, width: b.len() }
    }

    fn at(&self, a: usize, b: usize) -> usize {
        self.index[a * self.width + b]
    }
}
