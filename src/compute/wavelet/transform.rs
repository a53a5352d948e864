//! Orthonormal wavelet transform: multiwavelets with weights on a tree of cells.
//!
//! Every group of cells has as many *scaling functions* as the chosen [`Order`] has polynomials, orthonormal under Σ w
//! f g with w = projected solid angle; the remainder of the functions of the groups inside is expressed by *wavelets*.
//! With the constant alone this is the weighted Haar transform (Schröder and Sweldens 1995; SOHO of Lessig and Fiume
//! 2008 for triangles). With x, y, z of the direction as well, wavelets vanish on everything that is linear in the
//! direction (Alpert 1993, here on points of arbitrary weight). The first scaling function is the constant, so that one
//! coefficient alone determines τ.

use super::hierarchy::{Group, Hierarchy};
use glam::DVec3;

/// Order of wavelets: the functions of the direction that a group of cells expresses without wavelets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Order {
    /// Constants: Haar wavelets.
    Constant,
    /// Functions linear in the direction: 1, x, y, z.
    Linear,
    /// Functions quadratic in the direction, nine of them on the sphere.
    Quadratic,
}

impl Order {
    /// Returns the number of polynomials of the order: 1, 4 or 9.
    pub const fn functions(self) -> usize {
        match self {
            Self::Constant => 1,
            Self::Linear => 4,
            Self::Quadratic => 9,
        }
    }
}

/// Group of cells with the orthonormal matrix from the coefficients of its parts to its scaling functions and wavelets.
#[derive(Debug, Clone, Copy)]
pub struct Block {
    /// Level of the group in the tree, 0 for the root.
    pub level: u32,
    /// Index of the block that contains this one; for the root the index of the root.
    pub parent: u32,
    /// Index of the first block directly inside.
    pub first_child: u32,
    /// Number of blocks directly inside; 0 if the parts are cells.
    pub children: u32,
    /// Projected solid angle ∫cosθ dω of all cells of the group. \[sr\]
    pub weight: f64,
    /// Index of the first coefficient of the block's wavelets.
    pub wavelets: u32,
    inputs: u32,
    kept: u32,
    input_at: u32,
    kept_at: u32,
    matrix_at: usize,
    /// Range of the group's cells in `order`.
    cells: [u32; 2],
}

impl Block {
    /// Returns the number of wavelets of the block.
    pub fn wavelet_count(&self) -> usize {
        (self.inputs - self.kept) as usize
    }
}

/// Wavelet transform between values on cells and coefficients, for one tree of cells and one order.
#[derive(Debug, Clone)]
pub struct Transform {
    root_weight: Vec<f64>,
    inverse_root_weight: Vec<f64>,
    /// Indices of the cells in the order of the tree.
    order: Vec<u32>,
    blocks: Vec<Block>,
    matrices: Vec<f64>,
    kept: usize,
}

/// Relative length of a column's remainder (orthogonal to the rows before) below which it counts as rounding (2⁻⁵²).
const INDEPENDENT: f64 = 1e-6;

/// Powers of x, y, z of the polynomials: those of the orders, then one degree more. The wavelets follow them as far as
/// possible, so that few of them express smooth functions. On the sphere z² is not independent and left out.
const POWERS: [[i32; 3]; 16] = [
    [0, 0, 0],
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [2, 0, 0],
    [1, 1, 0],
    [0, 2, 0],
    [1, 0, 1],
    [0, 1, 1],
    [3, 0, 0],
    [2, 1, 0],
    [1, 2, 0],
    [0, 3, 0],
    [2, 0, 1],
    [1, 1, 1],
    [0, 2, 1],
];

impl Transform {
    /// Prepares the transform for a tree of cells and an order.
    pub fn new(hierarchy: &Hierarchy, order: Order) -> Self {
        let mut builder = Builder {
            hierarchy,
            functions: order.functions(),
            order: Vec::with_capacity(hierarchy.cells.len()),
            groups: Vec::new(),
        };
        builder.number(&hierarchy.root);
        let root_weight = hierarchy.cells.iter().map(|cell| cell.weight.sqrt()).collect();
        builder.finish(root_weight)
    }

