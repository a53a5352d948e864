//! What every sensor's interreflected light hangs on: weights of the first illuminance of every patch, from the room's
//! balance read backwards. One set serves every sky, sun and system of a room.

use super::interreflected::{mirrors, room_key, spans};
use super::{Session, check};
use crate::compute::basis::RingBasis;
use crate::compute::estimate::Progress;
use crate::compute::room::aperture::Aperture;
use crate::compute::room::back_reflection::{BackReflection, gathered, settled_weights};
use crate::compute::room::first_bounce::PatchWeights;
use crate::compute::room::radiosity::{Radiosity, dot};
use crate::study::cache::Key;
use crate::study::error::StudyError;
use crate::study::scene::Scene;
use rayon::prelude::*;
use std::sync::Arc;

/// Weights of one sensor, by fine patch.
pub(in crate::study) struct Response {
    /// Of all first illuminance. \[lx per lx\]
    pub value: Vec<f64>,
    /// Of that part of the first illuminance whose first reflection is counted elsewhere: what is to be taken away.
    pub apart: Vec<f64>,
    /// Difference of the two densities, wall by wall.
    pub walls: Vec<Wall>,
    /// Of what comes back from apertures that reflect by direction; empty without such.
    pub thrown_back: Vec<f64>,
}

/// Fine less coarse on one wall.
pub(in crate::study) struct Wall {
    /// Of all first illuminance.
    pub value: Vec<f64>,
    /// Of the part counted elsewhere.
    pub apart: Vec<f64>,
}

/// Weights of all sensors.
pub(in crate::study) struct Responses {
    /// The balance.
    pub radiosity: Arc<Radiosity>,
    /// In the order of the scene.
    pub sensors: Vec<Response>,
    key: Key,
    geometry: Vec<Aperture>,
}

impl Responses {
    /// What the patches receive from an aperture by the cells of a basis.
    pub fn weights(&self, session: &Session, index: usize, basis: &Arc<RingBasis>) -> Arc<PatchWeights> {
        session.patch_weights(&self.key, &self.radiosity.nested.fine, index, &self.geometry, basis)
    }
}

impl Session {
    /// For a room of about so many fine patches.
    pub(in crate::study) fn responses(
        &self,
        scene: &Scene,
        count: usize,
        progress: &dyn Progress,
    ) -> Result<Responses, StudyError> {
        let radiosity = self.radiosity(scene, count)?;
        check(progress)?;
        let gather = self.gathering(scene, count, &radiosity)?;
        let sensors = gather
            .par_iter()
            .map(|[fine, coarse]| {
                check(progress)?;
                Ok(response(&radiosity, &fine.weights, &coarse.weights))
            })
            .collect::<Result<_, StudyError>>()?;
        let key = room_key(scene, count);
        let geometry = scene.apertures.iter().map(|a| a.aperture).collect();
        let mut responses = Responses { radiosity, sensors, key, geometry };
        self.add_mirrors(scene, &mut responses, progress)?;
        Ok(responses)
    }

    /// What goes to and fro between the room and apertures that reflect by direction: with the symbols of
    /// [`settled_weights`], every sensor's weights a become a + (a W + r) (1 − Q W)⁻¹ Q, r what it sees of l itself.
    fn add_mirrors(&self, scene: &Scene, responses: &mut Responses, progress: &dyn Progress) -> Result<(), StudyError> {
        let mirrors = mirrors(scene, |index, basis| responses.weights(self, index, basis));
        if mirrors.is_empty() {
            return Ok(());
        }
        check(progress)?;
        // Solved once for all sensors and lights: the matrix is only as large as the mirroring cells are many.
        let settled = settled_weights(&responses.radiosity, &responses.geometry, &mirrors);
        let mut seen = vec![Vec::with_capacity(settled.len()); scene.sensors.len()];
        for (index, mirror) in &mirrors {
            // Straight to the sensor as well: a mirror is seen, and not only what it lights.
            let receptions = self.receptions(scene, *index, Some(&mirror.weights().basis), progress)?;
            seen.iter_mut().zip(receptions.iter()).for_each(|(list, reception)| list.extend(&reception.cells));
        }
        check(progress)?;
        let sensors = responses.sensors.par_iter_mut().zip(seen);
        sensors.for_each(|(sensor, seen)| sensor.add_thrown_back(&mirrors, &settled, &seen));
        Ok(())
    }
}

