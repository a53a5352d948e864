//! Scattering of single incident directions on emergent cells, as a goniophotometer measures it for a list of
//! directions, without averages over incident cells.

use super::cells::CellFinder;
use super::fan::{middle, pieces};
use super::{Measured, OneSide, OpticalModel, Setting, Side};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{Band, Btdf, Component, Indicatrices, Scattered};
use crate::compute::direction::{Dir, Facade, Incident};
use crate::compute::estimate::{Cancelled, Progress};
use rayon::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Angular width of the parts into which a fan of light is divided; each part counts in one cell. \[rad\] Chosen: cost;
/// 1/90 of a Klems cell of 10°, of which half a part at most falls on the wrong side of a border.
const PIECE: f64 = 0.002;

/// Computes the mean q of every emergent cell for light from `side` of each of the directions `directions`, which are
/// directions of undeviated light (see [`super`]). Beams count in the cell that they fall into; light that is neither
/// transmitted nor reflected counts as absorbed.
///
/// # Errors
/// Returns [`Cancelled`] if `progress` is cancelled.
pub fn at_directions(
    model: &dyn OpticalModel,
    side: Side,
    directions: &[Dir<Facade>],
    emergent: &RingBasis,
    progress: &dyn Progress,
) -> Result<OneSide, Cancelled> {
    let finder = CellFinder::new(emergent);
    let weight = emergent.projected_solid_angles();
    let done = AtomicUsize::new(0);
    let rows: Vec<OneSide> = directions
        .par_iter()
        .map(|&direction| {
            if progress.cancelled() {
                return Err(Cancelled);
            }
            let row = row(model, side, direction, emergent, &finder, &weight);
            progress.advance("goniophotometer", done.fetch_add(1, Ordering::Relaxed) + 1, directions.len());
            Ok(row)
        })
        .collect::<Result<_, Cancelled>>()?;
    let mut made = OneSide::default();
    for row in rows {
        made.transmitted.extend(row.transmitted);
        made.reflected.extend(row.reflected);
        made.absorbed.extend(row.absorbed);
        made.error.extend(row.error);
    }
    Ok(made)
}

/// Computes transmission and reflection of both sides for the directions at the centres of the incident cells of
/// `setting`, without averages over these cells.
///
/// # Errors
/// Returns [`Cancelled`] if `progress` is cancelled.
pub fn measured_at_directions(
    model: &dyn OpticalModel,
    setting: &Setting<'_>,
    progress: &dyn Progress,
) -> Result<Measured, Cancelled> {
    let directions: Vec<_> = setting.incident.cells().map(|cell| cell.centre()).collect();
    let side = |side| at_directions(model, side, &directions, setting.emergent, progress);
    let (front, back) = (side(Side::Front)?, side(Side::Back)?);
    Ok(Measured { incident: setting.incident.clone(), emergent: setting.emergent.clone(), front, back })
}

impl Measured {
    /// Returns the data as a band of BSDF data at single incident directions, the centres of the incident cells.
    pub fn band_at_directions(&self) -> Band {
        let incident: Vec<Incident> = self.incident.cells().map(|cell| Incident(cell.centre())).collect();
        let mut band = Band::default();
        let mut set = |component, values: &[f64]| {
            let made = Indicatrices::new(incident.clone(), self.emergent.clone(), values.to_vec());
            let scattered = Scattered::Directions(Arc::new(made.expect("values are counted by these cells")));
            band.set(component, Btdf { regular: None, scattered: Some(scattered) });
        };
        set(Component::TransmissionFront, &self.front.transmitted);
        set(Component::TransmissionBack, &self.back.transmitted);
        set(Component::ReflectionFront, &self.front.reflected);
        set(Component::ReflectionBack, &self.back.reflected);
        band
    }
}

/// Computes the scattering of light of one direction into the emergent cells.
fn row(
    model: &dyn OpticalModel,
    side: Side,
    direction: Dir<Facade>,
    emergent: &RingBasis,
    finder: &CellFinder,
    weight: &[f64],
) -> OneSide {
    let scattered = model.scattered(direction, side, emergent);
    let filled = |q: Vec<f64>| if q.is_empty() { vec![0.0; weight.len()] } else { q };
    let mut transmitted = filled(scattered.transmitted);
    let mut reflected = filled(scattered.reflected);
    for beam in model.beams(direction, side) {
        let to = if beam.transmitted { &mut transmitted } else { &mut reflected };
        for piece in pieces(&beam, PIECE) {
            let at = middle(&piece).vector();
            if let Some(cell) = finder.find(at.x, at.y) {
                to[cell] += piece.share / weight[cell];
            }
        }
    }
    let share = |q: &[f64]| q.iter().zip(weight).map(|(q, w)| q * w).sum::<f64>();
    let absorbed = (1.0 - share(&transmitted) - share(&reflected)).max(0.0);
    OneSide { transmitted, reflected, absorbed: vec![absorbed], error: vec![scattered.error] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::estimate::Silent;
    use crate::compute::system::laser_cut::{CutPanel, LaserCutPanel};
    use crate::compute::system::measure::beams::SharpBeams;
    use crate::compute::system::measure::front_basis;
    use crate::compute::system::panes::glazing::Pane;

    #[test]
    fn a_panel_at_single_directions_fills_two_cells() {
        let sheet = Pane { index: 1.5, thickness: 0.01, absorption: 0.0 };
        let panel = LaserCutPanel { sheet, spacing: 0.007 };
        let cells = front_basis();
        let directions: Vec<_> = RingBasis::tregenza().cells().map(|cell| cell.centre()).collect();
        let specimen = SharpBeams(CutPanel { panel, cut_loss: 0.0 });
        let made = at_directions(&specimen, Side::Back, &directions, &cells, &Silent).unwrap();
        assert!(made.transmitted.len() == 145 * 145 && made.absorbed.len() == 145);
        let weight = cells.projected_solid_angles();
        for (i, &direction) in directions.iter().enumerate() {
            let exact = panel.shares(direction, 0.0);
            let v = direction.vector();
            let turned = Dir::from_unit(glam::DVec3::new(v.x, -v.y, v.z));
            let [straight, deflected] = [direction, turned].map(|direction| cells.index(direction).unwrap());
            let row = &made.transmitted[i * 145..(i + 1) * 145];
            if straight == deflected {
                continue;
            }
            assert!((row[straight] * weight[straight] - exact.straight).abs() < 2e-6, "{i}");
            assert!((row[deflected] * weight[deflected] - exact.deflected).abs() < 2e-6, "{i}");
            assert!(made.absorbed[i] < 1e-5);
        }
    }
}
