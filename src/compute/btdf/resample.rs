//! Matrices on other cells: means over the new incident and the new emergent cells, no flux lost.

use super::cell_matrix::CellMatrix;
use crate::compute::basis::{Resampling, RingBasis, same_cells};

/// A matrix on other cells: means over the new incident and the new emergent cells.
pub fn resample_matrix(matrix: &CellMatrix, incident: &RingBasis, emergent: &RingBasis) -> CellMatrix {
    if matrix.incident() == incident && matrix.emergent() == emergent {
        return matrix.clone();
    }
    if let (Some(i), Some(o)) = (same_cells(matrix.incident(), incident), same_cells(matrix.emergent(), emergent)) {
        let values = i.iter().flat_map(|&i| {
            let row = matrix.row(i);
            o.iter().map(move |&o| row[o])
        });
        let values = values.collect();
        return CellMatrix::new(incident.clone(), emergent.clone(), values).expect("as many cells as before");
    }
    let inward = Resampling::new(matrix.incident(), incident);
    let outward = Resampling::new(matrix.emergent(), emergent);
    let n_out = matrix.emergent().len();
    let mut values = Vec::with_capacity(incident.len() * emergent.len());
    let mut mean = vec![0.0; n_out];
    for i in 0..incident.len() {
        mean.fill(0.0);
        for &(cell, share) in inward.shares(i) {
            matrix.add_row(cell, share, &mut mean);
        }
        values.extend(outward.apply(&mean));
    }
    CellMatrix::new(incident.clone(), emergent.clone(), values).expect("one row an incident cell")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::AzimuthMap;

    #[test]
    fn the_same_cells_counted_otherwise_are_only_reordered() {
        let front = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let back = RingBasis::klems_full(AzimuthMap::KLEMS_BACK);
        let values: Vec<f64> = (0..145 * 145).map(|k| k as f64).collect();
        let matrix = CellMatrix::new(front.clone(), front.clone(), values).unwrap();
        let turned = resample_matrix(&matrix, &back, &back);
        let (a, b) = (back.cell(77), back.cell(23));
        let expected = matrix.row(front.index(a.centre()).unwrap())[front.index(b.centre()).unwrap()];
        assert_eq!(turned.row(77)[23], expected);
        assert_eq!(resample_matrix(&turned, &front, &front), matrix);
    }

    #[test]
    fn a_matrix_keeps_its_hemispherical_transmittance() {
        let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let values: Vec<f64> = (0..145 * 145).map(|k| ((k * 7919) % 101) as f64 / 400.0).collect();
        let matrix = CellMatrix::new(basis.clone(), basis, values).unwrap();
        let there = RingBasis::equal_area(9);
        let other = resample_matrix(&matrix, &there, &RingBasis::tregenza());
        assert!((other.tau_hemispherical() - matrix.tau_hemispherical()).abs() < 1e-10);
    }
}
