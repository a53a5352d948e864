//! Resampling of patch-averaged data to other cells, with the flux conserved.

use super::cell_matrix::CellMatrix;
use crate::compute::basis::{Resampling, RingBasis, same_cells};

/// Returns patch-averaged data resampled to the cells of other bases: means of q over the new incident and emergent
/// cells.
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
    // The emergent cells first: these are many, and several of the new incident cells share a row.
    let rows: Vec<Vec<f64>> = (0..matrix.incident().len()).map(|i| outward.apply(&matrix.row(i))).collect();
    let mean = |i: usize, o: usize| inward.shares(i).iter().map(|&(cell, share)| share * rows[cell][o]).sum();
    let values = (0..incident.len()).flat_map(|i| (0..emergent.len()).map(move |o| mean(i, o))).collect();
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
