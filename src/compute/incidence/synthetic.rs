//! Analytic systems and the data that a goniophotometer would measure of them, for tests.

use crate::compute::basis::RingBasis;
use crate::compute::btdf::Indicatrices;
use crate::compute::direction::Incident;
use crate::compute::incidence::grid::Grid;
use glam::DVec3;
use std::sync::Arc;

/// System as a function of the incident direction: lobes as (share of the incident flux, centre, standard deviation
/// \[rad\]), and a Lambertian share.
pub type System = fn(DVec3) -> (Vec<(f64, DVec3, f64)>, f64);

/// Returns the indicatrices of a system at Tregenza's 145 directions on emergent rings of `step` degrees.
pub fn measured(step: usize, system: System) -> Arc<Indicatrices> {
    measured_at(RingBasis::tregenza().cells().map(|cell| Incident(cell.centre())).collect(), step, system)
}

/// Returns the indicatrices of a system at given directions on emergent rings of `step` degrees.
pub fn measured_at(incident: Vec<Incident>, step: usize, system: System) -> Arc<Indicatrices> {
    let emergent = rings(step);
    let grid = Grid::new(&emergent);
    let mut values = Vec::new();
    for d in &incident {
        let (lobes, diffuse) = system(d.0.vector());
        let mut row = vec![diffuse / std::f64::consts::PI; emergent.len()];
        for (share, centre, sigma) in lobes {
            let shape = |v: DVec3| ((v.dot(centre) - 1.0) / (sigma * sigma)).exp();
            let lobe: Vec<f64> = (0..emergent.len()).map(|cell| grid.cell_mean(cell, 6, shape)).collect();
            let flux: f64 = lobe.iter().zip(&grid.projected).map(|(q, w)| q * w).sum();
            row.iter_mut().zip(lobe).for_each(|(sum, q)| *sum += q * share / flux);
        }
        values.extend(row);
    }
    Arc::new(Indicatrices::new(incident, emergent, values).expect("a row was made for every direction"))
}

/// Returns rings of equal height with cells about as wide as high.
fn rings(step: usize) -> RingBasis {
    use crate::compute::basis::{AzimuthMap, Ring};
    let list = (0..90 / step)
        .map(|i| {
            let middle = ((i * step) as f64 + 0.5 * step as f64).to_radians();
            let sectors = 4 * (90.0 * middle.sin() / step as f64).round().max(1.0) as usize;
            Ring {
                theta_min: ((i * step) as f64).to_radians(),
                theta_max: (((i + 1) * step) as f64).to_radians(),
                sectors,
                first_phi: 0.0,
            }
        })
        .collect();
    RingBasis::new("rings", list, AzimuthMap::FACADE).expect("rings of equal height rise")
}

/// Returns the transmittance of a pane for an incident direction.
fn pane(d: DVec3) -> f64 {
    0.9 * (1.0 - (1.0 - d.z).powi(5))
}

/// Clear pane, measured with an angular resolution of 3°.
pub fn clear(d: DVec3) -> (Vec<(f64, DVec3, f64)>, f64) {
    (vec![(pane(d), d, 3_f64.to_radians())], 0.0)
}

/// Laser-cut panel: an undeviated lobe and one mirrored in the vertical.
pub fn panel(d: DVec3) -> (Vec<(f64, DVec3, f64)>, f64) {
    let [x, y] = [d.x / 1.5, d.y / 1.5];
    let t = y.abs() / (1.0 - x * x - y * y).sqrt() / 0.7;
    let share = 1.0 - (1.0 - t % 2.0).abs();
    let (mirrored, sigma) = (d * DVec3::new(1.0, -1.0, 1.0), 3_f64.to_radians());
    let lobes = [((1.0 - share) * pane(d), d, sigma), (share * pane(d), mirrored, sigma)];
    (lobes.into_iter().filter(|lobe| lobe.0 > 0.0).collect(), 0.0)
}

/// Horizontal grey slats, as wide as their spacing.
pub fn slats(d: DVec3) -> (Vec<(f64, DVec3, f64)>, f64) {
    let direct = (1.0 - d.y.abs() / d.z.max(1e-12)).max(0.0);
    let lobes = if direct > 0.0 { vec![(direct, d, 3_f64.to_radians())] } else { vec![] };
    (lobes, 0.3 * (1.0 - direct))
}

/// Opal pane: Lambertian transmission.
pub fn opal(d: DVec3) -> (Vec<(f64, DVec3, f64)>, f64) {
    (vec![], 0.5 * pane(d))
}
