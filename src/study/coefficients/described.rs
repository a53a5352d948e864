//! Illuminance at the sensors behind a described system: sky and ground by incident patches, the sun by its actual
//! direction.

use super::transport::Column;
use super::views::{Opening, SensorRows, Views, Want};
use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Facade};
use crate::compute::dot::{add_scaled, wide};
use crate::compute::lid::sky_columns::{PatchLight, ScatteredRows, between_rows};
use crate::compute::lid::{BandLight, SkyThrough, direction, scattered_of, structure_angles, sun_cells};
use crate::compute::system::measure::{OpticalModel, ProfileLight, Structure};
use crate::study::error::StudyError;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Illuminance at the sensors through the incident patches of a described system.
pub(super) struct Described {
    /// Basis of the incident hemisphere.
    pub basis: Arc<RingBasis>,
    /// Relative error of all these illuminances.
    pub error: f64,
    /// Scattered light by profile angle, for a system whose scattering depends on that angle alone.
    pub by_angle: Option<Arc<ByAngle>>,
    /// Responses of the sensors to the light of the system.
    pub views: Arc<DescribedViews>,
    /// Emergent light by incident patch, per illuminance through the patch.
    patches: Vec<PatchLight>,
    /// Illuminances at the sensors by each row of scattered light.
    rows: Arc<Vec<SensorRows>>,
}

/// Illuminance at the sensors by scattered light per 1 lx on the aperture, for a list of profile angles of the incident
/// light.
pub(super) struct ByAngle {
    upright: bool,
    rows: Arc<Vec<SensorRows>>,
    /// Relative error of the illuminances for each profile angle.
    errors: Vec<f64>,
}

impl ByAngle {
    /// Adds the illuminance at the sensors by scattered light from the incident direction `direction`, interpolated
    /// linearly between two profile angles. `illuminance`: illuminance of the aperture \[lx\]; `light`, `errors`: sums
    /// to which values and errors are added \[lx\]; errors contain that of the data and that of the interpolation.
    pub fn add(&self, direction: Dir<Facade>, illuminance: f64, light: &mut [f64], errors: &mut [f64]) {
        let (row, near) = between_rows(self.upright, direction, self.rows.len());
        let (a, b) = (&self.rows[row], &self.rows[row + 1]);
        let before = &self.rows[row.saturating_sub(1)];
        let after = &self.rows[(row + 2).min(self.rows.len() - 1)];
        let relative = self.errors[row].max(self.errors[row + 1]);
        for (s, error) in errors.iter_mut().enumerate() {
            let bent = (before[s] + b[s] - 2.0 * a[s]).abs().max((a[s] + after[s] - 2.0 * b[s]).abs());
            let own = (1.0 - near) * a[s] + near * b[s];
            *error += illuminance * (relative * own.abs() + 0.5 * near * (1.0 - near) * bent);
        }
        for (sum, (a, b)) in light.iter_mut().zip(a.iter().zip(b)) {
            *sum += illuminance * ((1.0 - near) * a + near * b);
        }
    }
}

/// Illuminances at the sensors per 1 lx on the aperture for one incident direction, and their relative error.
type Node = Arc<(SensorRows, f64)>;

/// Scattered light of a described system, interpolated between incident directions on a grid of two angles. Nodes of
/// the grid are computed when they are first needed.
pub(super) struct Lattice {
    upright: bool,
    /// Steps of the grid: of the angle along the structure, and of the profile angle. \[°\]
    steps: [f64; 2],
    nodes: Mutex<HashMap<[i64; 2], Node>>,
}

