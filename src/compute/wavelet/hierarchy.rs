//! Cells of a division of the hemisphere, halved recursively: the tree on which the wavelets are defined.
//!
//! Rings of any instrument are halved in the square that Shirley and Chiu map to the disk, with the disk's radius taken
//! as √(1 − cosθ), so that equal areas are equal solid angles: groups of cells stay about as wide as high, and their
//! borders follow the rings.

use crate::compute::basis::{RingBasis, square_from_disk};
use glam::DVec3;

/// Cell reduced to weight and direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellPoint {
    /// Projected solid angle ∫cosθ dω. \[sr\]
    pub weight: f64,
    /// Direction of the centre; a unit vector, façade frame, through direction.
    pub centre: DVec3,
}

/// Group of cells: a few of them, or smaller groups.
#[derive(Debug, Clone, PartialEq)]
pub enum Group {
    /// Indices of cells.
    Cells(Vec<u32>),
    /// Smaller groups.
    Groups(Vec<Group>),
}

/// Cells with the tree of groups over them.
#[derive(Debug, Clone, PartialEq)]
pub struct Hierarchy {
    /// Cells, in the order in which values are given.
    pub cells: Vec<CellPoint>,
    /// Group of all cells.
    pub root: Group,
}

impl Hierarchy {
    /// Builds the tree over the cells of a ring basis, halved down to groups of at most `most` cells (≥ 1).
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
    // A tie goes to the vertical: borders must not depend on rounding.
    let axis = usize::from(extent(1) > 0.999_999 * extent(0));
    // Places that differ by rounding are the same place; the other coordinate, then the number decide.
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

/// Returns where a sorted list is divided: at the change of place nearest to the middle, if one lies within its inner
/// 40 %.
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