    /// Returns the number of cells, which is also the number of coefficients.
    pub fn len(&self) -> usize {
        self.root_weight.len()
    }

    /// Whether there are no cells; always `false` for the cells of a basis.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the blocks of the tree, coarse to fine, each before its parts.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// Returns the number of coefficients of the root's scaling functions. The first is that of the constant.
    pub fn root_count(&self) -> usize {
        self.blocks.first().map_or(0, |root| root.kept as usize)
    }

    /// Returns the projected solid angle of all cells together. \[sr\]
    pub fn weight(&self) -> f64 {
        self.blocks.first().map_or(0.0, |root| root.weight)
    }

    /// Returns for each coefficient the projected solid angle of its group of cells. \[sr\]
    pub fn supports(&self) -> Vec<f64> {
        let mut supports = vec![self.weight(); self.len()];
        for block in &self.blocks {
            let from = block.wavelets as usize;
            supports[from..from + block.wavelet_count()].fill(block.weight);
        }
        supports
    }

    /// Computes the wavelet coefficients c of a function given by its means f over the cells; Σ w f² = Σ c².
    pub fn forward(&self, values: &[f64]) -> Vec<f64> {
        assert_eq!(values.len(), self.len(), "one value a cell");
        let leaves: Vec<f64> =
            self.order.iter().map(|&cell| values[cell as usize] * self.root_weight[cell as usize]).collect();
        let mut kept = vec![0.0; self.kept];
        let mut coefficients = vec![0.0; self.len()];
        for (index, block) in self.blocks.iter().enumerate().rev() {
            let (n, m) = (block.inputs as usize, block.kept as usize);
            let matrix = &self.matrices[block.matrix_at..block.matrix_at + n * n];
            let from = block.input_at as usize;
            let (head, tail) = kept.split_at_mut(if block.children == 0 { 0 } else { from });
            let input = if block.children == 0 { &leaves[from..from + n] } else { &tail[..n] };
            let dot =
                |row: usize| -> f64 { matrix[row * n..(row + 1) * n].iter().zip(input).map(|(a, b)| a * b).sum() };
            let wavelets = block.wavelets as usize;
            for row in m..n {
                coefficients[wavelets + row - m] = dot(row);
            }
            let outputs: Vec<f64> = (0..m).map(dot).collect();
            let at = block.kept_at as usize;
            if block.children == 0 { &mut tail[at..at + m] } else { &mut head[at..at + m] }.copy_from_slice(&outputs);
            if index == 0 {
                coefficients[..m].copy_from_slice(&outputs);
            }
        }
        coefficients
    }

    /// Computes the means over the cells of a function given by its wavelet coefficients.
    pub fn inverse(&self, coefficients: &[f64]) -> Vec<f64> {
        assert_eq!(coefficients.len(), self.len(), "one coefficient a cell");
        let flat = self.flat(coefficients);
        let mut leaves = vec![0.0; self.len()];
        let mut kept = vec![0.0; self.kept];
        let root = self.root_count();
        kept[..root].copy_from_slice(&coefficients[..root]);
        for (block, flat) in self.blocks.iter().zip(flat) {
            let (n, m, at) = (block.inputs as usize, block.kept as usize, block.kept_at as usize);
            if flat && m == 1 && block.weight > 0.0 {
                // The function is constant within this block; inner blocks find zeros and add nothing.
                let value = kept[at] / block.weight.sqrt();
                if value != 0.0 {
                    let [first, end] = block.cells.map(|at| at as usize);
                    for (leaf, &cell) in leaves[first..end].iter_mut().zip(&self.order[first..end]) {
                        *leaf = value * self.root_weight[cell as usize];
                    }
                }
                continue;
            }
            let matrix = &self.matrices[block.matrix_at..block.matrix_at + n * n];
            let from = block.input_at as usize;
            let (head, tail) = kept.split_at_mut(if block.children == 0 { self.kept } else { from });
            let output = if block.children == 0 { &mut leaves[from..from + n] } else { &mut tail[..n] };
            let mut add = |row: usize, c: f64| {
                if c != 0.0 {
                    output.iter_mut().zip(&matrix[row * n..(row + 1) * n]).for_each(|(o, q)| *o += c * q);
                }
            };
            head[at..at + m].iter().enumerate().for_each(|(row, &c)| add(row, c));
            let wavelets = block.wavelets as usize;
            coefficients[wavelets..wavelets + n - m].iter().enumerate().for_each(|(k, &c)| add(m + k, c));
        }
        let mut values = vec![0.0; self.len()];
        for (&cell, leaf) in self.order.iter().zip(leaves) {
            values[cell as usize] = leaf * self.inverse_root_weight[cell as usize];
        }
        values
    }