/// Steps of the angle along the structure and of the profile angle, for a structure that is endless along one axis,
/// such as slats. The profile angle has the finer steps, because shading of one slat by the next changes abruptly with
/// it. \[°\]
const ACROSS: [f64; 2] = [7.5, 2.5];
/// Steps of both angles for a structure without a preferred axis. \[°\]
const EVEN: [f64; 2] = [5.0, 5.0];
/// Maximum angle of a node of the grid. \[°\]
const STEEPEST: f64 = 89.5;
/// Factor from the difference between cubic and linear interpolation to the stated error. It gives many times the error
/// of smooth light, and a third of the error at a single kink between four nodes, which never concerns all of the
/// light.
const UNEVEN: f64 = 1.0;

/// Interpolation along one angle: the nodes around a position, with their weights.
struct Around {
    first: i64,
    near: f64,
    cubic: [f64; 4],
}

impl Around {
    /// Creates the weights for the position `at`, counted in steps of the grid; nodes end at ±`last`.
    fn new(at: f64, last: f64) -> Self {
        let first = at.floor();
        let t = at - first;
        let inside = first - 1.0 >= -last && first + 2.0 <= last;
        let cubic = if inside {
            // Lagrange's polynomial through nodes at −1, 0, 1, 2.
            [
                -t * (t - 1.0) * (t - 2.0) / 6.0,
                (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
                -(t + 1.0) * t * (t - 2.0) / 2.0,
                (t + 1.0) * t * (t - 1.0) / 6.0,
            ]
        } else {
            [0.0, 1.0 - t, t, 0.0]
        };
        Self { first: first as i64 - 1, near: t, cubic }
    }

    /// Returns the weights of linear interpolation between the two nodes in the middle.
    fn linear(&self) -> [f64; 4] {
        [0.0, 1.0 - self.near, self.near, 0.0]
    }
}

impl Lattice {
    /// Creates an empty grid with the steps that suit the structure of a system.
    pub fn of(model: &dyn OpticalModel) -> Self {
        let (upright, steps) = match model.structure() {
            Structure::Along { upright } => (upright, ACROSS),
            Structure::Even | Structure::Any => (false, EVEN),
        };
        Self { upright, steps, nodes: Mutex::default() }
    }

    /// Returns the node at the grid position `at`, computed or stored.
    fn node(&self, model: &dyn OpticalModel, views: &Views, at: [i64; 2]) -> Node {
        // What is kept is whole even if another thread has failed while it held the lock.
        let nodes = || self.nodes.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = nodes().get(&at) {
            return Arc::clone(known);
        }
        let angles = [0, 1].map(|k| (at[k] as f64 * self.steps[k]).clamp(-STEEPEST, STEEPEST).to_radians());
        let (light, error) = scattered_of(model, direction(self.upright, angles));
        let mut row = vec![0.0; views.width()];
        views.add_all(&light, &mut row);
        let found = Arc::new((row, error));
        nodes().insert(at, Arc::clone(&found));
        found
    }

