//! Systems with a closed form at every incident direction, for tests: their simulated measured data, and the exact
//! indicatrix between the measured directions.

use super::grid::Grid;
use super::judge::Judge;
use super::model::Model;
use super::superpose::sub_patches;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::Indicatrices;
use crate::compute::direction::Incident;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// Lobes as (share of the incident flux, direction, standard deviation \[rad\]), and the diffuse share of the incident
/// flux.
type Parts = (Vec<(f64, DVec3, f64)>, f64);

/// Analytic system and the emergent cells of its data.
pub struct Sample {
    /// Emergent cells.
    pub grid: Grid,
    /// Lobes and diffuse share as a function of the incident direction.
    pub parts: fn(DVec3) -> Parts,
}

fn pane(z: f64) -> f64 {
    0.9 * (1.0 - (1.0 - z).powi(5))
}

/// Returns emergent cells of 4°.
fn cells() -> Grid {
    Grid::new(&sub_patches(4_f64.to_radians()))
}

/// Creates a clear pane whose lobe has a standard deviation of 3°.
pub fn clear() -> Sample {
    Sample { grid: cells(), parts: |d| (vec![(pane(d.z), d, 3_f64.to_radians())], 0.0) }
}

/// Creates a laser-cut panel: an undeviated and a mirrored lobe with shares that change with the profile angle.
pub fn panel() -> Sample {
    let parts = |d: DVec3| {
        let y = d.y / 1.5;
        let t = y.abs() / (1.0 - (d.x / 1.5).powi(2) - y * y).sqrt() / 0.7;
        let share = 1.0 - (1.0 - t.rem_euclid(2.0)).abs();
        let (f, sigma) = (pane(d.z), 3_f64.to_radians());
        (vec![((1.0 - share) * f, d, sigma), (share * f, DVec3::new(d.x, -d.y, d.z), sigma)], 0.0)
    };
    Sample { grid: cells(), parts }
}

/// Creates slats tilted by 20° with a cut-off, and light diffusely reflected by them.
pub fn slats() -> Sample {
    let parts = |d: DVec3| {
        let psi = d.y.atan2(d.z);
        let direct = (1.0 - 80.0 / 72.0 * (20_f64.to_radians() + psi).sin().abs() / psi.cos()).max(0.0);
        (vec![(direct, d, 3_f64.to_radians())], 0.35 * (1.0 - direct))
    };
    Sample { grid: cells(), parts }
}

/// Creates an ideal diffuser.
pub fn diffuser() -> Sample {
    Sample { grid: cells(), parts: |d| (vec![], 0.5 / 0.9 * pane(d.z)) }
}

/// Creates a system that transmits light from above only: rows of directions without any light beside rows with it.
pub fn half_blind() -> Sample {
    let parts = |d: DVec3| if d.y > 0.1 { (vec![(0.8, d, 3_f64.to_radians())], 0.0) } else { (vec![], 0.0) };
    Sample { grid: cells(), parts }
}

impl Sample {
    /// Returns q of the indicatrix for an incident direction on the cells, with the exact flux of every lobe. \[1/sr\]
    pub fn row(&self, d: DVec3) -> Vec<f64> {
        let (lobes, diffuse) = (self.parts)(d);
        let mut row = vec![diffuse / PI; self.grid.centre.len()];
        for (share, centre, sigma) in lobes {
            let mut cells = Vec::new();
            self.grid.within(centre, 5.0 * sigma, |cell| {
                let q = self.grid.cell_mean(cell, 4, |e| ((e.dot(centre) - 1.0) / (sigma * sigma)).exp());
                cells.push((cell, q));
            });
            let flux: f64 = cells.iter().map(|&(cell, q)| q * self.grid.projected[cell]).sum();
            cells.iter().for_each(|&(cell, q)| row[cell] += q * share / flux);
        }
        row
    }

    /// Returns the share of flux that the indicatrix `q` for the incident direction `d` has in wrong directions.
    pub fn misplaced(&self, d: DVec3, q: &[f64]) -> f64 {
        Judge::new(&self.grid).misplaced(q, &self.row(d)).unwrap()
    }
}

/// Returns the data that a goniophotometer would measure of a sample at Tregenza's 145 incident directions.
pub fn data(sample: &Sample) -> Indicatrices {
    let incident: Vec<Incident> = RingBasis::tregenza().cells().map(|cell| Incident(cell.centre())).collect();
    let values = incident.iter().flat_map(|d| sample.row(d.0.vector())).collect();
    Indicatrices::new(incident, sample.grid.basis().clone(), values).unwrap()
}

/// Returns the interpolation model of a sample's simulated data.
pub fn model(sample: &Sample) -> Model {
    Model::new(Arc::new(data(sample)))
}
