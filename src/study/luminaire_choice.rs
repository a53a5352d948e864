//! Choice of the number of tiles of a luminaire set and of the step of its tables: illuminances by the luminaires,
//! computed in the manner of a host program, are compared with those by the aperture itself, in the same room, over
//! square fields of half a metre.

use super::error::StudyError;
use super::luminaire_tiles::{Place, tables};
use super::scene::Scene;
use super::session::Session;
use crate::compute::direction::Surface;
use crate::compute::estimate::{Cancelled, Progress};
use crate::compute::lid::c_gamma::{Aim, Averaged, CGammaTable, Step};
use crate::compute::lid::tiling::{NEAREST, Tile, Tiling, WORK_PLANE};
use crate::compute::lid::{Intensities, Lamp, Lid};
use crate::compute::quadrature::Tolerance;
use crate::compute::room::direct::{Sensor, beams_through};
use crate::compute::room::near_field::{Integrator, NearField};
use glam::DVec3;
use rayon::prelude::*;
use std::sync::Arc;

/// Maximum root mean square of the fields' relative errors for which `auto` accepts a set.
pub const TARGET: f64 = 0.01;
/// Maximum relative error of the sum over all fields for which `auto` accepts a set.
const TARGET_SUM: f64 = 0.005;
/// Maximum side of a tile if the aperture emits beams: a host that divides luminous areas finely blurs the edges of lit
/// areas by half a tile. \[m\]
const LONGEST_OF_BEAMS: f64 = 0.2;
/// Side of a square field over which illuminances are averaged. \[m\]
const FIELD: f64 = 0.5;
/// Distance between the points of a field. \[m\]
const PITCH: f64 = 0.1;
/// Number of points along a side of a field.
const POINTS: usize = 5;
/// Share of the mean illuminance of all fields that is the minimum denominator of a field's relative error.
const DARK: f64 = 0.05;
/// Maximum sides of tiles that are tried, one after the other. \[m\]
const LONGEST: [f64; 9] = [f64::INFINITY, 1.5, 1.0, 0.7, 0.5, 0.35, 0.25, 0.175, 0.125];
/// Maximum number of tiles with `auto`.
const MOST_TILES: usize = 256;

/// Accuracy of the illuminances in a room that is lit by luminaire files instead of the aperture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// Relative error of the sum of the illuminances of all fields.
    pub sum: f64,
    /// Root mean square of the fields' relative errors, on the surface of the room where it is largest.
    pub rms: f64,
    /// Relative error of the field where it is largest, with its sign.
    pub worst: f64,
    /// Number of fields that were compared.
    pub fields: usize,
}

impl Reached {
    /// Whether the errors are within the limits for which `auto` accepts a set.
    pub fn holds(&self) -> bool {
        self.rms <= TARGET && self.sum.abs() <= TARGET_SUM
    }

    /// Returns a sentence on the accuracy for the header of a luminaire file, in English.
    pub fn sentence(&self) -> String {
        format!(
            "Direct light of all files together on {} fields of {FIELD} m x {FIELD} m of the scene's room, on the work plane \
             and above it, at {NEAREST} m and more, in a host that cuts luminous areas into parts of a quarter of their \
             distance: sum {:+.2} %, rms on the worst surface {:.2} %, worst field {:+.1} %.",
            self.fields,
            100.0 * self.sum,
            100.0 * self.rms,
            100.0 * self.worst
        )
    }
}

/// Square field on a surface of the room, with the points at which illuminances are averaged.
struct Field {
    surface: usize,
    sensors: Vec<Sensor>,
    /// Mean illuminance by the aperture itself. \[lx\]
    wanted: f64,
}

/// Reference for choosing tiles: mean illuminances by the aperture itself on fields of its room.
pub struct Probe {
    fields: Vec<Field>,
}

