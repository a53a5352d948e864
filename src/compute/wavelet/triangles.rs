//! The triangle quadtree over the hemisphere: four faces of an octahedron, every triangle parted into four.

use crate::compute::basis::RingBasis;
use glam::DVec3;

/// A leaf.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    /// Corners, unit vectors, façade frame.
    pub corners: [DVec3; 3],
    /// Middle, a unit vector.
    pub centre: DVec3,
    /// Projected solid angle. \[sr\]
    pub weight: f64,
}

/// Leaves of one level; children of a triangle stand side by side.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleTree {
    leaves: Vec<Triangle>,
}

/// Deepest tree: 4⁹ leaves of 0.28°.
const DEEPEST: u32 = 8;

impl TriangleTree {
    /// 4^(level + 1) leaves; `None` unless 1 ≤ level ≤ 8.
    pub fn new(level: u32) -> Option<Self> {
        if !(1..=DEEPEST).contains(&level) {
            return None;
        }
        let rim = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y];
        let mut faces: Vec<[DVec3; 3]> = (0..4).map(|i| [DVec3::Z, rim[i], rim[(i + 1) % 4]]).collect();
        for _ in 0..level {
            faces = faces.into_iter().flat_map(quarters).collect();
        }
        let leaf = |corners: [DVec3; 3]| Triangle {
            corners,
            centre: (corners[0] + corners[1] + corners[2]).normalize_or_zero(),
            weight: projected_solid_angle(corners),
        };
        Some(Self { leaves: faces.into_iter().map(leaf).collect() })
    }

    /// Coarsest level whose leaves are not larger than the mean cell of the data, 8 at most.
    pub fn level_for(basis: &RingBasis) -> u32 {
        (1..DEEPEST).find(|&level| 4_usize.pow(level + 1) >= basis.len()).unwrap_or(DEEPEST)
    }

    /// The leaves.
    pub fn leaves(&self) -> &[Triangle] {
        &self.leaves
    }

    /// The leaf that holds a direction with z ≥ 0: down the tree, by the sides of its great circles.
    pub fn index(&self, d: DVec3) -> usize {
        let quadrant = match (d.x >= 0.0, d.y >= 0.0) {
            (true, true) => 0,
            (false, true) => 1,
            (false, false) => 2,
            (true, false) => 3,
        };
        let rim = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y];
        let mut face = [DVec3::Z, rim[quadrant], rim[(quadrant + 1) % 4]];
        let mut index = quadrant;
        let mut count = self.leaves.len() / 4;
        while count > 1 {
            let parts = quarters(face);
            // The inner triangle's edges part it from the three at the corners.
            let [ab, bc, ca] = parts[3];
            let child = if outside(ca, ab, face[0], d) {
                0
            } else if outside(ab, bc, face[1], d) {
                1
            } else if outside(bc, ca, face[2], d) {
                2
            } else {
                3
            };
            face = parts[child];
            index = 4 * index + child;
            count /= 4;
        }
        index
    }
}

/// Does the great circle through p and q part d from the inner triangle, that is, does it lie on the corner's side?
fn outside(p: DVec3, q: DVec3, corner: DVec3, d: DVec3) -> bool {
    let normal = p.cross(q);
    normal.dot(d) * normal.dot(corner) > 0.0
}

