//! Physical checks of a dataset: conservation of energy and reciprocity.

use super::{Btdf, Scattered};
use crate::compute::direction::{Dir, Incident};

/// Returns the deviation from reciprocity between the transmission for light from outside and that for light from
/// inside with exchanged directions: the mean relative difference Σ w|q_f − q_b| / Σ w(q_f + q_b)/2, weighted by the
/// projected solid angles of both cells. `None` unless both are given on cells of the same directions, or as tensor
/// trees of the same rank.
pub fn reciprocity_error(front: &Btdf, back: &Btdf) -> Option<f64> {
    if let (Some(Scattered::Tree(front)), Some(Scattered::Tree(back))) = (&front.scattered, &back.scattered) {
        return front.relative_difference(&back.reversed());
    }
    let (Some(Scattered::Cells(front)), Some(Scattered::Cells(back))) = (&front.scattered, &back.scattered) else {
        return None;
    };
    let (n_in, n_out) = (front.incident().len(), front.emergent().len());
    if back.incident().len() != n_out || back.emergent().len() != n_in {
        return None;
    }
    let w_in = front.incident().projected_solid_angles();
    let w_out = front.emergent().projected_solid_angles();
    // Cells of the back side that contain the centres of the front's emergent and incident cells.
    let back_in: Vec<usize> =
        front.emergent().cells().map(|cell| back.incident().index(cell.centre())).collect::<Option<_>>()?;
    let back_out: Vec<usize> =
        front.incident().cells().map(|cell| back.emergent().index(cell.centre())).collect::<Option<_>>()?;
    let (mut difference, mut sum) = (0.0, 0.0);
    let back_values = back.values();
    for i in 0..n_in {
        let row = front.row(i);
        for o in 0..n_out {
            let (f, b) = (row[o], back_values[back_in[o] * n_in + back_out[i]]);
            difference += w_in[i] * w_out[o] * (f - b).abs();
            sum += w_in[i] * w_out[o] * 0.5 * (f + b);
        }
    }
    Some(if sum > 0.0 { difference / sum } else { 0.0 })
}

/// Returns the largest directional-hemispherical transmittance of any incident cell, regular transmission included; a
/// value above 1 violates the conservation of energy.
pub fn tau_max(btdf: &Btdf) -> f64 {
    let regular = |theta: f64| btdf.regular.as_ref().map_or(0.0, |tau| tau.at(theta));
    match &btdf.scattered {
        Some(Scattered::Cells(matrix)) => matrix
            .incident()
            .cells()
            .zip(matrix.tau_by_cell())
            .map(|(cell, tau)| tau + regular(cell.theta()))
            .fold(0.0, f64::max),
        Some(Scattered::Directions(data)) => data
            .incident()
            .iter()
            .zip(data.tau_by_direction())
            .map(|(direction, tau)| tau + regular(direction.0.theta()))
            .fold(0.0, f64::max),
        Some(Scattered::Tree(tree)) if btdf.regular.is_none() => tree.tau_max(),
        _ => (0..=180)
            .map(|k| {
                let theta = std::f64::consts::FRAC_PI_2 * f64::from(k) / 180.0;
                btdf.tau(Incident(Dir::from_theta_phi(theta, 0.0)))
            })
            .fold(0.0, f64::max),
    }
}
