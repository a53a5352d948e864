//! Finding the cell of very many directions.

use crate::compute::angle::wrap_two_pi;
use crate::compute::basis::{AzimuthMap, RingBasis};
use std::f64::consts::PI;

/// Slots of the table over sin²θ.
const SLOTS: usize = 4096;

/// The cells of a basis by lateral direction cosines.
pub(super) struct CellFinder {
    rings: Vec<RingOfCells>,
    /// First ring (by rising θ) that may hold a slot of sin²θ.
    slots: Vec<u32>,
    azimuth: AzimuthMap,
}

struct RingOfCells {
    /// Limits of sin²θ.
    from: f64,
    to: f64,
    sectors: usize,
    /// Own azimuth where the first sector begins.
    begin: f64,
    first_cell: usize,
}

impl CellFinder {
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
                sectors: ring.sectors,
                begin: ring.first_phi - PI / ring.sectors as f64,
                first_cell: basis.first_cell(index),
            })
            .collect();
        rings.sort_by(|a, b| a.from.total_cmp(&b.from));
        let slots =
            (0..SLOTS).map(|slot| rings.partition_point(|ring| ring.to <= slot as f64 / SLOTS as f64) as u32).collect();
        Self { rings, slots, azimuth: basis.azimuth() }
    }

    /// The cell that holds (x, y); `None` in gaps between rings.
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
        if ring.sectors == 1 {
            return Some(ring.first_cell);
        }
        let turned = wrap_two_pi(self.azimuth.own_phi(y.atan2(x)) - ring.begin) * ring.sectors as f64 / (2.0 * PI);
        Some(ring.first_cell + (turned as usize).min(ring.sectors - 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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