/// At the corners, then the inner one.
fn quarters([a, b, c]: [DVec3; 3]) -> [[DVec3; 3]; 4] {
    let middle = |p: DVec3, q: DVec3| (p + q).normalize_or_zero();
    let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

/// ½ |Σ edges angle · (p × q)_z / |p × q||, Lambert's formula for the normal z. \[sr\]
fn projected_solid_angle(corners: [DVec3; 3]) -> f64 {
    let edge = |i: usize| {
        let (p, q) = (corners[i], corners[(i + 1) % 3]);
        let cross = p.cross(q);
        let length = cross.length();
        length.atan2(p.dot(q)) * cross.z / length
    };
    (0..3).map(edge).sum::<f64>().abs() / 2.0
}

/// Overlaps of ring cells with triangles, by which values change places without loss of flux.
#[derive(Debug, Clone)]
pub struct Overlap {
    /// For every ring cell the leaves that it overlaps, with the projected solid angle in common. \[sr\]
    cells: Vec<Vec<(u32, f64)>>,
    leaves: usize,
}

impl Overlap {
    /// Every cell is cut into equal parts of projected solid angle, each counted to the leaf that holds its middle;
    /// about `parts`² parts a leaf.
    pub fn new(basis: &RingBasis, tree: &TriangleTree, parts: usize) -> Self {
        let leaf_width = (2.0 * std::f64::consts::PI / tree.leaves().len() as f64).sqrt() / parts.max(1) as f64;
        let list = |cell: crate::compute::basis::Cell| {
            let (s0, s1) = (cell.theta_min.sin().powi(2), cell.theta_max.sin().powi(2));
            let high = ((cell.theta_max - cell.theta_min) / leaf_width).ceil().max(1.0) as usize;
            let wide = (cell.width * cell.theta_max.sin() / leaf_width).ceil().max(1.0) as usize;
            let weight = cell.projected_solid_angle() / (high * wide) as f64;
            let mut out: Vec<(u32, f64)> = Vec::new();
            for i in 0..high {
                let s2 = s0 + (s1 - s0) * (i as f64 + 0.5) / high as f64;
                for j in 0..wide {
                    let phi = cell.phi + cell.width * ((j as f64 + 0.5) / wide as f64 - 0.5);
                    let (sin, cos) = phi.sin_cos();
                    let s = s2.sqrt();
                    let leaf = tree.index(DVec3::new(s * cos, s * sin, (1.0 - s2).max(0.0).sqrt())) as u32;
                    match out.iter_mut().find(|(known, _)| *known == leaf) {
                        Some(entry) => entry.1 += weight,
                        None => out.push((leaf, weight)),
                    }
                }
            }
            out
        };
        Self { cells: basis.cells().map(list).collect(), leaves: tree.leaves().len() }
    }

    /// Projected solid angle of every leaf as far as cells cover it, in the same count as the overlaps: with it,
    /// uniform values stay uniform and no flux is lost. \[sr\]
    pub fn leaf_weights(&self) -> Vec<f64> {
        let mut weights = vec![0.0; self.leaves];
        self.cells.iter().flatten().for_each(|&(leaf, weight)| weights[leaf as usize] += weight);
        weights
    }

    /// Means over the leaves of a function that is constant on the cells.
    pub fn to_leaves(&self, values: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.leaves];
        for (list, value) in self.cells.iter().zip(values) {
            list.iter().for_each(|&(leaf, weight)| out[leaf as usize] += weight * value);
        }
        out.iter_mut().zip(self.leaf_weights()).for_each(|(o, w)| *o = if w > 0.0 { *o / w } else { 0.0 });
        out
    }

    /// Means over the cells of a function that is constant on the leaves.
    pub fn to_cells(&self, values: &[f64]) -> Vec<f64> {
        let mean = |list: &Vec<(u32, f64)>| {
            let total: f64 = list.iter().map(|(_, weight)| weight).sum();
            list.iter().map(|&(leaf, weight)| weight * values[leaf as usize]).sum::<f64>() / total
        };
        self.cells.iter().map(mean).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn leaves_tile_the_hemisphere() {
        for level in 1..=6 {
            let tree = TriangleTree::new(level).unwrap();
            assert_eq!(tree.leaves().len(), 4_usize.pow(level + 1));
            let sum: f64 = tree.leaves().iter().map(|leaf| leaf.weight).sum();
            assert!((sum - PI).abs() < 1e-12, "{level}: {sum}");
            for (index, leaf) in tree.leaves().iter().enumerate() {
                assert_eq!(tree.index(leaf.centre), index);
            }
        }
        assert!(TriangleTree::new(0).is_none() && TriangleTree::new(9).is_none());
    }

    #[test]
    fn changing_places_keeps_flux_and_uniform_values() {
        let basis = RingBasis::equal_area(14);
        let tree = TriangleTree::new(TriangleTree::level_for(&basis)).unwrap();
        let overlap = Overlap::new(&basis, &tree, 8);
        let weights = overlap.leaf_weights();
        // Counted areas are close to the exact ones.
        let off: Vec<f64> = weights.iter().zip(tree.leaves()).map(|(w, leaf)| (w / leaf.weight - 1.0).abs()).collect();
        let mean = off.iter().sum::<f64>() / off.len() as f64;
        assert!(mean < 0.08 && off.iter().all(|off| *off < 0.5), "{mean}, {}", off.iter().copied().fold(0.0, f64::max));
        let values: Vec<f64> = (0..basis.len()).map(|k| ((k * 37) % 11) as f64).collect();
        let leaves = overlap.to_leaves(&values);
        let flux: f64 = weights.iter().zip(&leaves).map(|(w, v)| w * v).sum();
        let before: f64 = basis.projected_solid_angles().iter().zip(&values).map(|(w, v)| w * v).sum();
        assert!((flux - before).abs() < 1e-11 * before);
        let after: f64 = basis.projected_solid_angles().iter().zip(overlap.to_cells(&leaves)).map(|(w, v)| w * v).sum();
        assert!((after - before).abs() < 1e-11 * before);
        assert!(overlap.to_leaves(&vec![2.5; basis.len()]).iter().all(|v| (v - 2.5).abs() < 1e-12));
    }
}