impl Probe {
    /// Computes the illuminances by one aperture, counted from 0. `without_beam`: whether its undeviated beam is left
    /// out.
    ///
    /// # Errors
    /// Returns an error if cancelled.
    pub fn new(
        session: &Session,
        scene: &Scene,
        aperture: usize,
        without_beam: bool,
        progress: &dyn Progress,
    ) -> Result<Self, StudyError> {
        let facing = scene.facing(aperture);
        let mut emission = session.emission(scene, aperture);
        if without_beam {
            emission.beams.retain(|beam| !beam.straight);
        }
        let beams = std::mem::take(&mut emission.beams);
        let own = &scene.apertures[aperture].aperture;
        let method = Integrator::new(NearField::SolidAngle, own, &emission, &facing, Tolerance::relative(1e-3));
        let grids = grids(scene.room.size).into_iter().filter(|grid| own.distance(grid.centre) >= NEAREST);
        let fields = grids
            .collect::<Vec<_>>()
            .into_par_iter()
            .map(|grid| {
                if progress.cancelled() {
                    return Err(Cancelled);
                }
                let sensors = grid.sensors();
                let light = |sensor: &Sensor| {
                    method.illuminance(sensor).all.value + beams_through(sensor, own, &beams, &facing).beam
                };
                let wanted = sensors.iter().map(light).sum::<f64>() / sensors.len() as f64;
                Ok(Field { surface: grid.surface, sensors, wanted })
            })
            .collect::<Result<Vec<_>, Cancelled>>()?;
        Ok(Self { fields })
    }

    /// Returns the accuracy of the illuminances by luminaires. `tables`: tiles of the aperture with their intensity
    /// tables.
    pub(super) fn reached(&self, surface: Surface, tables: &[(Tile, Arc<CGammaTable>)]) -> Reached {
        let lamps = lamps(surface, tables);
        let light = |sensor: &Sensor| -> f64 {
            lamps.iter().map(|lamp| lamp.illuminance(sensor.position, sensor.normal)).sum()
        };
        let got: Vec<f64> = self
            .fields
            .par_iter()
            .map(|field| field.sensors.iter().map(light).sum::<f64>() / field.sensors.len() as f64)
            .collect();
        let count = self.fields.len().max(1) as f64;
        let mean = self.fields.iter().map(|field| field.wanted).sum::<f64>() / count;
        if mean <= 0.0 {
            return Reached { sum: 0.0, rms: 0.0, worst: 0.0, fields: self.fields.len() };
        }
        let error = |(field, got): (&Field, &f64)| (got - field.wanted) / field.wanted.max(DARK * mean);
        let errors: Vec<f64> = self.fields.iter().zip(&got).map(error).collect();
        Reached {
            sum: got.iter().sum::<f64>() / (count * mean) - 1.0,
            rms: (0..SURFACES).map(|surface| rms(&self.fields, &errors, surface)).fold(0.0, f64::max),
            worst: errors
                .into_iter()
                .fold(0.0, |worst: f64, error| if error.abs() > worst.abs() { error } else { worst }),
            fields: self.fields.len(),
        }
    }
}

/// Returns the root mean square of the relative errors of the fields on one surface of the room.
fn rms(fields: &[Field], errors: &[f64], surface: usize) -> f64 {
    let own =
        || fields.iter().zip(errors).filter(|(field, _)| field.surface == surface).map(|(_, error)| error * error);
    (own().sum::<f64>() / own().count().max(1) as f64).sqrt()
}

/// Geometry of a field.
struct FieldGrid {
    surface: usize,
    centre: DVec3,
    axes: [DVec3; 2],
    normal: DVec3,
}

impl FieldGrid {
    /// Returns the points of the field, with the normal of its surface.
    fn sensors(&self) -> Vec<Sensor> {
        let half = (POINTS / 2) as i32;
        let at = |i: i32, j: i32| {
            let [u, v] = [i, j].map(|k| PITCH * f64::from(k));
            Sensor { position: self.centre + u * self.axes[0] + v * self.axes[1], normal: self.normal }
        };
        (-half..=half).flat_map(|i| (-half..=half).map(move |j| (i, j))).map(|(i, j)| at(i, j)).collect()
    }
}

/// Number of surfaces on which fields lie: work plane, three walls and the ceiling.
const SURFACES: usize = 5;

/// Returns the fields on the work plane, on the walls above it and on the ceiling.
fn grids(room: DVec3) -> Vec<FieldGrid> {
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
    // A little inside: points on a wall see an aperture in it edge on.
    const OFF: f64 = 1e-6;
    let plane = if room.z > WORK_PLANE { WORK_PLANE } else { OFF };
    let surfaces: [_; SURFACES] = [
        (DVec3::new(0.0, 0.0, plane), [x, y], z),
        (DVec3::new(0.0, room.y - OFF, plane), [x, z], -y),
        (DVec3::new(0.0, 0.0, room.z - OFF), [x, y], -z),
        (DVec3::new(OFF, 0.0, plane), [y, z], x),
        (DVec3::new(room.x - OFF, 0.0, plane), [y, z], -x),
    ];
    let mut list = Vec::new();
    for (surface, (corner, axes, normal)) in surfaces.into_iter().enumerate() {
        let centres = |axis: DVec3| -> Vec<f64> {
            let length = (room - corner).dot(axis);
            let count = (length / FIELD) as usize;
            let margin = 0.5 * (length - count as f64 * FIELD);
            (0..count).map(|k| margin + (k as f64 + 0.5) * FIELD).collect()
        };
        for u in centres(axes[0]) {
            for v in centres(axes[1]) {
                list.push(FieldGrid { surface, centre: corner + u * axes[0] + v * axes[1], axes, normal });
            }
        }
    }
    list
}

