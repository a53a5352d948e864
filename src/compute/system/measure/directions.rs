//! What light of single incident directions becomes, on emergent cells: what a goniophotometer finds at the directions
//! of its list, not means over incident cells.

use super::cells::CellFinder;
use super::fan::{middle, pieces};
use super::{OneSide, Side, Specimen};
use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Facade};
use crate::compute::estimate::{Cancelled, Progress};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Width of the parts of a fan that are laid into a cell each. \[rad\]
const PIECE: f64 = 0.002;

/// Rows for light of the given names from a side: q of every emergent cell, beams laid into the cells that they fall in.
/// What is neither transmitted nor thrown back counts as absorbed.
///
/// # Errors
/// [`Cancelled`] when `progress` says so.
pub fn at_directions(
    specimen: &dyn Specimen,
    side: Side,
    names: &[Dir<Facade>],
    emergent: &RingBasis,
    progress: &dyn Progress,
) -> Result<OneSide, Cancelled> {
    let finder = CellFinder::new(emergent);
    let weight = emergent.projected_solid_angles();
    let done = AtomicUsize::new(0);
    let rows: Vec<OneSide> = names
        .par_iter()
        .map(|&name| {
            if progress.cancelled() {
                return Err(Cancelled);
            }
            let row = row(specimen, side, name, emergent, &finder, &weight);
            progress.advance("goniophotometer", done.fetch_add(1, Ordering::Relaxed) + 1, names.len());
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

/// The row of one direction.
fn row(
    specimen: &dyn Specimen,
    side: Side,
    name: Dir<Facade>,
    emergent: &RingBasis,
    finder: &CellFinder,
    weight: &[f64],
) -> OneSide {
    let scattered = specimen.scattered(name, side, emergent);
    let filled = |q: Vec<f64>| if q.is_empty() { vec![0.0; weight.len()] } else { q };
    let mut transmitted = filled(scattered.transmitted);
    let mut reflected = filled(scattered.reflected);
    for beam in specimen.beams(name, side) {
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
        let names: Vec<_> = RingBasis::tregenza().cells().map(|cell| cell.centre()).collect();
        let specimen = SharpBeams(CutPanel { panel, cut_loss: 0.0 });
        let made = at_directions(&specimen, Side::Back, &names, &cells, &Silent).unwrap();
        assert!(made.transmitted.len() == 145 * 145 && made.absorbed.len() == 145);
        let weight = cells.projected_solid_angles();
        for (i, &name) in names.iter().enumerate() {
            let exact = panel.shares(name, 0.0);
            let v = name.vector();
            let turned = Dir::from_unit(glam::DVec3::new(v.x, -v.y, v.z));
            let [straight, deflected] = [name, turned].map(|name| cells.index(name).unwrap());
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
