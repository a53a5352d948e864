//! What physics demands of a dataset: energy and reciprocity.

use super::{Btdf, Scattered};

/// Mean relative difference between a front function and the back function turned round, weighted by the projected
/// solid angles of both cells: Σ w|q_f − q_b| / Σ w(q_f + q_b)/2. `None` unless both are given on cells of the same
/// directions.
pub fn reciprocity_error(front: &Btdf, back: &Btdf) -> Option<f64> {
    let (Some(Scattered::Cells(front)), Some(Scattered::Cells(back))) = (&front.scattered, &back.scattered) else {
        return None;
    };
    let (n_in, n_out) = (front.incident().len(), front.emergent().len());
    if back.incident().len() != n_out || back.emergent().len() != n_in {
        return None;
    }
    let w_in = front.incident().projected_solid_angles();
    let w_out = front.emergent().projected_solid_angles();
    // Back cells by the through-names of the front ones.
    let back_in: Vec<usize> =
        front.emergent().cells().map(|cell| back.incident().index(cell.centre())).collect::<Option<_>>()?;
    let back_out: Vec<usize> =
        front.incident().cells().map(|cell| back.emergent().index(cell.centre())).collect::<Option<_>>()?;
    let (mut difference, mut sum) = (0.0, 0.0);
    for i in 0..n_in {
        for o in 0..n_out {
            let (f, b) = (front.row(i)[o], back.row(back_in[o])[back_out[i]]);
            difference += w_in[i] * w_out[o] * (f - b).abs();
            sum += w_in[i] * w_out[o] * 0.5 * (f + b);
        }
    }
    Some(if sum > 0.0 { difference / sum } else { 0.0 })
}