    /// Adds the illuminance at the sensors by scattered light from the incident direction `direction`, interpolated
    /// between nodes. `illuminance`: illuminance of the aperture \[lx\]; `light`, `errors`: sums to which values and
    /// errors are added. \[lx\]
    pub fn add(
        &self,
        model: &dyn OpticalModel,
        views: &Views,
        direction: Dir<Facade>,
        illuminance: f64,
        light: &mut [f64],
        errors: &mut [f64],
    ) {
        let angles = structure_angles(self.upright, direction);
        let around = [0, 1].map(|k| Around::new(angles[k].to_degrees() / self.steps[k], 90.0 / self.steps[k]));
        let linear = [0, 1].map(|k: usize| around[k].linear());
        let mut own = vec![0.0; light.len()];
        let mut straight = vec![0.0; errors.len()];
        let mut uncertainty = vec![0.0; errors.len()];
        for (i, j) in (0..16).map(|k| (k / 4, k % 4)) {
            let cubic = around[0].cubic[i] * around[1].cubic[j];
            let linear = linear[0][i] * linear[1][j];
            if cubic == 0.0 && linear == 0.0 {
                continue;
            }
            let node = self.node(model, views, [around[0].first + i as i64, around[1].first + j as i64]);
            add_scaled(&mut own, &node.0, cubic);
            add_scaled(&mut straight, &node.0, linear);
            let error = linear * node.1;
            wide(|| uncertainty.iter_mut().zip(&node.0).for_each(|(sum, e)| *sum += error * e.abs()));
        }
        for (s, error) in errors.iter_mut().enumerate() {
            *error += illuminance * (uncertainty[s] + UNEVEN * (own[s] - straight[s]).abs());
        }
        // A polynomial may run below zero amid four nodes above zero: this holds for the light, not for the values
        // that give its error.
        for (k, (sum, e)) in light.iter_mut().zip(own).enumerate() {
            *sum += illuminance * if k < errors.len() { e.max(0.0) } else { e };
        }
    }
}

/// Illuminance at the sensors per luminance of a described system, by cells and by bands of the profile angle.
pub(super) struct DescribedViews {
    /// Responses of the sensors to luminances on the cells of [`sun_cells`].
    pub cells: Views,
    /// Responses of the sensors to luminances in bands of the profile angle, for a system that scatters by that angle:
    /// whether the profile angle is in the horizontal plane (vertical structures), and the number of bands.
    pub bands: Option<((bool, usize), Views)>,
}

impl DescribedViews {
    /// Computes the responses of the sensors. `bands`: for a system that scatters by profile angle, whether the angle
    /// is in the horizontal plane, and the number of bands.
    pub fn new(opening: &Opening<'_>, bands: Option<(bool, usize)>) -> Result<Self, StudyError> {
        let cells = Views::new(opening, Arc::clone(sun_cells()), Want::All)?;
        let of = |kind| Views::of_bands(opening, kind).map(|views| (kind, views));
        Ok(Self { cells, bands: bands.map(of).transpose()? })
    }

    /// Adds the illuminance at the sensors by light that leaves the aperture in bands of the profile angle, times
    /// `factor`.
    pub fn add_bands(&self, light: &BandLight, factor: f64, out: &mut [f64]) {
        if let Some((_, views)) = &self.bands {
            for (band, q) in light.light.q.iter().enumerate().filter(|(_, q)| **q != 0.0) {
                views.add(band, factor * light.illuminance * q, out);
            }
        }
    }
}

impl Described {
    /// Prepares the illuminances at the sensors through each incident patch. `through`: emergent light of the system by
    /// patch; `views`: responses of the sensors to it.
    pub fn new(through: &SkyThrough, views: Arc<DescribedViews>) -> Self {
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
        let rows = Arc::new(rows);
        let by_angle = match through.rows() {
            ScatteredRows::Bands(own) if own.len() > 1 => Some(Arc::new(ByAngle {
                upright: own[0].upright,
                errors: own.iter().map(relative_error).collect(),
                rows: Arc::clone(&rows),
            })),
            _ => None,
        };
        let (basis, error) = (Arc::clone(through.basis()), through.relative_error());
        Self { basis, error, by_angle, views, patches: through.by_patch(), rows }
    }

    /// Computes the illuminances at the sensors per illuminance of the aperture through the incident patch with the
    /// index `patch` in the basis.
    pub fn through_patch(&self, patch: usize) -> Column {
        let PatchLight { cells, rows } = &self.patches[patch];
        let mut light = vec![0.0; self.views.cells.width()];
        cells.iter().for_each(|&(cell, luminance)| self.views.cells.add(cell, luminance, &mut light));
        for (row, share) in rows {
            if let Some(row) = self.rows.get(*row) {
                light.iter_mut().zip(row).for_each(|(sum, e)| *sum += share * e);
            }
        }
        Column { light, difference: Vec::new() }
    }
}

/// Returns the error of scattered light relative to its flux.
pub(super) fn relative_error(light: &ProfileLight) -> f64 {
    let share = light.share();
    if share > 0.0 { light.error / share } else { 0.0 }
}