/// Weights of the mirroring cells' settled luminances as weights of the first illuminance.
fn through(settled: &[Vec<f64>], weights: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; settled.first().map_or(0, Vec::len)];
    for (w, row) in weights.iter().zip(settled).filter(|(w, _)| **w != 0.0) {
        sums.iter_mut().zip(row).for_each(|(sum, q)| *sum += w * q);
    }
    sums
}

/// Without mirrors.
fn response(radiosity: &Radiosity, fine: &[f64], coarse: &[f64]) -> Response {
    let (mesh, coarser) = (&radiosity.nested.fine, &radiosity.nested.coarse);
    let mut response = Response {
        value: vec![0.0; fine.len()],
        apart: vec![0.0; fine.len()],
        walls: Vec::with_capacity(6),
        thrown_back: Vec::new(),
    };
    for (a, b) in spans(mesh).into_iter().zip(spans(coarser)) {
        if fine[a.clone()].iter().chain(&coarse[b.clone()]).all(|w| *w == 0.0) {
            continue;
        }
        let only = |weights: &[f64], range: std::ops::Range<usize>| -> Vec<f64> {
            let mut own = vec![0.0; weights.len()];
            own[range.clone()].copy_from_slice(&weights[range]);
            own
        };
        let (by_fine, by_coarse) = (only(fine, a), only(coarse, b));
        let value = [radiosity.adjoint_fine(&by_fine), radiosity.adjoint_coarse(&by_coarse)];
        let once: Vec<f64> = by_coarse.iter().zip(&coarser.patches).map(|(w, p)| w * p.reflectance).collect();
        let apart =
            [by_fine.iter().zip(&mesh.patches).map(|(w, p)| w * p.reflectance).collect(), radiosity.spread(&once)];
        // As the extrapolation of the two densities: fine + (fine − coarse)/3.
        let add = |sum: &mut [f64], [fine, coarse]: &[Vec<f64>; 2]| {
            sum.iter_mut().zip(fine.iter().zip(coarse)).for_each(|(s, (f, c))| *s += f + (f - c) / 3.0);
        };
        add(&mut response.value, &value);
        add(&mut response.apart, &apart);
        let less = |[fine, coarse]: &[Vec<f64>; 2]| fine.iter().zip(coarse).map(|(f, c)| f - c).collect();
        response.walls.push(Wall { value: less(&value), apart: less(&apart) });
    }
    response
}

impl Response {
    /// The step of [`Session::add_mirrors`] at one sensor; `seen`: what it sees of every mirroring cell itself.
    fn add_thrown_back(&mut self, mirrors: &[(usize, BackReflection<'_>)], settled: &[Vec<f64>], seen: &[f64]) {
        let add = |to: &mut Vec<f64>, part: &[f64]| to.iter_mut().zip(part).for_each(|(sum, x)| *sum += x);
        let back = through(settled, &gathered(mirrors, &self.value));
        add(&mut self.value, &back);
        // Kept by itself too: that an aperture is not evenly lit puts this part in doubt, and no other.
        self.thrown_back = through(settled, seen);
        add(&mut self.value, &self.thrown_back);
        // The part counted elsewhere is left alone: mirrors have their share of all first illuminance in the value.
        for wall in &mut self.walls {
            let back = through(settled, &gathered(mirrors, &wall.value));
            add(&mut wall.value, &back);
        }
    }

    /// Of a first illuminance of which `beam` is reflected elsewhere at first: value, and what the two densities differ by
    /// together with what comes back from apertures.
    pub fn of(&self, first: &[f64], beam: &[f64]) -> (f64, f64, f64) {
        let squares: f64 =
            self.walls.iter().map(|wall| (dot(&wall.value, first) - dot(&wall.apart, beam)).powi(2)).sum();
        let thrown_back = if self.thrown_back.is_empty() { 0.0 } else { dot(&self.thrown_back, first) };
        (dot(&self.value, first) - dot(&self.apart, beam), squares.sqrt(), thrown_back)
    }
}
