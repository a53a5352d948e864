//! Tree of groups of cells, by recursive halving of a basis, on which the wavelets are defined.
//!
//! The cells of any ring basis are halved in the square that Shirley and Chiu map to the disk, with √(1 − cosθ) as the
//! radius of the disk, so that equal areas are equal solid angles: groups of cells are about as wide as high, and their
//! borders follow the rings.

use crate::compute::basis::{RingBasis, square_from_disk};
use glam::DVec3;

/// Cell of a basis, reduced to its weight and the direction of its centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellPoint {
    /// Projected solid angle ∫cosθ dω of the cell. \[sr\]
    pub weight: f64,
    /// Unit vector to the centre of the cell, façade frame; a reversed emergent direction.
    pub centre: DVec3,
}

/// Group of cells in the tree: either a few cells or smaller groups.
#[derive(Debug, Clone, PartialEq)]
pub enum Group {
    /// Indices of the cells of the group.
    Cells(Vec<u32>),
    /// Smaller groups that make up the group.
    Groups(Vec<Group>),
}

/// Cells of a basis with a tree of groups of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Hierarchy {
    /// Cells, in the order of the values of an indicatrix.
    pub cells: Vec<CellPoint>,
    /// Root of the tree: the group of all cells.
    pub root: Group,
}

impl Hierarchy {
    /// Creates the tree for the cells of a ring basis, halved down to groups of at most `most` cells (≥ 1).
    pub fn of_rings(basis: &RingBasis, most: usize) -> Self {
        let mut cells = Vec::with_capacity(basis.len());
        let mut places = Vec::with_capacity(basis.len());
        for cell in basis.cells() {
            cells.push(CellPoint { weight: cell.projected_solid_angle(), centre: cell.centre().vector() });
            // 1 − cosθ = 2 sin²(θ/2)
            let r = std::f64::consts::SQRT_2 * (0.5 * cell.theta()).sin();
            let (sin, cos) = cell.phi.sin_cos();
            places.push(square_from_disk([r * cos, r * sin]));
        }
        let mut all: Vec<u32> = (0..cells.len() as u32).collect();
        let root = halve(&mut all, &places, most.max(1));
        Self { cells, root }
    }
}

/// Divides cells into groups of at most `most` cells, by repeated halving across the longer side. `places`: positions
/// of all cells on the square of Shirley and Chiu.
fn halve(cells: &mut [u32], places: &[[f64; 2]], most: usize) -> Group {
    if cells.len() <= most {
        let mut list = cells.to_vec();
        list.sort_unstable();
        return Group::Cells(list);
    }
    let extent = |axis: usize| {
        let range = cells.iter().map(|&cell| places[cell as usize][axis]);
        range.clone().fold(f64::NEG_INFINITY, f64::max) - range.fold(f64::INFINITY, f64::min)
    };
    // Equal extents are divided along the second axis, so that borders do not depend on rounding.
    let axis = usize::from(extent(1) > 0.999_999 * extent(0));
    // Coordinates that differ by rounding only are equal; then the other coordinate decides, then the index.
    let key = |cell: u32| {
        let grain = |x: f64| (x * 1e9).round() as i64;
        let place = places[cell as usize];
        (grain(place[axis]), grain(place[1 - axis]), cell)
    };
    cells.sort_unstable_by_key(|&cell| key(cell));
    let half = middle(cells.len(), |k| key(cells[k]).0);
    let (low, high) = cells.split_at_mut(half);
    Group::Groups(vec![halve(low, places, most), halve(high, places, most)])
}

/// Returns the index at which a sorted list of cells is divided: at the change of position nearest to the middle, if
/// one lies within its inner 40 %, otherwise in the middle.
fn middle(count: usize, place: impl Fn(usize) -> i64) -> usize {
    let half = count / 2;
    for step in 0..=count / 5 {
        for at in [half - step, half + step] {
            if at > 0 && at < count && place(at) - place(at - 1) > 100 {
                return at;
            }
        }
    }
    half
}
