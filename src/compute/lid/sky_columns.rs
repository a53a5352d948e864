//! Response of a described system to diffuse light ([`SkyThrough`]) as emergent light per illuminance from single
//! patches of the outside, for thousands of skies.

use super::SkyThrough;
use super::sky_through::{BIN_ERROR, CELL_ERROR, POINTS, Scattered, Turned, band_of};
use super::structure::{angles, direction_of};
use super::sun_through::sun_cells;
use crate::compute::basis::{Cell, RingBasis, sub_directions};
use crate::compute::direction::{Dir, Facade};
use crate::compute::system::measure::ProfileLight;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::{Arc, OnceLock};

/// Light that leaves the room side if one patch of the outside alone illuminates the aperture with 1 lx.
#[derive(Debug, Clone, Default)]
pub struct PatchLight {
    /// Indices of emergent cells of [`SkyThrough::basis`] with their luminance by undeviated and redirected light.
    /// \[cd/m²\]
    pub cells: Vec<(usize, f64)>,
    /// Indices of rows of [`SkyThrough::rows`] with the illuminance by which each is multiplied. \[lx\]
    pub rows: Vec<(usize, f64)>,
}

/// Rows of incidence for every patch, with the shares of the patch's light that they represent.
type Shares = Vec<Vec<(usize, f64)>>;

/// Scattered light of a described system by row, a row per band of the incident profile angle or per incident cell:
/// luminance coefficients q \[1/sr\].
#[derive(Clone, Copy)]
pub enum ScatteredRows<'a> {
    /// No scattered light.
    None,
    /// One row per band of the incident profile angle, by emergent profile angle.
    Bands(&'a [ProfileLight]),
    /// One row per incident cell, with q on the emergent cells of [`SkyThrough::basis`].
    Cells(&'a [Vec<f64>]),
}

/// Returns the index of the first of the two rows between whose profile angles an incident direction lies, and the
/// weight of the second, 0 … 1. `rows`: number of rows over −90° … 90°; `upright`: profile angle to the right instead
/// of upwards.
pub fn between_rows(upright: bool, direction: Dir<Facade>, rows: usize) -> (usize, f64) {
    let last = rows.max(2) - 2;
    let at = (angles(upright, direction).1 + FRAC_PI_2) / PI * (rows.max(2) - 1) as f64;
    let row = (at.max(0.0) as usize).min(last);
    (row, (at - row as f64).clamp(0.0, 1.0))
}

impl SkyThrough {
    /// Returns the cells that serve both as patches of the outside and as emergent cells.
    pub fn basis(&self) -> &Arc<RingBasis> {
        &self.cells
    }

    /// Returns the scattered light as one row per band of the incident profile angle or per incident cell.
    pub fn rows(&self) -> ScatteredRows<'_> {
        match &self.scattered {
            Scattered::None => ScatteredRows::None,
            Scattered::ByProfile { rows, .. } => ScatteredRows::Bands(rows),
            Scattered::ByCells { rows, .. } => ScatteredRows::Cells(rows),
        }
    }

    /// Returns the shares of each patch's light by row. `kind`: rows by profile angle upwards (0) or to the right (1),
    /// or by incident cell (2), which are the same for all systems. On [`sun_cells`] each kind is computed once.
    fn rows_of_patches(&self, kind: usize, row_of: impl Fn(Dir<Facade>) -> Option<usize>) -> Arc<Shares> {
        static KEPT: [OnceLock<Arc<Shares>>; 3] = [const { OnceLock::new() }; 3];
        let find = || {
            let each = 1.0 / (POINTS * POINTS) as f64;
            let of = |cell: Cell| {
                let mut shares: Vec<(usize, f64)> = Vec::new();
                for row in sub_directions(&cell, POINTS).filter_map(&row_of) {
                    match shares.iter_mut().find(|(known, _)| *known == row) {
                        Some((_, sum)) => *sum += each,
                        None => shares.push((row, each)),
                    }
                }
                shares
            };
            Arc::new(self.cells.cells().map(of).collect())
        };
        if Arc::ptr_eq(&self.cells, sun_cells()) { Arc::clone(KEPT[kind].get_or_init(find)) } else { find() }
    }

    /// Returns the light that leaves the room side per illuminance from each patch of the outside. Redirected light has
    /// the mean luminance of the patch that it comes from.
    pub fn by_patch(&self) -> Vec<PatchLight> {
        let weights = self.cells.projected_solid_angles();
        let mut patches = vec![PatchLight::default(); self.cells.len()];
        for (p, patch) in patches.iter_mut().enumerate().filter(|(p, _)| self.straight[*p] > 0.0) {
            patch.cells.push((p, self.straight[p] / weights[p]));
        }
        let mut turn = |cell: usize, direction: Dir<Facade>, share: f64| {
            if let Some(p) = self.cells.index(direction) {
                patches[p].cells.push((cell, share / weights[p]));
            }
        };
        match &self.turned {
            Turned::None => {}
            Turned::ByCell(sources) => {
                for (cell, list) in sources.iter().enumerate() {
                    list.iter().for_each(|source| turn(cell, source.direction, source.share));
                }
            }
            Turned::ByProfile { upright, sources } => {
                for (index, cell) in self.cells.cells().enumerate() {
                    let (along, psi) = angles(*upright, cell.centre());
                    for &(psi, share) in &sources[band_of(psi)] {
                        turn(index, direction_of(*upright, along, psi), share);
                    }
                }
            }
        }
        let rows = match &self.scattered {
            Scattered::None => return patches,
            Scattered::ByProfile { upright, .. } => {
                self.rows_of_patches(usize::from(*upright), |direction| Some(band_of(angles(*upright, direction).1)))
            }
            Scattered::ByCells { incident, .. } => self.rows_of_patches(2, |direction| incident.index(direction)),
        };
        patches.iter_mut().zip(rows.iter()).for_each(|(patch, rows)| patch.rows.clone_from(rows));
        patches
    }

    /// Returns the relative error of the exitance computed from the light per patch, under a uniform outside.
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
