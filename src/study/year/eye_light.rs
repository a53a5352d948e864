//! Luminance of an aperture by diffuse light as observers see it, step by step at the cost of a small matrix product:
//! luminances of the visible emergent cells by the light through each incident cell, and the outside seen by regular
//! transmission in fixed directions.
//!
//! It is available for described systems, and for data of panes, ideal diffusers, patches, single directions or tensor
//! trees. Behind boxes the scattered light is the mean over the aperture.

use crate::compute::basis::RingBasis;
use crate::compute::btdf::{AngularTransmittance, Btdf, Scattered};
use crate::compute::direction::{Dir, World};
use crate::compute::dot::dot;
use crate::compute::glare::Field;
use crate::compute::incidence::schemes::DiffuseScheme;
use crate::compute::room::direct::Sensor;
use crate::compute::room::grid::Grid;
use crate::compute::sky::{Counts, Outside, Prepared, Sun};
use crate::study::coefficients::{SPACING, Sent, incident_patches, seen_by_points};
use crate::study::scene::Scene;
use crate::study::scene_file::Interpolation;
use crate::study::session::Session;
use crate::study::session::far;
use crate::study::session::seen::inside;
use crate::study::session::sky_patches::SkyPatches;
use crate::study::session::sky_year::SkyYear;
use crate::study::system::SystemModel;
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// Luminance of one aperture by diffuse light, prepared for several observers and any sky.
pub(super) struct EyeLight {
    sky: Sky,
    /// Stored light of the outside in the steps of the year; `None` if it is not stored.
    year: Option<Arc<SkyYear>>,
    /// Luminances of the emergent cells that any observer sees, one row each, per light from outside. Columns:
    /// unobstructed incident cells, then ground, then skyline; behind boxes the luminances of the outside.
    rows: Vec<f64>,
    width: usize,
    eyes: Vec<OfEye>,
    clear: f64,
}

/// Representation of the outside: patches that are the same for the whole aperture, or luminances past boxes.
enum Sky {
    Patches(Arc<SkyPatches>),
    Behind(Arc<Prepared>),
}

/// Luminances of an aperture for one observer, by patch of its field of view.
struct OfEye {
    /// Indices of up to two rows of emergent cells for every patch, in the order of the field of view.
    row: Vec<[Option<usize>; 2]>,
    /// Transmittance, direction, and behind boxes the outside luminances seen in that direction with their shares, for
    /// every patch if the system has regular transmission; else empty.
    through: Vec<(f64, Dir<World>, Counts)>,
}

/// Whether the diffuse light of an aperture can be computed by [`EyeLight`].
pub(super) fn is_tabled(scene: &Scene, index: usize) -> bool {
    let one = &scene.apertures[index];
    let Some(btdf) = one.transmission() else { return false };
    let scheme = matches!(scene.diffuse_interpolation, DiffuseScheme::Auto | DiffuseScheme::Shift);
    let by_directions = scheme || scene.interpolation == Interpolation::Patch;
    let by_data = by_directions || !matches!(btdf.scattered, Some(Scattered::Directions(_)));
    one.lamps.is_none() && (by_data || described(scene, index).is_some())
}

/// Returns the optical model of an aperture's system if it is also used for light from sky and ground, since it is more
/// exact than the data; else `None`.
fn described(scene: &Scene, index: usize) -> Option<&SystemModel> {
    let model = scene.apertures[index].system.model.as_ref();
    model.filter(|model| scene.beams && model.answers_for_the_sky())
}

