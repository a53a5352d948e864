//! Fast search for the cells of a basis that contain given directions.

use crate::compute::basis::RingBasis;
use std::f64::consts::PI;

/// Number of slots of the table over sin²θ. Chosen: cost only, no effect on results.
const SLOTS: usize = 4096;

/// Table by which the cell of a basis is found from the direction cosines x and y.
pub(super) struct CellFinder {
    rings: Vec<RingOfCells>,
    /// Index of the first ring (by rising θ) that may contain directions of each slot of sin²θ.
    slots: Vec<u32>,
}

struct RingOfCells {
    /// Lower limit of sin²θ of the ring; `to` is the upper one.
    from: f64,
    to: f64,
    /// Starts of the ring's sectors as values of [`diamond`], rising, each with the index of its cell.
    sectors: Vec<(f64, usize)>,
}

impl CellFinder {
    /// Creates the table of a basis.
    pub fn new(basis: &RingBasis) -> Self {
        let sin2 = |theta: f64| theta.sin().powi(2);
        let mut rings: Vec<RingOfCells> = basis
            .rings()
            .iter()
            .enumerate()
            .map(|(index, ring)| RingOfCells {
                from: sin2(ring.theta_min),
                // The last ring takes everything up to the horizon, rounding included.
                to: if ring.theta_max >= PI / 2.0 - 1e-9 { f64::INFINITY } else { sin2(ring.theta_max) },
                sectors: sectors(basis, basis.first_cell(index), ring.sectors),
            })
            .collect();
        rings.sort_by(|a, b| a.from.total_cmp(&b.from));
        let slots =
            (0..SLOTS).map(|slot| rings.partition_point(|ring| ring.to <= slot as f64 / SLOTS as f64) as u32).collect();
        Self { rings, slots }
    }

    /// Returns the index of the cell that contains the direction with cosines (x, y); `None` in gaps between rings.
    pub fn find(&self, x: f64, y: f64) -> Option<usize> {
        let sin2 = (x * x + y * y).min(1.0);
        let slot = ((sin2 * SLOTS as f64) as usize).min(SLOTS - 1);
        let mut ring = self.rings.get(self.slots[slot] as usize)?;
        let mut index = self.slots[slot] as usize;
        while sin2 >= ring.to {
            index += 1;
            ring = self.rings.get(index)?;
        }
        if sin2 < ring.from {
            return None;
        }
        let count = ring.sectors.len();
        let at = diamond(x, y);
        // Nearly proportional to the azimuth: a guess, then a step or two.
        let mut k = ((at - ring.sectors[0].0) * (0.25 * count as f64)).max(0.0) as usize;
        k = k.min(count - 1);
        while k > 0 && ring.sectors[k].0 > at {
            k -= 1;
        }
        while k + 1 < count && ring.sectors[k + 1].0 <= at {
            k += 1;
        }
        if at < ring.sectors[k].0 {
            // Before the first border: the last sector extends across 0.
            k = count - 1;
        }
        Some(ring.sectors[k].1)
    }
}

/// Returns a monotonic measure of the azimuth of (x, y), from 0 to 4 for 0 to 2π, computed without an arc tangent.
fn diamond(x: f64, y: f64) -> f64 {
    let sum = x.abs() + y.abs();
    if sum == 0.0 {
        return 0.0;
    }
    match (x >= 0.0, y >= 0.0) {
        (true, true) => y / sum,
        (false, true) => 1.0 - x / sum,
        (false, false) => 2.0 - y / sum,
        (true, false) => 3.0 + x / sum,
    }
}

/// Returns the starts of the sectors of a ring as values of [`diamond`], each with the index of its cell, in the order
/// of rising azimuth in the façade frame.
fn sectors(basis: &RingBasis, first_cell: usize, count: usize) -> Vec<(f64, usize)> {
    let mut list: Vec<(f64, usize)> = (first_cell..first_cell + count)
        .map(|index| {
            let cell = basis.cell(index);
            let (sin, cos) = (cell.phi - 0.5 * cell.width).sin_cos();
            (diamond(cos, sin), index)
        })
        .collect();
    list.sort_by(|a, b| a.0.total_cmp(&b.0));
    list
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::AzimuthMap;
    use crate::compute::direction::Dir;

    #[test]
    fn finds_what_the_basis_finds() {
        for basis in [
            RingBasis::klems_full(AzimuthMap::KLEMS_FRONT),
            RingBasis::klems_quarter(AzimuthMap::KLEMS_BACK),
            RingBasis::tregenza(),
            RingBasis::equal_area(9),
        ] {
            let finder = CellFinder::new(&basis);
            for k in 0..4000 {
                let d = Dir::from_theta_phi(0.000_39 * f64::from(k) + 1e-5, 2.399_963 * f64::from(k));
                let v = d.vector();
                assert_eq!(finder.find(v.x, v.y), basis.index(d), "{} {k}", basis.name());
            }
        }
    }
}
