//! V: what every sensor receives per luminance of every emergent cell of an aperture, directly and through the room.

use crate::compute::basis::RingBasis;
use crate::compute::dot::add_scaled;
use crate::compute::estimate::Progress;
use crate::compute::room::first_bounce::from_even;
use crate::compute::room::patch_weights::{MOST_CELLS, merged_cells, merging};
use crate::compute::system::measure::ProfileLight;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use crate::study::session::Session;
use crate::study::session::responses::Responses;
use std::sync::Arc;

/// Three rows of one number a sensor, one behind the other: all light, the interreflected part of it, and what that part
/// is in doubt by.
pub(super) type SensorRows = Vec<f64>;

/// Values of every cell.
pub(super) struct Views {
    width: usize,
    /// Cell by cell, each as a [`SensorRows`].
    rows: Vec<f32>,
    /// Mean relative gap of flux that was closed.
    pub gap: f64,
}

/// What of the light is wanted.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Want {
    /// All of it, as a [`SensorRows`].
    All,
    /// Its first row alone.
    Sum,
    /// As a [`SensorRows`], without what comes straight.
    Reflected,
}

impl Views {
    /// Of an aperture of the scene; `room` where there is interreflection.
    pub fn new(
        session: &Session,
        scene: &Scene,
        index: usize,
        basis: Arc<RingBasis>,
        room: Option<&Responses>,
        want: Want,
        progress: &dyn Progress,
    ) -> Result<Self, StudyError> {
        let sensors = scene.sensors.len();
        let width = if want == Want::Sum { sensors } else { 3 * sensors };
        let mut rows = vec![0.0_f32; basis.len() * width];
        if want != Want::Reflected {
            let receptions = session.receptions(scene, index, Some(&basis), progress)?;
            for (s, reception) in receptions.iter().enumerate() {
                for (row, weight) in rows.chunks_exact_mut(width).zip(&reception.cells) {
                    row[s] = *weight as f32;
                }
            }
        }
        let mut gap = 0.0;
        if let Some(room) = room {
            let merged = if basis.len() > MOST_CELLS { merged_cells() } else { &basis };
            gap = room.weights(session, index, merged).gap();
            let by_sensor = room.of_cells(session, index, merged, width > sensors);
            let mut add = |cell: usize, from: usize, share: f64| {
                let row = &mut rows[cell * width..(cell + 1) * width];
                for (s, by_cell) in by_sensor.iter().enumerate() {
                    let light = by_cell[from];
                    row[s] += (share * light.value) as f32;
                    if width > sensors {
                        row[sensors + s] += (share * light.value) as f32;
                        row[2 * sensors + s] += (share * light.doubt()) as f32;
                    }
                }
            };
            if Arc::ptr_eq(merged, &basis) {
                (0..basis.len()).for_each(|cell| add(cell, cell, 1.0));
            } else {
                let resampling = merging(&basis);
                for to in 0..merged.len() {
                    for &(cell, share) in resampling.shares(to) {
                        add(cell, to, share);
                    }
                }
            }
        }
        Ok(Self { width, rows, gap })
    }

    /// Of the bands of a profile angle instead of cells: upright or not, and how many.
    pub fn of_bands(
        session: &Session,
        scene: &Scene,
        index: usize,
        (upright, bands): (bool, usize),
        room: Option<&Responses>,
        progress: &dyn Progress,
    ) -> Result<Self, StudyError> {
        let sensors = scene.sensors.len();
        let width = 3 * sensors;
        let mut rows = vec![0.0_f32; bands * width];
        for (s, seen) in session.kept_bands(scene, index, (upright, bands), progress)?.iter().enumerate() {
            seen.each().for_each(|(band, weight)| rows[band * width + s] = weight as f32);
        }
        let mut gap = 0.0;
        if let Some(room) = room {
            let merged = merged_cells();
            gap = room.weights(session, index, merged).gap();
            let by_sensor = room.of_cells(session, index, merged, true);
            for (cell, shares) in ProfileLight::shares_on(upright, bands, merged).iter().enumerate() {
                for &(band, share) in shares {
                    let row = &mut rows[band * width..(band + 1) * width];
                    for (s, by_cell) in by_sensor.iter().enumerate() {
                        let light = by_cell[cell];
                        row[s] += (share * light.value) as f32;
                        row[sensors + s] += (share * light.value) as f32;
                        row[2 * sensors + s] += (share * light.doubt()) as f32;
                    }
                }
            }
        }
        Ok(Self { width, rows, gap })
    }

    /// Numbers a cell.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Adds a cell of some luminance.
    #[inline]
    pub fn add(&self, cell: usize, luminance: f64, out: &mut [f64]) {
        add_scaled(out, &self.rows[cell * self.width..(cell + 1) * self.width], luminance);
    }

    /// Adds an indicatrix.
    pub fn add_all(&self, luminance: &[f64], out: &mut [f64]) {
        for (cell, &l) in luminance.iter().enumerate().filter(|(_, l)| **l != 0.0) {
            self.add(cell, l, out);
        }
    }
}

/// The light of an aperture of even luminance 1.
pub(super) fn even(
    session: &Session,
    scene: &Scene,
    index: usize,
    room: Option<&Responses>,
    progress: &dyn Progress,
) -> Result<SensorRows, StudyError> {
    let sensors = scene.sensors.len();
    let mut light = vec![0.0; 3 * sensors];
    let receptions = session.receptions(scene, index, None, progress)?;
    light.iter_mut().zip(receptions.iter()).for_each(|(to, reception)| *to = reception.uniform);
    if let Some(room) = room {
        let mut first = from_even(&room.radiosity, index, &scene.apertures[index].aperture);
        first.iter_mut().for_each(|e| *e *= std::f64::consts::PI);
        for (s, reflected) in room.of(&first).into_iter().enumerate() {
            light[s] += reflected.value;
            light[sensors + s] = reflected.value;
            light[2 * sensors + s] = reflected.doubt();
        }
    }
    Ok(light)
}