    /// Returns for each block whether all wavelet coefficients of it and of the blocks inside are 0.
    fn flat(&self, coefficients: &[f64]) -> Vec<bool> {
        let mut flat = vec![true; self.blocks.len()];
        for (index, block) in self.blocks.iter().enumerate().rev() {
            let from = block.wavelets as usize;
            if coefficients[from..from + block.wavelet_count()].iter().any(|c| *c != 0.0) {
                flat[index] = false;
            }
            if !flat[index] {
                flat[block.parent as usize] = false;
            }
        }
        flat
    }
}

/// Group while the tree is numbered.
struct Numbered {
    level: u32,
    parent: u32,
    /// Range of `order`.
    cells: [usize; 2],
    children: Vec<u32>,
}

struct Builder<'a> {
    hierarchy: &'a Hierarchy,
    functions: usize,
    order: Vec<u32>,
    groups: Vec<Numbered>,
}

impl Builder<'_> {
    /// Numbers the groups breadth first, so that the indices of the parts of a group are consecutive.
    fn number(&mut self, root: &Group) {
        fn cells(group: &Group, out: &mut Vec<u32>) {
            match group {
                Group::Cells(list) => out.extend(list),
                Group::Groups(list) => list.iter().for_each(|inner| cells(inner, out)),
            }
        }
        cells(root, &mut self.order);
        let mut queue = std::collections::VecDeque::from([(root, 0, 0, 0)]);
        while let Some((group, level, parent, first)) = queue.pop_front() {
            let index = self.groups.len() as u32;
            let mut count = 0;
            let mut from = first;
            if let Group::Groups(list) = group {
                for inner in list {
                    queue.push_back((inner, level + 1, index, from));
                    from += size(inner);
                }
                count = from - first;
            } else if let Group::Cells(list) = group {
                count = list.len();
            }
            if index > 0 {
                self.groups[parent as usize].children.push(index);
            }
            self.groups.push(Numbered { level, parent, cells: [first, first + count], children: Vec::new() });
        }
    }

    /// Computes the orthonormal matrix of every group from the leaves to the root, and creates the transform.
    fn finish(self, root_weight: Vec<f64>) -> Transform {
        let count = self.groups.len();
        // Scaling functions of every group on its cells, one vector each; dropped once the parent's exist.
        let mut functions: Vec<Vec<Vec<f64>>> = vec![Vec::new(); count];
        let mut matrices: Vec<Vec<Vec<f64>>> = vec![Vec::new(); count];
        for index in (0..count).rev() {
            let group = &self.groups[index];
            let cells = &self.order[group.cells[0]..group.cells[1]];
            let column = self.columns(cells, &root_weight);
            // Coordinates of a function on the cells with respect to the scaling functions of the children.
            let project = |column: &[f64]| -> Vec<f64> {
                if group.children.is_empty() {
                    return column.to_vec();
                }
                let mut out = Vec::new();
                for &child in &group.children {
                    let range = self.groups[child as usize].cells;
                    let part = &column[range[0] - group.cells[0]..range[1] - group.cells[0]];
                    out.extend(functions[child as usize].iter().map(|f| dot(f, part)));
                }
                out
            };
            let n = match group.children.as_slice() {
                [] => cells.len(),
                children => children.iter().map(|&child| functions[child as usize].len()).sum(),
            };
            let mut rows: Vec<Vec<f64>> = Vec::with_capacity(n);
            let mut kept = 0;
            for (k, power) in POWERS.iter().enumerate() {
                if rows.len() < n
                    && let Some(row) = independent(project(&column(power)), &rows)
                {
                    rows.push(row);
                    kept += usize::from(k < self.functions);
                }
            }
            for k in 0..n {
                if rows.len() < n {
                    let mut unit = vec![0.0; n];
                    unit[k] = 1.0;
                    rows.extend(independent(unit, &rows));
                }
            }
            let scaling = rows[..kept].iter().map(|row| {
                let mut on_cells = vec![0.0; cells.len()];
                if group.children.is_empty() {
                    on_cells.copy_from_slice(row);
                } else {
                    let mut at = 0;
                    for &child in &group.children {
                        let range = self.groups[child as usize].cells;
                        let place = &mut on_cells[range[0] - group.cells[0]..range[1] - group.cells[0]];
                        for f in &functions[child as usize] {
                            place.iter_mut().zip(f).for_each(|(o, f)| *o += row[at] * f);
                            at += 1;
                        }
                    }
                }
                on_cells
            });
            functions[index] = scaling.collect();
            for &child in &group.children {
                // Only their number is still needed.
                functions[child as usize].iter_mut().for_each(|f| *f = Vec::new());
            }
            matrices[index] = rows;
        }
        self.lay_out(root_weight, &functions, matrices)
    }

    /// Returns a function that evaluates polynomials about the group's middle, times √w, given by their [`POWERS`].
    fn columns(&self, cells: &[u32], root_weight: &[f64]) -> impl Fn(&[i32; 3]) -> Vec<f64> {
        let points = &self.hierarchy.cells;
        let weight: f64 = cells.iter().map(|&cell| points[cell as usize].weight).sum();
        let middle: DVec3 =
            cells.iter().map(|&c| points[c as usize].centre * points[c as usize].weight).sum::<DVec3>() / weight;
        let about: Vec<(f64, DVec3)> =
            cells.iter().map(|&cell| (root_weight[cell as usize], points[cell as usize].centre - middle)).collect();
        move |power| {
            let value = |(root, d): &(f64, DVec3)| root * d.x.powi(power[0]) * d.y.powi(power[1]) * d.z.powi(power[2]);
            about.iter().map(value).collect()
        }
    }

    /// Stores the matrices of all groups (`rows`) one after the other. `functions`: scaling functions of every group.
    fn lay_out(self, root_weight: Vec<f64>, functions: &[Vec<Vec<f64>>], rows: Vec<Vec<Vec<f64>>>) -> Transform {
        let mut blocks: Vec<Block> = Vec::with_capacity(self.groups.len());
        let mut matrices = Vec::new();
        let (mut kept_at, mut wavelets) = (0, functions.first().map_or(0, Vec::len) as u32);
        for ((group, functions), rows) in self.groups.iter().zip(functions).zip(&rows) {
            let kept = functions.len() as u32;
            let cells = &self.order[group.cells[0]..group.cells[1]];
            blocks.push(Block {
                level: group.level,
                parent: group.parent,
                first_child: group.children.first().copied().unwrap_or_default(),
                children: group.children.len() as u32,
                weight: cells.iter().map(|&cell| self.hierarchy.cells[cell as usize].weight).sum(),
                wavelets,
                inputs: rows.len() as u32,
                kept,
                input_at: group.cells[0] as u32,
                kept_at,
                matrix_at: matrices.len(),
                cells: group.cells.map(|at| at as u32),
            });
            rows.iter().for_each(|row| matrices.extend(row));
            kept_at += kept;
            wavelets += rows.len() as u32 - kept;
        }
        for index in 0..blocks.len() {
            if blocks[index].children > 0 {
                blocks[index].input_at = blocks[blocks[index].first_child as usize].kept_at;
            }
        }
        let inverse_root_weight = root_weight.iter().map(|root| if *root > 0.0 { 1.0 / root } else { 0.0 }).collect();
        Transform { root_weight, inverse_root_weight, order: self.order, blocks, matrices, kept: kept_at as usize }
    }
}

