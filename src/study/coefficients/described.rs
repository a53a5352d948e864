//! A system by its description: sky by columns of single patches, the sun by its very direction.

use super::views::{SensorRows, Views, Want};
use crate::compute::basis::RingBasis;
use crate::compute::estimate::Progress;
use crate::compute::lid::sky_columns::{PatchLight, ScatteredRows};
use crate::compute::lid::{BandLight, SkyThrough, sun_cells};
use crate::compute::system::measure::ProfileLight;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use crate::study::session::Session;
use crate::study::session::responses::Responses;
use rayon::prelude::*;
use std::sync::Arc;

/// The light of a described system's patches at the sensors.
pub(super) struct Described {
    /// Patches of the outside.
    pub basis: Arc<RingBasis>,
    /// By patch.
    pub columns: Vec<SensorRows>,
    /// Error of all of it, relative.
    pub error: f64,
}

/// What the sensors see of a described system's light.
pub(super) struct DescribedViews {
    /// On [`sun_cells`].
    pub cells: Views,
    /// In the bands that it scatters to; upright or not, and how many.
    pub bands: Option<((bool, usize), Views)>,
}

impl DescribedViews {
    /// `bands`: a system that scatters by profile angle says how.
    pub fn new(
        session: &Session,
        scene: &Scene,
        index: usize,
        bands: Option<(bool, usize)>,
        room: Option<&Responses>,
        progress: &dyn Progress,
    ) -> Result<Self, StudyError> {
        let cells = Views::new(session, scene, index, Arc::clone(sun_cells()), room, Want::All, progress)?;
        let of = |kind| Views::of_bands(session, scene, index, kind, room, progress).map(|views| (kind, views));
        Ok(Self { cells, bands: bands.map(of).transpose()? })
    }

    /// Adds light in bands.
    pub fn add_bands(&self, light: &BandLight, factor: f64, out: &mut [f64]) {
        if let Some((_, views)) = &self.bands {
            for (band, q) in light.light.q.iter().enumerate().filter(|(_, q)| **q != 0.0) {
                views.add(band, factor * light.illuminance * q, out);
            }
        }
    }
}

impl Described {
    /// Patch by patch.
    pub fn new(through: &SkyThrough, views: &DescribedViews) -> Self {
        let rows: Vec<SensorRows> = match through.rows() {
            ScatteredRows::None => Vec::new(),
            ScatteredRows::Bands(rows) => {
                let light = |row: &ProfileLight| {
                    let mut light = vec![0.0; views.cells.width()];
                    views.add_bands(&BandLight { light: row.clone(), illuminance: 1.0 }, 1.0, &mut light);
                    light
                };
                rows.par_iter().map(light).collect()
            }
            ScatteredRows::Cells(rows) => {
                let light = |row: &Vec<f64>| {
                    let mut light = vec![0.0; views.cells.width()];
                    views.cells.add_all(row, &mut light);
                    light
                };
                rows.par_iter().map(light).collect()
            }
        };
        let column = |patch: PatchLight| {
            let mut light = vec![0.0; views.cells.width()];
            patch.cells.iter().for_each(|&(cell, luminance)| views.cells.add(cell, luminance, &mut light));
            for (row, share) in patch.rows {
                if let Some(row) = rows.get(row) {
                    light.iter_mut().zip(row).for_each(|(sum, e)| *sum += share * e);
                }
            }
            light
        };
        let columns = through.by_patch().into_par_iter().map(column).collect();
        Self { basis: Arc::clone(through.basis()), columns, error: through.relative_error() }
    }
}
