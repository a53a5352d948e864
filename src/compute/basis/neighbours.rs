//! Neighbouring cells of a ring basis.

use super::rings::RingBasis;
use std::f64::consts::PI;

/// Angular distance below which two borders of cells count as the same. \[rad\] Above the rounding of azimuths (2⁻⁵² ·
/// 2π ≈ 1e-15), below the narrowest sector of a basis (2π/7200 ≈ 9e-4).
const SLACK: f64 = 1e-6;

/// Neighbours of every cell of a basis: the indices of the cells that share a border with it.
#[derive(Debug, Clone)]
pub struct Neighbours(Vec<Vec<usize>>);

impl Neighbours {
    /// Finds the neighbours of all cells of a basis.
    pub fn new(basis: &RingBasis) -> Self {
        let cells: Vec<_> = basis.cells().collect();
        let of_ring = |ring: usize| basis.first_cell(ring)..basis.first_cell(ring) + basis.rings()[ring].sectors;
        let last = basis.rings().len() - 1;
        let mut list = Vec::with_capacity(cells.len());
        for ring in 0..=last {
            for a in of_ring(ring) {
                let touches = |b: &usize| {
                    let (p, q) = (&cells[a], &cells[*b]);
                    let separation = (p.phi - q.phi).rem_euclid(2.0 * PI);
                    let separation = separation.min(2.0 * PI - separation);
                    // In the next ring a corner in common is not enough.
                    let slack = if of_ring(ring).contains(b) { SLACK } else { -SLACK };
                    a != *b && separation < 0.5 * (p.width + q.width) + slack
                };
                list.push((ring.saturating_sub(1)..=(ring + 1).min(last)).flat_map(of_ring).filter(touches).collect());
            }
        }
        Self(list)
    }

    /// Returns the indices of the neighbours of the cell with index `cell`.
    pub fn of(&self, cell: usize) -> &[usize] {
        &self.0[cell]
    }

    /// Returns the indices of the neighbours of the cells `cells`, without these cells themselves and without `but`;
    /// each once, rising.
    pub fn about(&self, cells: &[usize], but: &[usize]) -> Vec<usize> {
        let mut near: Vec<usize> = cells.iter().flat_map(|&cell| self.of(cell).iter().copied()).collect();
        near.retain(|cell| !cells.contains(cell) && !but.contains(cell));
        near.sort_unstable();
        near.dedup();
        near
    }

    /// Returns the median of `values` (one per cell of the basis) over the neighbours of the cells `cells`, without the
    /// cells `but`; 0 if there are none.
    pub fn level(&self, values: &[f64], cells: &[usize], but: &[usize]) -> f64 {
        let mut near: Vec<f64> = self.about(cells, but).into_iter().map(|cell| values[cell]).collect();
        near.sort_unstable_by(f64::total_cmp);
        match near.len() {
            0 => 0.0,
            n => 0.5 * (near[(n - 1) / 2] + near[n / 2]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::AzimuthMap;

    #[test]
    fn who_touches_is_touched() {
        for basis in [RingBasis::klems_full(AzimuthMap::KLEMS_FRONT), RingBasis::tregenza(), RingBasis::equal_area(9)] {
            let near = Neighbours::new(&basis);
            for a in 0..basis.len() {
                assert!(near.of(a).len() >= 3 && near.of(a).iter().all(|&b| b != a && near.of(b).contains(&a)), "{a}");
            }
        }
        // The cap and its ring.
        let klems = Neighbours::new(&RingBasis::klems_full(AzimuthMap::KLEMS_FRONT));
        assert_eq!(klems.of(0), [1, 2, 3, 4, 5, 6, 7, 8]);
        let values: Vec<f64> = (0..145).map(f64::from).collect();
        assert_eq!(klems.level(&values, &[0], &[8]), 4.0);
    }
}