fn size(group: &Group) -> usize {
    match group {
        Group::Cells(list) => list.len(),
        Group::Groups(list) => list.iter().map(size).sum(),
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns the part of a vector that is orthogonal to the rows, scaled to length 1; `None` if it is 0.
fn independent(mut vector: Vec<f64>, rows: &[Vec<f64>]) -> Option<Vec<f64>> {
    let before = dot(&vector, &vector).sqrt();
    // Twice is enough (Kahan, Parlett); a third time for columns that are almost dependent.
    for _ in 0..3 {
        for row in rows {
            let c = dot(&vector, row);
            vector.iter_mut().zip(row).for_each(|(v, r)| *v -= c * r);
        }
    }
    let length = dot(&vector, &vector).sqrt();
    (length > INDEPENDENT * before && length > 0.0).then(|| vector.into_iter().map(|v| v / length).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::{AzimuthMap, RingBasis};

    fn hierarchies() -> Vec<(Hierarchy, Order)> {
        let mut all = Vec::new();
        for order in [Order::Constant, Order::Linear, Order::Quadratic] {
            for basis in [
                RingBasis::hemisphere(),
                RingBasis::klems_full(AzimuthMap::KLEMS_BACK),
                RingBasis::tregenza(),
                RingBasis::equal_area(12),
            ] {
                all.push((Hierarchy::of_rings(&basis, 2 * order.functions()), order));
            }
        }
        all
    }

    /// Values that look like noise, the same every time.
    fn rough(n: usize) -> Vec<f64> {
        (0..n).map(|k| ((k * 7919 + 13) % 1009) as f64 / 1009.0).collect()
    }

    #[test]
    fn energy_and_values_come_back() {
        for (hierarchy, order) in hierarchies() {
            let transform = Transform::new(&hierarchy, order);
            let values = rough(transform.len());
            let coefficients = transform.forward(&values);
            let energy: f64 = hierarchy.cells.iter().zip(&values).map(|(cell, v)| cell.weight * v * v).sum();
            let kept: f64 = coefficients.iter().map(|c| c * c).sum();
            assert!((kept / energy - 1.0).abs() < 1e-12, "{order:?} {}", transform.len());
            let tau: f64 = hierarchy.cells.iter().zip(&values).map(|(cell, v)| cell.weight * v).sum();
            assert!((coefficients[0] * transform.weight().sqrt() - tau).abs() < 1e-12 * tau);
            for (a, b) in transform.inverse(&coefficients).iter().zip(&values) {
                assert!((a - b).abs() < 1e-11, "{order:?}: {a} {b}");
            }
        }
    }

    #[test]
    fn dropping_wavelets_never_changes_tau() {
        for (hierarchy, order) in hierarchies() {
            let transform = Transform::new(&hierarchy, order);
            let values = rough(transform.len());
            let mut coefficients = transform.forward(&values);
            coefficients.iter_mut().enumerate().skip(1).filter(|(k, _)| k % 3 != 0).for_each(|(_, c)| *c = 0.0);
            let tau = |v: &[f64]| -> f64 { hierarchy.cells.iter().zip(v).map(|(cell, v)| cell.weight * v).sum() };
            assert!((tau(&transform.inverse(&coefficients)) - tau(&values)).abs() < 1e-12);
        }
    }

    #[test]
    fn wavelets_are_blind_to_the_polynomials_of_their_order() {
        for (hierarchy, order) in hierarchies() {
            let transform = Transform::new(&hierarchy, order);
            let value = |d: DVec3| match order {
                Order::Constant => 0.7,
                Order::Linear => 0.7 + 0.3 * d.x - 0.4 * d.y + 0.2 * d.z,
                Order::Quadratic => 0.7 + 0.3 * d.x - 0.4 * d.y * d.y + 0.2 * d.z * d.x + 0.1 * d.x * d.y,
            };
            let values: Vec<f64> = hierarchy.cells.iter().map(|cell| value(cell.centre)).collect();
            let coefficients = transform.forward(&values);
            let wavelets = &coefficients[transform.root_count()..];
            assert!(wavelets.iter().all(|c| c.abs() < 1e-9), "{order:?} {}", transform.len());
        }
    }
}