impl EyeLight {
    /// Creates the tables of one aperture. `eyes`: observers, and what each sees of all apertures; `prepared`:
    /// obstructions outside; `year`: number that identifies the year, and number of its steps.
    pub fn new(
        session: &Session,
        (scene, index): (&Scene, usize),
        btdf: &Btdf,
        eyes: (&[Sensor], &[Field]),
        prepared: Option<&Arc<Prepared>>,
        year: (u64, usize),
    ) -> Self {
        let own = described(scene, index).map(|model| session.sky_through(model));
        let (patches, spacing) = match &own {
            Some(own) => (RingBasis::clone(own.1.basis()), SPACING),
            None => incident_patches(btdf, scene.interpolation),
        };
        let sent = match &own {
            Some(own) => Some(Sent::described(&own.1)),
            None => Sent::of_data(session, btdf, scene.interpolation, &patches),
        };
        let regular = btdf.regular.as_ref().filter(|_| own.is_none());
        // Emergent cells that observers see, each once.
        let mut number = vec![None; sent.as_ref().map_or(0, Sent::count)];
        let mut seen = Vec::new();
        let eyes = eyes
            .0
            .iter()
            .zip(eyes.1)
            .map(|(eye, field)| {
                let own = &field.patches[field.of[index].clone()];
                let mut row_of = |cell: usize| {
                    *number[cell].get_or_insert_with(|| {
                        seen.push(cell);
                        seen.len() - 1
                    })
                };
                let row = |through| {
                    sent.as_ref().map_or([None; 2], |sent| sent.index(through).map(|cell| cell.map(&mut row_of)))
                };
                let row = own.iter().map(|patch| patch.through).map(row).collect();
                let through = regular.map_or_else(Vec::new, |tau: &AngularTransmittance| {
                    own.iter()
                        .map(|patch| {
                            let room = scene.apertures[index].aperture.surface.room_dir(patch.through);
                            let (tau, to) =
                                (tau.at(patch.through.theta().min(FRAC_PI_2)), scene.orientation.world_from_room(room));
                            let mut seen = Counts::new();
                            if let Some(prepared) = prepared {
                                let eye = scene.orientation.to_world(inside(scene, eye).position);
                                prepared.look(eye, to.vector(), |place, share| seen.push((place as u32, share as f32)));
                            }
                            (tau, to, seen)
                        })
                        .collect()
                });
                OfEye { row, through }
            })
            .collect();
        let of = |p: usize| {
            let all = sent.as_ref().map_or_else(Vec::new, |sent| sent.through(p));
            seen.iter().map(|&cell| all[cell]).collect()
        };
        let count = if seen.is_empty() { 0 } else { patches.len() };
        let columns: Vec<Vec<f64>> = (0..count).into_par_iter().map(of).collect();
        let clear = scene.apertures[index].clear;
        if let Some(prepared) = prepared {
            let width = prepared.count();
            let mut rows = vec![0.0; seen.len() * width];
            let grid = Grid::of(&scene.apertures[index].aperture);
            let by_point = seen_by_points(session, scene, index, prepared, (grid.places(), &patches));
            for (part, by_patch) in grid.parts().into_iter().zip(by_point.iter()).filter(|_| count > 0) {
                for (column, counts) in columns.iter().zip(by_patch) {
                    for (row, q) in rows.chunks_exact_mut(width).zip(column) {
                        counts.iter().for_each(|(place, counts)| row[*place as usize] += part * q * f64::from(*counts));
                    }
                }
            }
            let year = session.sky_year(year, prepared.number(), width);
            return Self { sky: Sky::Behind(Arc::clone(prepared)), year, rows, width, eyes, clear };
        }
        let sky = session.sky_patches(scene, index, patches, spacing);
        let width = sky.samples.cells().len() + 2;
        let mut rows = vec![0.0; seen.len() * width];
        for (at, row) in rows.chunks_exact_mut(width).enumerate() {
            for (to, &p) in row.iter_mut().zip(sky.samples.cells()) {
                *to = columns[p][at];
            }
            row[width - 2] = columns.iter().zip(&sky.ground).map(|(column, e)| column[at] * e).sum();
            row[width - 1] = columns.iter().zip(&sky.skyline).map(|(column, e)| column[at] * e).sum();
        }
        let year = session.sky_year(year, sky.fingerprint, sky.samples.cells().len());
        Self { sky: Sky::Patches(sky), year, rows, width, eyes, clear }
    }

    /// Returns the light from outside in one step of the year, in the order of the columns of the table: illuminances
    /// through incident cells \[lx\], then luminances of ground and skyline \[cd/m²\]; behind boxes luminances.
    pub fn light(&self, hour: usize, outside: &Outside, sun: Option<&Sun>) -> Vec<f64> {
        let find = || match &self.sky {
            Sky::Behind(prepared) => {
                prepared.luminances(&[(outside, sun)]).concat().into_iter().map(f64::from).collect()
            }
            Sky::Patches(sky) => {
                let mut light = Vec::with_capacity(self.width);
                sky.samples.illuminances(outside, &mut light);
                light
            }
        };
        if self.rows.is_empty() && matches!(self.sky, Sky::Patches(_)) {
            return Vec::new();
        }
        // Computed before the hour is locked: threads that do parts of it may need the same hour meanwhile.
        let mut light: Vec<f64> = match &self.year {
            Some(year) if year.holds(hour) => year.hour(hour, Vec::new).collect(),
            Some(year) => {
                let found = find();
                year.hour(hour, || found).collect()
            }
            None => find(),
        };
        if let Sky::Patches(_) = self.sky {
            light.extend([outside.ground_luminance(), far::luminance(outside)]);
        }
        light
    }

    /// Returns the luminances of the emergent cells that observers see \[cd/m²\]. `light`: result of [`Self::light`].
    pub fn cells(&self, light: &[f64]) -> Vec<f64> {
        self.rows.chunks_exact(self.width.max(1)).map(|row| self.clear * dot(row, light)).collect()
    }

    /// Adds the luminances of this aperture that an observer sees to those of its patches. `light`, `cells`: results of
    /// [`Self::light`] and [`Self::cells`]; `luminance`: luminances of the observer's patches of this aperture.
    /// \[cd/m²\]
    pub fn add(&self, eye: usize, light: &[f64], cells: &[f64], outside: &Outside, luminance: &mut [f64]) {
        let own = &self.eyes[eye];
        for (sum, row) in luminance.iter_mut().zip(&own.row) {
            *sum += row.iter().flatten().map(|&row| cells[row]).sum::<f64>();
        }
        for (sum, (tau, direction, seen)) in luminance.iter_mut().zip(&own.through) {
            let seen = match &self.sky {
                Sky::Patches(_) => outside.luminance(*direction),
                Sky::Behind(_) => seen.iter().map(|(place, share)| f64::from(*share) * light[*place as usize]).sum(),
            };
            *sum += self.clear * tau * seen;
        }
    }
}