/// Returns the luminaires for the tables, with which a host program computes illuminances.
fn lamps(surface: Surface, tables: &[(Tile, Arc<CGammaTable>)]) -> Vec<Lamp> {
    let mut last: Option<(&Arc<CGammaTable>, Arc<Intensities>)> = None;
    let mut list = Vec::with_capacity(tables.len());
    for (tile, table) in tables {
        let own = match &last {
            Some((known, own)) if Arc::ptr_eq(known, table) => Arc::clone(own),
            _ => Arc::new(table.intensities()),
        };
        last = Some((table, Arc::clone(&own)));
        list.push(Lamp { tile: *tile, surface, aim: table.aim, flux: table.flux.value, table: own });
    }
    list
}

/// Tiles and intensity tables that were chosen for an aperture, with their accuracy.
pub(super) struct Choice {
    pub tiling: Tiling,
    pub step: Step,
    pub reached: Reached,
    pub tables: Vec<(Tile, Arc<CGammaTable>)>,
    /// Whether each tile has its own table for narrowly scattered light.
    narrow: bool,
}

/// Chooses the smallest number of tiles, and the widest step of the tables with them, that meet the limits of accuracy;
/// else the best that were found. `step`: step that the user gave.
///
/// # Errors
/// Returns an error if cancelled.
pub(super) fn choose(
    lid: &Lid,
    aim: Aim,
    step: Option<Step>,
    place: Place,
    probe: &Probe,
    progress: &dyn Progress,
) -> Result<Choice, Cancelled> {
    let fine = step.unwrap_or(Step::FINE);
    let averaged = Averaged::new(lid, aim, fine, progress)?;
    let with = |averaged: &Averaged, step: Step, tiling: Tiling, narrow: bool| {
        let tables = tables(averaged, tiling, place, narrow);
        Choice { tiling, step, reached: probe.reached(place.surface, &tables), tables, narrow }
    };
    let mut best: Option<Choice> = None;
    let mut before = None;
    let tiling_of = |longest: f64| Tiling::no_longer_than(place.size, longest);
    let few: Vec<f64> = LONGEST.into_iter().filter(|longest| tiling_of(*longest).count() <= MOST_TILES).collect();
    let finest = few.last().copied().unwrap_or(f64::INFINITY);
    let most = if lid.beam_flux() > 0.0 { finest.max(LONGEST_OF_BEAMS) } else { f64::INFINITY };
    // Each tiling without and with separate tables of narrow light per tile; the first that meets the limits ends the
    // search.
    let work: usize = few.iter().map(|longest| 2 * tiling_of(*longest).count()).sum();
    let mut done = 0;
    'tilings: for longest in few.into_iter().filter(|longest| *longest <= most) {
        let tiling = tiling_of(longest);
        if before == Some(tiling) {
            continue;
        }
        before = Some(tiling);
        // The cheaper one first.
        for narrow in [false, true] {
            progress.advance("tiles", done, work);
            if progress.cancelled() {
                return Err(Cancelled);
            }
            done += tiling.count();
            let choice = with(&averaged, fine, tiling, narrow);
            let holds = choice.reached.holds();
            if holds || best.as_ref().is_none_or(|best| choice.reached.rms < best.reached.rms) {
                best = Some(choice);
            }
            if holds {
                break 'tilings;
            }
        }
    }
    let best = best.unwrap_or_else(|| with(&averaged, fine, Tiling::WHOLE, false));
    if step.is_none() && best.reached.holds() {
        let normal = with(&Averaged::new(lid, aim, Step::NORMAL, progress)?, Step::NORMAL, best.tiling, best.narrow);
        if normal.reached.holds() {
            return Ok(normal);
        }
    }
    Ok(best)
}
