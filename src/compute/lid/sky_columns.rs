//! [`SkyThrough`] as a linear map: what light through single patches of the outside becomes, for skies of which there are
//! thousands.

use super::SkyThrough;
use super::sky_through::{BIN_ERROR, CELL_ERROR, POINTS, Scattered, Turned, band_of};
use super::structure::{angles, name_of};
use crate::compute::basis::{RingBasis, sub_directions};
use crate::compute::direction::{Dir, Facade};
use crate::compute::system::measure::ProfileLight;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// What an illuminance of 1 lx through one patch becomes.
#[derive(Debug, Clone, Default)]
pub struct PatchLight {
    /// Emergent cells of [`SkyThrough::basis`] and their luminance by straight and turned light. \[cd/m²\]
    pub cells: Vec<(usize, f64)>,
    /// Rows of [`SkyThrough::rows`], with the illuminance that each stands for. \[lx\]
    pub rows: Vec<(usize, f64)>,
}

/// What is scattered, by rows of incidence: q per illuminance.
#[derive(Clone, Copy)]
pub enum ScatteredRows<'a> {
    /// Nothing.
    None,
    /// By profile angle.
    Bands(&'a [ProfileLight]),
    /// On the cells of [`SkyThrough::basis`].
    Cells(&'a [Vec<f64>]),
}

/// Between which rows by profile angle light of a name lies, and how near it is to the second, 0 … 1. `rows`: how many.
pub fn between_rows(upright: bool, name: Dir<Facade>, rows: usize) -> (usize, f64) {
    let last = rows.max(2) - 2;
    let at = (angles(upright, name).1 + FRAC_PI_2) / PI * (rows.max(2) - 1) as f64;
    let row = (at.max(0.0) as usize).min(last);
    (row, (at - row as f64).clamp(0.0, 1.0))
}

impl SkyThrough {
    /// The patches of the outside, and the emergent cells.
    pub fn basis(&self) -> &Arc<RingBasis> {
        &self.cells
    }

    /// What is scattered.
    pub fn rows(&self) -> ScatteredRows<'_> {
        match &self.scattered {
            Scattered::None => ScatteredRows::None,
            Scattered::ByProfile { rows, .. } => ScatteredRows::Bands(rows),
            Scattered::ByCells { rows, .. } => ScatteredRows::Cells(rows),
        }
    }

    /// Patch by patch. Turned light takes the mean luminance of the patch that it comes from.
    pub fn by_patch(&self) -> Vec<PatchLight> {
        let weights = self.cells.projected_solid_angles();
        let mut patches = vec![PatchLight::default(); self.cells.len()];
        for (p, patch) in patches.iter_mut().enumerate().filter(|(p, _)| self.straight[*p] > 0.0) {
            patch.cells.push((p, self.straight[p] / weights[p]));
        }
        let mut turn = |cell: usize, name: Dir<Facade>, share: f64| {
            if let Some(p) = self.cells.index(name) {
                patches[p].cells.push((cell, share / weights[p]));
            }
        };
        match &self.turned {
            Turned::None => {}
            Turned::ByCell(sources) => {
                for (cell, list) in sources.iter().enumerate() {
                    list.iter().for_each(|source| turn(cell, source.name, source.share));
                }
            }
            Turned::ByProfile { upright, sources } => {
                for (index, cell) in self.cells.cells().enumerate() {
                    let (along, psi) = angles(*upright, cell.centre());
                    for &(psi, share) in &sources[band_of(psi)] {
                        turn(index, name_of(*upright, along, psi), share);
                    }
                }
            }
        }
        let row_of = |name: Dir<Facade>| match &self.scattered {
            Scattered::None => None,
            Scattered::ByProfile { upright, .. } => Some(band_of(angles(*upright, name).1)),
            Scattered::ByCells { incident, .. } => incident.index(name),
        };
        for (patch, cell) in patches.iter_mut().zip(self.cells.cells()) {
            for row in sub_directions(&cell, POINTS).filter_map(row_of) {
                let each = 1.0 / (POINTS * POINTS) as f64;
                match patch.rows.iter_mut().find(|(known, _)| *known == row) {
                    Some((_, sum)) => *sum += each,
                    None => patch.rows.push((row, each)),
                }
            }
        }
        patches
    }

    /// Error of all light by these columns, relative, under an even outside.
    pub fn relative_error(&self) -> f64 {
        let weights = self.cells.projected_solid_angles();
        let straight: f64 = self.straight.iter().zip(&weights).map(|(share, weight)| share * weight).sum();
        let whole: f64 = weights.iter().sum();
        let (scattered, off) = match &self.scattered {
            Scattered::None => (0.0, 0.0),
            Scattered::ByProfile { rows, .. } => {
                let mean = |of: &dyn Fn(&ProfileLight) -> f64| rows.iter().map(of).sum::<f64>() / rows.len() as f64;
                (mean(&ProfileLight::share), mean(&|row| row.error))
            }
            Scattered::ByCells { rows, error, .. } => {
                let share = |row: &Vec<f64>| row.iter().zip(&weights).map(|(q, weight)| q * weight).sum::<f64>();
                (rows.iter().map(share).sum::<f64>() / rows.len().max(1) as f64, *error)
            }
        };
        let binned = if matches!(self.turned, Turned::ByProfile { .. }) { BIN_ERROR } else { 0.0 };
        let through = straight / whole + scattered;
        CELL_ERROR + binned + if through > 0.0 { off / through } else { 0.0 }
    }
}
